// Motions as planners send them: at the limits, from the measured state, with fields they do not
// declare; and positions that no arm can follow.
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

/// Returns a motion from home to rest by one quintic, given at 21 waypoints, that uses `share` of
/// joint 1's acceleration limit. Its largest acceleration is 10 / sqrt(3) times way / T^2.
Trajectory<JointSpace>* planned(CheckedJoints& bench, double share, double way) {
  const double a = share * bench.channel.settings.limits.ddq_max[0];
  const double T = std::sqrt(10.0 / std::sqrt(3.0) * way / a);
  constexpr int kSamples = 20;
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  for (int i = 0; i <= kSamples; ++i) {
    const double x = static_cast<double>(i) / kSamples, T2 = T * T;
    JointSpace::Point point = bench.home;
    point.q[0] += way * x * x * x * (10.0 + x * (6.0 * x - 15.0));
    point.dq[0] = way / T * 30.0 * x * x * (1.0 - x) * (1.0 - x);
    point.ddq[0] = way / T2 * 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x);
    if (i == kSamples) {
      point.dq.setZero();
      point.ddq.setZero();
    }
    bench.add(*motion, x * T, point);
  }
  return motion;
}

/// Runs a motion to its end, which must be `way` from home; returns the seconds it took.
double duration_s(CheckedJoints& bench, std::uint32_t id, double way) {
  const double begun_s = bench.generator.time_s();
  while (bench.generator.time_s() - begun_s < 10.0) {
    bench.cycle();
    const Report report = bench.report_of(id);
    if (report.id == 0 || report.outcome == Outcome::kStarted) continue;
    ASSERT_STATUS(report.outcome, Outcome::kSucceeded);
    break;
  }
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], way, 1e-9);
  return bench.generator.time_s() - begun_s;
}

// Proves RG-24.

void a_plan_at_or_little_over_the_limits_is_slowed_down_within_them(void**) {
  for (const double share : {0.98, 1.0, 1.05, 1.15}) {
    CheckedJoints bench;
    Trajectory<JointSpace>* motion = planned(bench, share, 0.4);
    const double planned_s = motion->end_s();
    const std::uint32_t id = bench.send(*motion);
    print_message("%.2f of the acceleration limit\n", share);
    assert_int_not_equal(id, 0);
    const double took_s = duration_s(bench, id, 0.4);
    print_message("  %.4f s, planned %.4f s\n", took_s, planned_s);
    assert_true(took_s <= 1.1 * planned_s + 3.0 * bench.period_s);
  }
}

void a_plan_far_over_the_limits_is_refused(void**) {
  CheckedJoints bench;
  assert_int_equal(bench.send(*planned(bench, 2.0, 0.4)), 0);
}

void the_last_waypoint_may_carry_the_acceleration_it_brakes_with(void**) {
  CheckedJoints bench;
  Trajectory<JointSpace>* motion = planned(bench, 0.8, 0.4);
  Waypoint<JointSpace>& last = motion->waypoints[motion->count - 1];
  last.point.ddq[0] = -0.9 * bench.channel.settings.limits.ddq_max[0];
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  bench.run(3.0);
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4, 1e-9);
  assert_true(bench.out().standing());
}

void a_plan_from_where_the_robot_is_measured_to_be_is_followed(void**) {
  CheckedJoints bench;
  constexpr double kSag = 0.015;  // rad, by which the reference is above the arm
  const auto measured = [&] {
    JointSpace::Point point = bench.out();
    point.q[0] -= kSag;
    return point;
  };
  for (int k = 0; k < 10; ++k) bench.cycle(measured());
  bench.home = measured();
  Trajectory<JointSpace>* motion = planned(bench, 0.5, 0.4);
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  for (int k = 0; k < 3000; ++k) bench.cycle(measured());
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
}

void fields_that_are_not_declared_are_not_judged(void**) {
  for (const double garbage : {1e9, static_cast<double>(NAN)}) {
    CheckedJoints bench(1e-3, OnlineMode::kLimit, Smoothness::kPosition);
    Trajectory<JointSpace>* motion = bench.trajectory(0);
    for (int i = 1; i <= 4; ++i) {
      JointSpace::Point point = bench.home;
      point.q[0] += 0.05 * i;
      point.dq.setConstant(garbage);
      point.ddq.setConstant(garbage);
      point.tau.setConstant(garbage);
      bench.add(*motion, 0.5 * i, point);
    }
    const std::uint32_t id = bench.send(*motion);
    assert_int_not_equal(id, 0);
    duration_s(bench, id, 0.2);
    assert_true(bench.out().idle());
  }
}

/// Positions every millisecond between which the velocity changes by 0.54 rad/s, 36 times as much
/// as the acceleration limit allows.
void positions_that_zigzag_are_refused(void**) {
  CheckedJoints bench;
  Trajectory<JointSpace>* motion = bench.trajectory(0);
  for (int i = 0; i < 20; ++i) {
    JointSpace::Point point = bench.home;
    point.q[0] += 0.54e-3 * (i / 2);
    bench.add(*motion, 1e-3 * i, point);
  }
  assert_int_equal(bench.send(*motion), 0);
}

void positions_far_apart_are_joined_by_lines_as_ever(void**) {
  CheckedJoints bench(1e-3, OnlineMode::kLimit, Smoothness::kPosition);
  Trajectory<JointSpace>* motion = bench.trajectory(0);
  for (int i = 0; i <= 4; ++i) {
    JointSpace::Point point = bench.home;
    point.q[0] += 0.2 * (i % 2);
    bench.add(*motion, i, point);
  }
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  duration_s(bench, id, 0.0);
}

// Proves RG-6, RG-21.

/// A quintic over 0.11 mrad in 9.5 ms takes 7 rad/s^2, which joint 1 may, and 7698 rad/s^3, which
/// it may not; in 12.5 ms both. From rest, and on the way.
void the_way_to_the_first_waypoint_is_judged_by_its_jerk_too(void**) {
  for (const double dq : {0.0, 0.5}) {
    for (const double time_s : {0.0095, 0.0125}) {
      CheckedJoints bench;
      const bool soft = time_s > 0.01;
      if (dq > 0.0) cruise(bench, bench.home.q, only(0, dq));
      Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
      JointSpace::Point point = bench.out();
      point.q[0] += dq * (time_s + bench.period_s) + 0.11e-3;
      bench.add(*motion, time_s, point);
      point.q[0] += 0.25 * dq;
      point.dq[0] = 0.0;
      if (dq > 0.0) bench.add(*motion, time_s + 0.5, point);
      const std::uint32_t id = bench.send(*motion);
      assert_int_not_equal(id, 0);
      bench.cycle();
      const Report report = bench.report_of(id);
      ASSERT_STATUS(report.outcome, soft ? Outcome::kStarted : Outcome::kRefused);
      if (dq == 0.0 && !soft) ASSERT_STATUS(report.verdict.status, Status::kJerkLimit);
      bench.run(0.1);  // whatever runs now keeps the limits
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_plan_at_or_little_over_the_limits_is_slowed_down_within_them),
      cmocka_unit_test(a_plan_far_over_the_limits_is_refused),
      cmocka_unit_test(the_last_waypoint_may_carry_the_acceleration_it_brakes_with),
      cmocka_unit_test(a_plan_from_where_the_robot_is_measured_to_be_is_followed),
      cmocka_unit_test(fields_that_are_not_declared_are_not_judged),
      cmocka_unit_test(positions_that_zigzag_are_refused),
      cmocka_unit_test(positions_far_apart_are_joined_by_lines_as_ever),
      cmocka_unit_test(the_way_to_the_first_waypoint_is_judged_by_its_jerk_too),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
