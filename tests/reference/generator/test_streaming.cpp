// Long trajectories through a small window: flow control, starvation on the path, continuation.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;
constexpr double kAmplitude = 0.3;  // rad
// 95 half swings in ten minutes, so that the last of 600 000 waypoints is at rest like the first.
constexpr int kTotal = tries(600'000, 120'000), kHalfSwings = tries(95, 19);
constexpr double kRate = kHalfSwings * 3.14159265358979323846 / (1e-3 * (kTotal - 1));  // rad/s

/// Returns waypoint `index` of a slow swing of all joints about home, from rest, with velocity and
/// acceleration.
Waypoint<JointSpace> swing(const ReferenceBench& bench, int index, double spacing_s) {
  Waypoint<JointSpace> waypoint;
  waypoint.time_s = spacing_s * index;
  const double w = kRate, t = waypoint.time_s;
  const double s = std::sin(w * t);
  waypoint.point.q = bench.home.q + JointVector::Constant(kAmplitude * s * s * s);
  waypoint.point.dq.setConstant(kAmplitude * 3.0 * w * s * s * std::cos(w * t));
  waypoint.point.ddq.setConstant(kAmplitude * 3.0 * w * w *
                                 (2.0 * s * std::cos(w * t) * std::cos(w * t) - s * s * s));
  return waypoint;
}

Trajectory<JointSpace>* begin(ReferenceBench& bench, int first, double spacing_s, int capacity) {
  Trajectory<JointSpace>* stream = bench.trajectory(kVelocityField | kAccelerationField);
  stream->capacity = capacity;
  stream->open = true;
  for (; stream->count < first; ++stream->count)
    stream->waypoints[stream->count] = swing(bench, stream->count, spacing_s);
  return stream;
}

// Proves RG-14.

void six_hundred_thousand_waypoints_pass_through_a_window_of_512(void**) {
  constexpr int kWindow = 512;
  static ReferenceBench bench;
  static std::array<Waypoint<JointSpace>, kWindow> window;
  bench.channel.stores[0].waypoints = window.data();
  Trajectory<JointSpace>* stream = begin(bench, 400, 1e-3, kWindow);
  std::uint32_t goal = 0, id = 0;
  assert_true(bench.client.send(*stream, goal).ok());
  int sent = 400;
  Outcome outcome = Outcome::kStarted;
  for (int k = 0; k < kTotal + 2000 && outcome == Outcome::kStarted; ++k) {
    ASSERT_OK(bench.step());
    if (k < kTotal) ASSERT_NEAR(bench.out().q[0], swing(bench, k, kPeriod_s).point.q[0], 1e-10);
    bool more = false;
    while (sent < kTotal) {
      const Verdict verdict = bench.client.append(*stream, swing(bench, sent, 1e-3));
      if (verdict.status == Status::kWindowFull) break;
      ASSERT_OK(verdict.status);
      more = ++sent == kTotal || more || sent % 64 == 0;
    }
    if (more) ASSERT_OK(bench.client.flush(*stream, sent == kTotal, id).status);
    Report report;
    while (bench.client.poll(report)) {
      assert_false(report.outcome == Outcome::kStarved || report.outcome == Outcome::kRefused);
      if (report.id == goal) outcome = report.outcome;
    }
  }
  assert_int_equal(static_cast<int>(outcome), static_cast<int>(Outcome::kSucceeded));
  assert_int_equal(sent, kTotal);
}

void a_stream_that_starves_stops_on_its_path_and_goes_on_when_fed(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* stream = begin(bench, 40, 0.1, 64);  // 3.9 s
  std::uint32_t goal = 0, id = 0;
  assert_true(bench.client.send(*stream, goal).ok());
  const JointLimits& limits = bench.channel.settings.limits;
  for (int k = 0; k < 8000; ++k) {
    const JointSpace::Point before = bench.out();
    ASSERT_OK(bench.step());
    for (int j = 0; j < kDof; ++j) {
      ASSERT_NEAR(bench.out().dq[j], before.dq[j], 1.001 * limits.ddq_max[j] * kPeriod_s);
      ASSERT_NEAR(bench.out().ddq[j], before.ddq[j], 1.05 * limits.dddq_max[j] * kPeriod_s);
      ASSERT_NEAR(bench.out().q[j] - bench.home.q[j], bench.out().q[0] - bench.home.q[0], 1e-12);
    }
  }
  assert_true(bench.out().standing());
  int starved = 0;
  Report report;
  while (bench.client.poll(report)) starved += report.outcome == Outcome::kStarved;
  assert_int_equal(starved, 1);

  for (int i = 40; i < 63; ++i)
    ASSERT_OK(bench.client.append(*stream, swing(bench, i, 0.1)).status);
  Waypoint<JointSpace> last = swing(bench, 63, 0.1);
  last.point = last.point.at_rest();
  ASSERT_OK(bench.client.append(*stream, last).status);
  assert_true(bench.client.flush(*stream, true, id).ok());
  ASSERT_OK(bench.run(8000));
  assert_int_equal(static_cast<int>(bench.final_of(goal).outcome),
                   static_cast<int>(Outcome::kSucceeded));
  ASSERT_NEAR(bench.out().q[0], last.point.q[0], 1e-12);
}

void a_part_that_breaks_a_limit_is_refused_and_the_stream_goes_on_without_it(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* stream = begin(bench, 10, 0.1, 64);
  std::uint32_t goal = 0, id = 0;
  assert_true(bench.client.send(*stream, goal).ok());
  Waypoint<JointSpace> wild = swing(bench, 10, 0.1);
  wild.point.q[3] += 1.0;
  ASSERT_OK(bench.client.append(*stream, wild).status);
  const Verdict verdict = bench.client.flush(*stream, false, id);
  assert_false(verdict.ok());
  assert_int_equal(verdict.waypoint, 10);
  assert_int_equal(verdict.axis, 3);
  ASSERT_OK(bench.client.append(*stream, swing(bench, 10, 0.1)).status);
  ASSERT_STATUS(bench.client.append(*stream, swing(bench, 10, 0.1)).status, Status::kReferenceTime);
}

/// Refused, it goes on, and ends with a waypoint at which the arm stands.
void the_end_of_a_stream_must_be_at_rest(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* stream = begin(bench, 10, 0.1, 64);
  std::uint32_t goal = 0, id = 0;
  assert_true(bench.client.send(*stream, goal).ok());
  Waypoint<JointSpace> last = swing(bench, 10, 0.1);
  ASSERT_OK(bench.client.append(*stream, last).status);
  const Verdict verdict = bench.client.flush(*stream, true, id);
  ASSERT_STATUS(verdict.status, Status::kNotAtRest);
  assert_int_equal(verdict.waypoint, 10);
  assert_int_equal(verdict.axis, 0);
  ASSERT_NEAR(verdict.value, last.point.dq[0], 0.0);
  last.time_s += 1.0;
  last.point = last.point.at_rest();
  ASSERT_OK(bench.client.append(*stream, last).status);
  ASSERT_OK(bench.client.flush(*stream, true, id).status);
  ASSERT_OK(bench.run(3000));
  assert_int_equal(static_cast<int>(bench.final_of(goal).outcome),
                   static_cast<int>(Outcome::kSucceeded));
  ASSERT_NEAR(bench.out().q[0], last.point.q[0], 1e-12);
}

/// Straight lines, each faster than the one before by less than may step; the end steps by it all.
void a_stream_of_lines_must_not_end_with_a_step_beyond_the_limit(void**) {
  static ReferenceBench bench;
  const double step = bench.channel.settings.limits.velocity_step.minCoeff();
  Trajectory<JointSpace>* stream = bench.trajectory(0);
  stream->open = true;
  bench.add(*stream, 0.0, 0.0);
  bench.add(*stream, 0.5, 0.4 * step);
  std::uint32_t goal = 0, id = 0;
  assert_true(bench.client.send(*stream, goal).ok());
  const auto line = [&](double time_s, double offset) {
    Waypoint<JointSpace> waypoint;
    waypoint.time_s = time_s;
    waypoint.point.q = bench.home.q + JointVector::Constant(offset);
    ASSERT_OK(bench.client.append(*stream, waypoint).status);
  };
  line(1.0, 1.2 * step);
  const Verdict verdict = bench.client.flush(*stream, true, id);
  ASSERT_STATUS(verdict.status, Status::kVelocityStep);
  assert_int_equal(verdict.waypoint, 2);
  ASSERT_NEAR(verdict.value, 1.6 * step, 1e-9);
  line(1.5, 1.6 * step);
  ASSERT_OK(bench.client.flush(*stream, true, id).status);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(six_hundred_thousand_waypoints_pass_through_a_window_of_512),
      cmocka_unit_test(a_stream_that_starves_stops_on_its_path_and_goes_on_when_fed),
      cmocka_unit_test(a_part_that_breaks_a_limit_is_refused_and_the_stream_goes_on_without_it),
      cmocka_unit_test(the_end_of_a_stream_must_be_at_rest),
      cmocka_unit_test(a_stream_of_lines_must_not_end_with_a_step_beyond_the_limit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
