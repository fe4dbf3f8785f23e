// A robot that lets motions pass slower than they are sent: trajectories wait for it.
#include <cmath>

#include "tests/reference_bench.hpp"
#include "tests/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;
constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

#define ASSERT_OUTCOME(report, expected) \
  assert_int_equal(static_cast<int>((report).outcome), static_cast<int>(expected))

/// Steps at a constant scaling until the trajectory has ended; the number of cycles.
int cycles_until_success(ReferenceBench& bench, std::uint32_t id, double scaling) {
  int cycles = 0;
  Report report = bench.final_of(id);
  for (; report.outcome == Outcome::kStarted && cycles < 100000; ++cycles) {
    bench.generator.scale_speed(scaling);
    ASSERT_OK(bench.step());
    report = bench.final_of(id);
  }
  ASSERT_OUTCOME(report, Outcome::kSucceeded);
  return cycles;
}

// Proves RG-20.

void at_a_tenth_of_the_speed_a_trajectory_takes_ten_times_as_long(void**) {
  static ReferenceBench bench;
  bench.generator.scale_speed(0.1);
  const std::uint32_t id = bench.go(0.2, 1.0, kQuintic);
  const int cycles = cycles_until_success(bench, id, 0.1);
  assert_true(cycles > 9990 && cycles < 10020);
}

void a_trajectory_that_stands_for_longer_than_its_goal_time_goes_on_afterwards(void**) {
  static ReferenceBench bench;
  bench.params.tolerances.goal_time_s = 0.5;
  ASSERT_OK(bench.start(bench.home));
  const std::uint32_t id = bench.go(0.2, 1.0, kQuintic);
  ASSERT_OK(bench.run(500));
  bench.generator.scale_speed(0.0);
  ASSERT_OK(bench.run(1000));
  assert_true(bench.out().standing());
  const JointVector where = bench.out().q;
  ASSERT_OK(bench.run(5000));
  assert_true(bench.out().q == where);
  cycles_until_success(bench, id, 1.0);
  ASSERT_NEAR(bench.out().q[0] - bench.home[0], 0.2, 1e-12);
}

void scaling_and_override_multiply_and_a_pause_stands(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* line = bench.trajectory(0);
  bench.add(*line, 20.0, 0.5);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok() && bench.client.set_override(0.5, id).ok());
  bench.generator.scale_speed(0.4);
  ASSERT_OK(bench.run(2000));
  ASSERT_NEAR(bench.out().dq[0], 0.5 * 0.4 * 0.5 / 20.0, 1e-12);
  assert_true(bench.client.pause(id).ok());
  ASSERT_OK(bench.run(2000));
  bench.generator.scale_speed(1.0);
  ASSERT_OK(bench.run(500));
  assert_true(bench.out().standing());
  assert_true(bench.client.resume(id).ok());
  ASSERT_OK(bench.run(2000));
  ASSERT_NEAR(bench.out().dq[0], 0.5 * 0.5 / 20.0, 1e-12);
}

void what_is_no_fraction_counts_as_the_nearest_and_not_a_number_as_standing(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* line = bench.trajectory(0);
  bench.add(*line, 30.0, 0.6);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok());
  struct Case {
    double scaling, rate;
  };
  const double nan = std::nan("");
  for (const Case& c : {Case{1.5, 1.0}, Case{-0.5, 0.0}, Case{0.5, 0.5}, Case{nan, 0.0}}) {
    bench.generator.scale_speed(c.scaling);
    ASSERT_OK(bench.run(2000));
    ASSERT_NEAR(bench.out().dq[0], c.rate * 0.6 / 30.0, 1e-12);
  }
}

void after_a_start_a_trajectory_runs_at_full_speed_until_told_otherwise(void**) {
  static ReferenceBench bench;
  bench.generator.scale_speed(0.0);
  ASSERT_OK(bench.run(100));
  ASSERT_OK(bench.start(bench.home));
  const std::uint32_t id = bench.go(0.2, 1.0, kQuintic);
  ASSERT_OK(bench.run(1100));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

/// Between two cycles no limit is exceeded, but for what lies between samples, nothing steps, and
/// the way never turns back.
void assert_smooth(const JointSpace::Point& before, const JointSpace::Point& after,
                   const JointLimits& limits) {
  constexpr double kOver = 1.0 + 1e-9;
  for (int j = 0; j < kDof; ++j) {
    assert_true(after.q[j] >= before.q[j] - 1e-12);
    assert_true(std::abs(after.dq[j]) <= limits.dq_max[j] * kOver);
    assert_true(std::abs(after.ddq[j]) <= limits.ddq_max[j] * kOver);
    ASSERT_NEAR(after.dq[j], before.dq[j], limits.ddq_max[j] * kPeriod_s * 1.001);
    ASSERT_NEAR(after.ddq[j], before.ddq[j], limits.dddq_max[j] * kPeriod_s * 1.05);
  }
}

void whatever_the_robot_does_with_its_speed_the_path_is_kept_without_a_step(void**) {
  static ReferenceBench bench;
  Random random{20261121};
  for (int trial = 0; trial < 100; ++trial) {
    ASSERT_OK(bench.start(bench.home));
    const std::uint32_t id = bench.go(random.uniform(0.1, 0.5), 1.5, kQuintic);
    double scaling = 1.0;
    int cycles = 0;
    for (; bench.final_of(id).outcome == Outcome::kStarted && cycles < 20000; ++cycles) {
      // A slider that is dragged, lets go, or jumps.
      if (random.below(300) == 0) scaling = random.uniform(-0.2, 1.2);
      if (random.below(100) == 0) scaling += random.uniform(-0.1, 0.1);
      bench.generator.scale_speed(scaling);
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      assert_smooth(before, bench.out(), bench.channel.settings.limits);
      for (int j = 1; j < kDof; ++j)
        ASSERT_NEAR(bench.out().q[j] - bench.home[j], bench.out().q[0] - bench.home[0], 1e-12);
    }
    assert_true(cycles < 20000);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_a_tenth_of_the_speed_a_trajectory_takes_ten_times_as_long),
      cmocka_unit_test(a_trajectory_that_stands_for_longer_than_its_goal_time_goes_on_afterwards),
      cmocka_unit_test(scaling_and_override_multiply_and_a_pause_stands),
      cmocka_unit_test(what_is_no_fraction_counts_as_the_nearest_and_not_a_number_as_standing),
      cmocka_unit_test(after_a_start_a_trajectory_runs_at_full_speed_until_told_otherwise),
      cmocka_unit_test(whatever_the_robot_does_with_its_speed_the_path_is_kept_without_a_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
