// A client that never sleeps, in its own thread, and the generator's cycle: no message is torn or
// lost. Meant to be run under the thread sanitizer too.
#include <atomic>
#include <thread>

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr int kMaxCycles = 20000000;
constexpr std::uint32_t kEnough = 20000;  // requests
constexpr std::size_t kMaxRequests = 1 << 20;
constexpr double kTorn = 1e-6;  // rad; far above rounding, far below the offsets that are sent

struct Shared {
  ReferenceBench bench;
  std::atomic<bool> running{true};
  std::atomic<std::uint32_t> sent{0};
  std::array<std::uint8_t, kMaxRequests> finals{};  // used by the client only, until it has ended
};

void collect(Shared& shared) {
  Report report;
  while (shared.bench.client.poll(report)) {
    if (report.outcome != Outcome::kStarted && report.outcome != Outcome::kReleased)
      ++shared.finals[report.id];
  }
}

/// Sends one random request and returns its id; 0 if it was not sent.
std::uint32_t ask(ReferenceBench& bench, Random& random) {
  std::uint32_t id = 0;
  switch (random.below(6)) {
    case 0: return bench.client.cancel(id).ok() ? id : 0;
    case 1: return bench.client.set_override(random.uniform(0.0, 1.0), id).ok() ? id : 0;
    case 2: {
      JointSpace::Point point;
      // Every joint has the same offset, so that a torn point is noticed.
      point.q = bench.home.q + JointVector::Constant(random.uniform(-0.3, 0.3));
      return bench.client.send(point, id).ok() ? id : 0;
    }
    default: break;
  }
  Trajectory<JointSpace>* motion = bench.trajectory(kVelocityField);
  if (motion == nullptr) return 0;
  for (int i = 1 + random.below(8); i > 0; --i)
    bench.add(*motion, 2.0 * (motion->count + 1), random.uniform(-0.3, 0.3));
  return bench.client.send(*motion, id).ok() ? id : 0;
}

/// Every joint gets the limits of the weakest, so that equal targets give equal motions even when
/// the client is late and a trajectory is replaced while the arm moves.
void make_joints_equal(ReferenceBench& bench) {
  JointLimits& limits = bench.channel.settings.limits;
  const double reach = (0.5 * (limits.q_max - limits.q_min)).minCoeff();
  limits.q_min = bench.home.q - JointVector::Constant(reach);
  limits.q_max = bench.home.q + JointVector::Constant(reach);
  for (JointVector* limit :
       {&limits.dq_max, &limits.ddq_max, &limits.dddq_max, &limits.velocity_step})
    limit->setConstant(limit->minCoeff());
}

void run_client(Shared& shared) {
  Random random{99};
  while (shared.running.load(std::memory_order_relaxed) && shared.sent + 1 < kMaxRequests) {
    if (const std::uint32_t id = ask(shared.bench, random); id != 0) shared.sent = id;
    collect(shared);
  }
}

// Proves KER-4, RG-5.

void a_client_that_never_sleeps_neither_tears_nor_loses_anything(void**) {
  static Shared shared;
  make_joints_equal(shared.bench);
  std::thread client(run_client, std::ref(shared));
  bool whole = true;
  Status status = Status::kOk;
  for (int k = 0; k < kMaxCycles && shared.sent < kEnough && status == Status::kOk; ++k) {
    status = shared.bench.step();
    if (shared.bench.channel.requests.size() == 0) std::this_thread::yield();
    const JointSpace::Point& out = shared.bench.out();
    for (int j = 1; j < kDof; ++j) {
      const double offset = out.q[j] - shared.bench.home.q[j];
      whole = whole && std::abs(offset - (out.q[0] - shared.bench.home.q[0])) < kTorn;
    }
  }
  shared.running = false;
  client.join();
  ASSERT_OK(status);
  assert_true(whole);
  for (int k = 0; k < 50000; ++k) {
    ASSERT_OK(shared.bench.step());
    collect(shared);
  }
  std::uint32_t id = 0;
  assert_true(shared.bench.client.set_override(1.0, id).ok());
  shared.sent = id;
  for (int k = 0; k < 50000; ++k) {
    ASSERT_OK(shared.bench.step());
    collect(shared);
  }
  assert_true(shared.sent >= kEnough);
  for (std::uint32_t i = 1; i <= shared.sent; ++i) assert_int_equal(shared.finals[i], 1);
}

constexpr int kStreamed = 3001;  // waypoints in one minute
constexpr double kSpacing_s = 0.02;

/// A motion from rest to rest by ten swings of all joints about home.
Waypoint<JointSpace> swing(const ReferenceBench& bench, int index) {
  constexpr double kAmplitude = 0.1, w = 20.0 * 3.14159265358979323846 / 60.0;
  Waypoint<JointSpace> waypoint;
  waypoint.time_s = kSpacing_s * index;
  const double s = std::sin(w * waypoint.time_s), c = std::cos(w * waypoint.time_s);
  waypoint.point.q = bench.home.q + JointVector::Constant(kAmplitude * s * s * s);
  waypoint.point.dq.setConstant(kAmplitude * 3.0 * w * s * s * c);
  waypoint.point.ddq.setConstant(kAmplitude * 3.0 * w * w * s * (2.0 * c * c - s * s));
  return waypoint;
}

/// Keeps the window as full as possible, with parts of all sizes; false if anything is refused.
bool feed(ReferenceBench& bench, const Trajectory<JointSpace>& stream, Random& random, int& sent) {
  std::uint32_t id = 0;
  const int most = std::min(kStreamed, sent + 1 + random.below(16)), before = sent;
  while (sent < most) {
    const Verdict verdict = bench.client.append(stream, swing(bench, sent));
    if (verdict.status == Status::kWindowFull) break;
    if (!verdict.ok()) return false;
    ++sent;
  }
  return sent == before || bench.client.flush(stream, sent == kStreamed, id).ok();
}

struct Streaming {
  ReferenceBench bench;
  std::atomic<bool> running{true}, good{true}, succeeded{false};
};

void stream_all(Streaming& shared) {
  ReferenceBench& bench = shared.bench;
  Random random{5};
  Trajectory<JointSpace>* stream = bench.trajectory(kVelocityField | kAccelerationField);
  stream->open = true;
  for (; stream->count < 4; ++stream->count)
    stream->waypoints[stream->count] = swing(bench, stream->count);
  int sent = stream->count;
  std::uint32_t goal = 0;
  shared.good = bench.client.send(*stream, goal).ok();
  while (shared.running && shared.good && !shared.succeeded) {
    if (sent < kStreamed && !feed(bench, *stream, random, sent)) shared.good = false;
    Report report;
    while (bench.client.poll(report)) {
      if (report.outcome == Outcome::kRefused) shared.good = false;
      if (report.outcome == Outcome::kSucceeded) shared.succeeded = report.id == goal;
    }
    std::this_thread::yield();
  }
}

// Proves KER-4, RG-14.

void a_client_that_streams_beside_the_cycle_is_followed_to_the_end_within_limits(void**) {
  static Streaming shared;
  MotionOracle<JointSpace> oracle;
  oracle.begin(shared.bench.channel.settings.limits, ReferenceBench::kPeriod_s,
               Smoothness::kVelocity, kRateJerk);
  std::thread client(stream_all, std::ref(shared));
  bool within = true;
  Status status = Status::kOk;
  for (int k = 0; k < kMaxCycles && shared.good && !shared.succeeded && status == Status::kOk;
       ++k) {
    status = shared.bench.step();
    within = within && oracle.check(shared.bench.out()).what == nullptr;
    if (shared.bench.generator.phase() == MotionPhase::kStarving) std::this_thread::yield();
  }
  shared.running = false;
  client.join();
  ASSERT_OK(status);
  assert_true(shared.good && shared.succeeded && within);
  const JointVector end = swing(shared.bench, kStreamed - 1).point.q;
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(shared.bench.out().q[j], end[j], 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_client_that_never_sleeps_neither_tears_nor_loses_anything),
      cmocka_unit_test(a_client_that_streams_beside_the_cycle_is_followed_to_the_end_within_limits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
