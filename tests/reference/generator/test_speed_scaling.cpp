// A robot that scales down the speed of motions: trajectories wait for it.
#include <cmath>

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;
constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// Steps at a constant scaling until the trajectory has ended; returns the number of cycles.
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
  ASSERT_OK(bench.start(bench.home.q));
  const std::uint32_t id = bench.go(0.2, 1.0, kQuintic);
  ASSERT_OK(bench.run(500));
  bench.generator.scale_speed(0.0);
  ASSERT_OK(bench.run(1000));
  assert_true(bench.out().standing());
  const JointVector where = bench.out().q;
  ASSERT_OK(bench.run(5000));
  assert_true(bench.out().q == where);
  cycles_until_success(bench, id, 1.0);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.2, 1e-12);
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
  ASSERT_OK(bench.start(bench.home.q));
  const std::uint32_t id = bench.go(0.2, 1.0, kQuintic);
  ASSERT_OK(bench.run(1100));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

// Proves RG-11, RG-20.

/// A line of joint 1 for ten seconds at 0.05 rad/s.
std::uint32_t send_line(ReferenceBench& bench) {
  Trajectory<JointSpace>* line = bench.trajectory(0);
  bench.add(*line, 10.0, 0.0);
  line->waypoints[0].point.q[0] = bench.out().q[0] + 0.5;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok());
  return id;
}

/// On the path it brakes on it stops as ever; the next trajectory passes at the rate told
/// meanwhile.
void an_override_told_during_a_brake_holds_for_what_comes_next(void**) {
  for (const double rate : {0.0, 0.25, 1.0}) {
    ReferenceBench told, untold;
    for (ReferenceBench* bench : {&told, &untold}) {
      send_line(*bench);
      ASSERT_OK(bench->run(2000));
      std::uint32_t id = 0;
      assert_true(bench->client.set_override(0.8, id).ok());
      assert_true(bench->client.cancel(id).ok());
      ASSERT_OK(bench->run(2));
      assert_true(bench->generator.phase() == MotionPhase::kBraking);
      if (bench == &told) assert_true(bench->client.set_override(rate, id).ok());
    }
    for (int k = 0; k < 100; ++k) {
      ASSERT_OK(told.step());
      ASSERT_OK(untold.step());
      assert_true(told.out().q == untold.out().q && told.out().dq == untold.out().dq);
    }
    assert_true(told.out().standing());
    static_cast<void>(told.final_of(0));
    send_line(told);
    ASSERT_OK(told.run(2000));
    ASSERT_NEAR(told.out().dq[0], rate * 0.05, 1e-12);
  }
}

/// An open line of joint 1 of one second at 0.05 rad/s.
Trajectory<JointSpace>* send_open_line(ReferenceBench& bench) {
  Trajectory<JointSpace>* line = bench.trajectory(0);
  line->open = true;
  bench.add(*line, 0.0, 0.0);
  bench.add(*line, 1.0, 0.0);
  line->waypoints[1].point.q[0] += 0.05;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok());
  return line;
}

void an_override_told_while_it_starves_holds_when_it_is_fed(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* line = send_open_line(bench);
  ASSERT_OK(bench.run(3000));
  assert_true(bench.generator.phase() == MotionPhase::kStarving);
  std::uint32_t id = 0;
  assert_true(bench.client.set_override(0.5, id).ok());
  ASSERT_OK(bench.run(100));
  assert_true(bench.out().standing());
  Waypoint<JointSpace> next = line->waypoints[1];
  next.time_s = 11.0;
  next.point.q[0] += 0.5;
  ASSERT_OK(bench.client.append(*line, next).status);
  ASSERT_OK(bench.client.flush(*line, true, id).status);
  ASSERT_OK(bench.step());
  static_cast<void>(bench.final_of(0));  // the client raises the rooms
  ASSERT_OK(bench.run(2000));
  ASSERT_NEAR(bench.out().dq[0], 0.5 * 0.05, 1e-12);
}

/// There is more to come: it is the override that it stands for.
void an_open_path_that_an_override_stops_does_not_starve(void**) {
  static ReferenceBench bench;
  send_open_line(bench);
  ASSERT_OK(bench.run(200));
  std::uint32_t id = 0;
  assert_true(bench.client.set_override(0.0, id).ok());
  ASSERT_OK(bench.run(2000));
  assert_true(bench.out().standing() && bench.generator.phase() == MotionPhase::kFollowing);
  Report report;
  while (bench.client.poll(report)) assert_false(report.outcome == Outcome::kStarved);
}

// Proves RG-20.

/// Checks that between two cycles no limit is exceeded, except by what is between samples, that
/// nothing steps, and that the motion never turns back.
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
    ASSERT_OK(bench.start(bench.home.q));
    const std::uint32_t id = bench.go(random.uniform(0.1, 0.5), 1.5, kQuintic);
    double scaling = 1.0;
    int cycles = 0;
    for (; bench.final_of(id).outcome == Outcome::kStarted && cycles < 20000; ++cycles) {
      // A slider that is dragged, released, or jumps.
      if (random.below(300) == 0) scaling = random.uniform(-0.2, 1.2);
      if (random.below(100) == 0) scaling += random.uniform(-0.1, 0.1);
      bench.generator.scale_speed(scaling);
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      assert_smooth(before, bench.out(), bench.channel.settings.limits);
      for (int j = 1; j < kDof; ++j)
        ASSERT_NEAR(bench.out().q[j] - bench.home.q[j], bench.out().q[0] - bench.home.q[0], 1e-12);
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
      cmocka_unit_test(an_override_told_during_a_brake_holds_for_what_comes_next),
      cmocka_unit_test(an_override_told_while_it_starves_holds_when_it_is_fed),
      cmocka_unit_test(an_open_path_that_an_override_stops_does_not_starve),
      cmocka_unit_test(whatever_the_robot_does_with_its_speed_the_path_is_kept_without_a_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
