// Stops on and off the path: their time, and that no joint moves back.
#include "kernel/reference/blocks/joint_reference_generator.hpp"
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

/// Longest stop on a path, as a multiple of the least time.
constexpr double kStop = 1.3;
/// Cycles until a stop begins.
constexpr int kTransport = 2;

/// Moves joint 1 alone at `dq`; `busy`: at the end of the path joint 7 moves as fast as is
/// admitted.
void run_along(CheckedJoints& bench, double dq, bool busy) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  JointSpace::Point point = bench.home;
  point.q[0] -= 1.7;
  ASSERT_OK(bench.start(point));
  bench.oracle.forget();
  const double run_s = 0.4, cruise_s = 2.4 / dq;
  bench.add(*motion, 0.0, point);
  point.q[0] += 0.5 * run_s * dq;
  point.dq[0] = dq;
  bench.add(*motion, run_s, point);
  point.q[0] += cruise_s * dq;
  bench.add(*motion, run_s + cruise_s, point);
  point.q[0] += 0.5 * run_s * dq;
  point.dq[0] = 0.0;
  bench.add(*motion, 2.0 * run_s + cruise_s, point);
  const double end_s = motion->end_s();
  std::uint32_t id = busy ? 0 : bench.send(*motion);
  point.q[6] += 0.05;
  if (busy) bench.add(*motion, 0.0, point);
  for (double T = 0.02; busy && id == 0; T += 0.001) {
    motion->waypoints[4].time_s = end_s + T;
    id = bench.send(*motion);
  }
  bench.run(run_s + 0.2);
  ASSERT_NEAR(bench.out().dq[0], dq, 1e-9);
}

void assert_stops_quickly(CheckedJoints& bench, double dq) {
  const TimeOptimum axis(axis_limits(0));
  const double begin = bench.out().q[0], waited = kTransport * bench.period_s;
  const double time_s = bench.stop(5.0), way = bench.out().q[0] - begin;
  print_message("stopped in %.4f s and %.4f rad, least %.4f s and %.4f rad\n", time_s, way,
                axis.stopping_time_s(dq), axis.stopping_way(dq));
  assert_true(time_s <= kStop * axis.stopping_time_s(dq) + waited);
  assert_true(way <= kStop * axis.stopping_way(dq) + waited * dq);
}

// Proves RG-11, RG-21.

void a_cancel_stops_a_fast_joint_in_about_the_least_time(void**) {
  CheckedJoints bench;
  run_along(bench, 2.1, false);
  assert_int_not_equal(bench.cancel(), 0);
  assert_stops_quickly(bench, 2.1);
}

void a_quick_segment_at_the_far_end_makes_no_stop_longer(void**) {
  CheckedJoints bench;
  run_along(bench, 2.1, true);
  assert_int_not_equal(bench.pause(), 0);
  assert_stops_quickly(bench, 2.1);
}

void the_executives_brake_stops_a_fast_joint_in_about_the_least_time(void**) {
  CheckedJoints bench;
  run_along(bench, 2.1, true);
  bench.brake(Status::kCollision);
  assert_stops_quickly(bench, 2.1);
}

/// Asserts that joint 1 comes to rest, never moves back, and goes no farther than it must.
void assert_rests_monotone(CheckedJoints& bench, double dq, double waited_s) {
  const double begin = bench.out().q[0];
  double farthest = begin, back = 0.0;
  for (int k = 0; k < 3000; ++k) {
    bench.cycle();
    farthest = std::max(farthest, bench.out().q[0]);
    back = std::max(back, farthest - bench.out().q[0]);
  }
  const double least = TimeOptimum(axis_limits(0)).stopping_way(dq);
  print_message("%.4f rad on, least %.4f rad, %.4f rad back\n", farthest - begin, least, back);
  ASSERT_NEAR(back, 0.0, 1e-12);
  ASSERT_NEAR(bench.out().dq[0], 0.0, 0.0);
  assert_true(farthest - begin <= 1.05 * least + waited_s * dq);
}

void a_joint_that_a_trajectory_holds_comes_to_rest_and_not_back(void**) {
  CheckedJoints bench;
  cruise(bench, bench.home.q, only(0, 2.0), 0.5);
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  motion->header.held = 1;
  JointSpace::Point point = bench.home;
  point.q[1] += 0.5;
  bench.add(*motion, 1.5, point);
  const std::uint32_t id = bench.send(*motion);
  assert_rests_monotone(bench, 2.0, kTransport * bench.period_s);
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[1], point.q[1], 1e-9);
}

void a_joint_that_a_point_holds_comes_to_rest_and_not_back(void**) {
  CheckedJoints bench;
  cruise(bench, bench.home.q, only(0, 2.0), 0.5);
  JointSpace::Point point = bench.home;
  point.q[1] += 0.5;
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id, {1}).ok());
  assert_rests_monotone(bench, 2.0, kTransport * bench.period_s);
}

/// Joint 2, at rest, is measured away from its reference; joint 1, in motion, is where it should
/// be.
void a_tolerance_that_is_violated_ends_at_rest_and_not_back(void**) {
  CheckedJoints bench;
  bench.params.tolerances.path.q[1] = 0.05;
  const std::uint32_t id = cruise(bench, bench.home.q, only(0, 2.0), 0.5);
  JointSpace::Point measured = bench.out();
  measured.q[1] += 0.06;
  bench.cycle(measured);
  const Report report = bench.report_of(id);
  ASSERT_STATUS(report.outcome, Outcome::kAborted);
  ASSERT_STATUS(report.verdict.status, Status::kPathTolerance);
  assert_rests_monotone(bench, 2.0, kTransport * bench.period_s);
}

// Proves RG-13.

void a_goal_time_below_zero_switches_that_check_off(void**) {
  CheckedJoints bench;
  bench.params.tolerances.goal.q.setConstant(0.01);
  bench.params.tolerances.goal_time_s = 0.5;
  ASSERT_OK(bench.start(bench.home));
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  motion->tolerances.goal_time_s = -1.0;
  JointSpace::Point point = bench.home;
  point.q[0] += 0.1;
  bench.add(*motion, 1.0, point);
  const std::uint32_t id = bench.send(*motion);
  for (int k = 0; k < 4000; ++k) bench.cycle(bench.home);
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kStarted);
  for (int k = 0; k < 10; ++k) bench.cycle();
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
}

/// The arm passes the goal at 0.3 rad/s, inside the goal's band all the time; dq is not wired.
void without_a_measured_velocity_an_arm_that_moves_has_not_stopped(void**) {
  static MotionBench<JointSpace> bench(1e-3);  // for its stores and its client
  static JointReferenceGenerator block;
  static JointVector q = bench.home.q;
  block.channel = &bench.channel;
  block.q.source = &q;
  block.params.goal_tolerance.setConstant(0.2);
  block.params.generator.stopped_velocity = 0.01;
  ASSERT_OK(block.start());
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  bench.add(*motion, 0.1, bench.home);
  const std::uint32_t id = bench.send(*motion);
  for (int k = 0; k < 400; ++k) {
    q[0] = bench.home.q[0] + 3e-4 * (k < 200 ? k - 100 : 300 - k);
    ASSERT_OK(block.step(bench.period_s));
  }
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kStarted);
  for (int k = 0; k < 100; ++k) ASSERT_OK(block.step(bench.period_s));
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cancel_stops_a_fast_joint_in_about_the_least_time),
      cmocka_unit_test(a_quick_segment_at_the_far_end_makes_no_stop_longer),
      cmocka_unit_test(the_executives_brake_stops_a_fast_joint_in_about_the_least_time),
      cmocka_unit_test(a_joint_that_a_trajectory_holds_comes_to_rest_and_not_back),
      cmocka_unit_test(a_joint_that_a_point_holds_comes_to_rest_and_not_back),
      cmocka_unit_test(a_tolerance_that_is_violated_ends_at_rest_and_not_back),
      cmocka_unit_test(a_goal_time_below_zero_switches_that_check_off),
      cmocka_unit_test(without_a_measured_velocity_an_arm_that_moves_has_not_stopped),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
