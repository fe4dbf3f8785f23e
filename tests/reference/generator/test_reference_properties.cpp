// Properties that the reference generator keeps whatever is sent to it at any time: seeded random
// clients.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kCubic = kVelocityField, kQuintic = kVelocityField | kAccelerationField;
constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// Sends a random reachable motion that starts now and returns its number; 0 if no store is free or
/// it was not admitted.
std::uint32_t send_motion(ReferenceBench& bench, Random& random, Fields fields) {
  Trajectory<JointSpace>* motion = bench.trajectory(fields);
  if (motion == nullptr) return 0;
  double time_s = 0.0;
  const int count = 1 + random.below(4);
  for (int i = 0; i < count; ++i) {
    time_s += random.uniform(0.8, 2.0);
    const bool last = i + 1 == count;
    bench.add(*motion, time_s, random.uniform(-0.4, 0.4), last ? 0.0 : random.uniform(-0.2, 0.2));
  }
  std::uint32_t id = 0;
  return bench.client.send(*motion, id).ok() ? id : 0;
}

/// Checks that position, velocity and acceleration belong together: each changes in a period as its
/// derivatives say, up to a bounded jerk.
void assert_continuous(const JointSpace::Point& before, const JointSpace::Point& after,
                       const JointLimits& limits) {
  for (int j = 0; j < kDof; ++j) {
    const double jerk = 3.0 * limits.dddq_max[j];
    const double dt = kPeriod_s;
    ASSERT_NEAR(after.ddq[j], before.ddq[j], jerk * dt);
    ASSERT_NEAR(after.dq[j], before.dq[j] + 0.5 * dt * (before.ddq[j] + after.ddq[j]),
                jerk * dt * dt);
    ASSERT_NEAR(after.q[j], before.q[j] + 0.5 * dt * (before.dq[j] + after.dq[j]),
                jerk * dt * dt * dt);
  }
}

// Proves RG-4.

void no_replacement_and_no_cancel_ever_makes_the_reference_step(void**) {
  static ReferenceBench bench;
  Random random{20261120};
  ASSERT_OK(bench.step());
  int accepted = 0;
  for (int motion = 0; motion < 1000; ++motion) {
    if (random.below(4) == 0) {
      std::uint32_t id = 0;
      static_cast<void>(bench.client.cancel(id));
    } else {
      accepted += send_motion(bench, random, kQuintic) != 0;
    }
    const int cycles = 1 + random.below(1500);
    for (int k = 0; k < cycles; ++k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      assert_continuous(before, bench.out(), bench.channel.settings.limits);
    }
    static_cast<void>(bench.final_of(0));
  }
  assert_true(accepted > 500);
}

// Proves RG-5.

void every_request_ends_in_exactly_one_final_report(void**) {
  static ReferenceBench bench;
  static std::array<int, 40000> finals;
  finals.fill(0);
  Random random{7};
  std::uint32_t sent = 0;
  const auto collect = [&] {
    Report report;
    while (bench.client.poll(report)) {
      if (report.outcome != Outcome::kStarted) ++finals[report.id];
    }
  };
  for (int k = 0; k < 20000; ++k) {
    for (int i = random.below(4); i > 0; --i) {
      std::uint32_t id = 0;
      JointSpace::Point point;
      point.q = bench.home.q + JointVector::Constant(random.uniform(-0.2, 0.2));
      const int kind = random.below(8);
      if (kind == 0)
        id = send_motion(bench, random, kCubic);
      else if (kind == 1)
        id = bench.client.cancel(id).ok() ? id : 0;
      else
        id = bench.client.send(point, id).ok() ? id : 0;
      if (id != 0) sent = id;
    }
    ASSERT_OK(bench.step());
    if (random.below(20) == 0) collect();  // a client that reads seldom
  }
  collect();
  ASSERT_OK(bench.run(10000));
  collect();
  assert_true(sent > 10000 && sent < finals.size());
  for (std::uint32_t id = 1; id <= sent; ++id) assert_int_equal(finals[id], 1);
}

void a_client_that_reads_no_reports_loses_none(void**) {
  static ReferenceBench bench;
  int sent = 0, reported = 0;
  for (int k = 0; k < 1000; ++k) {
    JointSpace::Point point;
    point.q = bench.home.q;
    std::uint32_t id = 0;
    sent += bench.client.send(point, id).ok();
    ASSERT_OK(bench.step());
  }
  assert_true(sent < 100);  // the mailboxes are full and say so
  Report report;
  for (int k = 0; k < 100; ++k) {
    while (bench.client.poll(report)) ++reported;
    ASSERT_OK(bench.step());
  }
  while (bench.client.poll(report)) ++reported;
  assert_int_equal(reported, sent);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_replacement_and_no_cancel_ever_makes_the_reference_step),
      cmocka_unit_test(every_request_ends_in_exactly_one_final_report),
      cmocka_unit_test(a_client_that_reads_no_reports_loses_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
