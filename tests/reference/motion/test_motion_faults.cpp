// Situations in which a reference once left its limits or its path: streamed trajectories that grow
// while their rate changes, and motions that are replaced.
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

/// Sends 10 mrad in 1 s on every joint as an open trajectory.
Trajectory<JointSpace>* send_slow_start(CheckedJoints& bench) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  motion->open = true;
  JointSpace::Point point = bench.home;
  bench.add(*motion, 0.0, point);
  point.q += JointVector::Constant(0.01);
  bench.add(*motion, 1.0, point);
  assert_int_not_equal(bench.send(*motion), 0);
  return motion;
}

/// Appends half a radian, as soon as is admitted: this part uses nearly all of the limits.
void append_quick_part(CheckedJoints& bench, const Trajectory<JointSpace>& motion) {
  JointSpace::Point point = bench.home;
  point.q += JointVector::Constant(0.51);
  std::uint32_t id = 0;
  for (double end_s = 1.3; !(bench.client.append(motion, {end_s, point}).ok() &&
                             bench.client.flush(motion, false, id).ok());
       end_s += 0.01) {
    assert_true(end_s < 3.0);
  }
}

/// Lets the arm begin the slow part, asks for a stop, and appends the quick part on the way to it.
void grow_while_slowing(CheckedJoints& bench) {
  Trajectory<JointSpace>* motion = send_slow_start(bench);
  bench.run(0.05);
  static_cast<void>(bench.set_override(0.0));
  bench.run(0.006);
  append_quick_part(bench, *motion);
}

/// Asserts that the reference is on the part that was sent first, between its ends.
void assert_on_slow_part(const CheckedJoints& bench) {
  const JointVector way = bench.out().q - bench.home.q;
  ASSERT_NEAR(way.minCoeff(), 0.005, 0.005 + 1e-12);
  ASSERT_NEAR(way.maxCoeff(), 0.005, 0.005 + 1e-12);
  ASSERT_NEAR(bench.out().dq.minCoeff(), 0.5, 0.5 + 1e-12);
}

// Proves RG-21.

void a_stop_while_the_path_grows_stays_on_the_path(void**) {
  static CheckedJoints bench;
  grow_while_slowing(bench);
  static_cast<void>(bench.set_override(0.0));
  for (int k = 0; k < 2000; ++k) {
    bench.cycle();
    assert_on_slow_part(bench);
  }
  assert_true(bench.out().standing());
}

void the_executives_brake_while_the_path_grows_stays_on_the_path(void**) {
  static CheckedJoints bench;
  grow_while_slowing(bench);
  bench.run(0.001);
  for (int k = 0; k < 2000; ++k) {
    bench.brake(Status::kCollision);
    bench.cycle();
    assert_on_slow_part(bench);
  }
  assert_true(bench.out().standing());
}

/// Joint 1 has constant acceleration for 0.15 s, by a cubic, then constant deceleration.
void a_first_chunk_shorter_than_the_way_to_stop_moves_as_its_velocity_says(void**) {
  static CheckedJoints bench(1e-3, OnlineMode::kLimit, Smoothness::kVelocity);
  constexpr double kT = 0.15, kA = 0.84 * 15.0;
  Trajectory<JointSpace>* motion = bench.trajectory(kCubics);
  motion->open = true;
  JointSpace::Point point = bench.home;
  bench.add(*motion, 0.0, point);
  point.q[0] += 0.5 * kA * kT * kT;
  point.dq[0] = kA * kT;
  bench.add(*motion, kT, point);
  assert_int_not_equal(bench.send(*motion), 0);
  bench.run(0.4);
  point.q[0] += 0.5 * kA * kT * kT;
  point.dq[0] = 0.0;
  assert_true(bench.client.append(*motion, {2.0 * kT, point}).ok());
  std::uint32_t id = 0;
  assert_true(bench.client.flush(*motion, true, id).ok());
  bench.run(2.0);
  ASSERT_NEAR(bench.out().q[0], point.q[0], 1e-9);
}

/// Out of a motion towards the limit follows a path that is at rest and then goes to the limit
/// itself; that part is appended while the motion has not reached the path yet.
void what_is_appended_beside_a_motion_leaves_no_joints_range(void**) {
  for (int i = 1; i <= 10; ++i) {
    CheckedJoints bench;
    const double dq = 0.2 * i;
    const JointLimits limits;
    JointVector middle = bench.home.q;
    middle[0] = limits.q_max[0] - 1.0 * dq;  // ends 0.3 dq before the limit
    cruise(bench, middle, only(0, dq));
    bench.run(0.85);
    Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
    motion->open = true;
    JointSpace::Point point = bench.out().at_rest();
    bench.add(*motion, 0.0, point);
    bench.add(*motion, 0.05, point);
    assert_int_not_equal(bench.send(*motion), 0);
    bench.cycle();
    point.q[0] = limits.q_max[0] - 1e-3;
    std::uint32_t id = 0;
    double end_s = 0.15;
    while (!(bench.client.append(*motion, {end_s, point}).ok() &&
             bench.client.flush(*motion, true, id).ok()))
      end_s += 0.02;
    bench.run(2.0);
    assert_true(bench.out().standing());
  }
}

/// Sends a motion from the next place of the reference, with a velocity of its own that it keeps
/// for a while; then to rest.
template <class Space, class Point>
std::uint32_t replace(CheckedMotion<Space>& bench, const Point& begin, const Point& kept,
                      const Point& end) {
  Trajectory<Space>* motion = bench.trajectory(kQuintics);
  bench.add(*motion, 0.0, begin);
  bench.add(*motion, 1.0, kept);
  bench.add(*motion, 2.0, end);
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  return id;
}

void a_replacement_that_begins_at_once_keeps_the_limits_of_joints_in_motion(void**) {
  for (int i = -9; i <= 9; ++i) {
    CheckedJoints bench;
    bench.set_speed(0.3);
    const JointVector dq = 0.9 * bench.channel.settings.limits.dq_max;
    cruise(bench, bench.home.q, dq, 0.4);
    JointSpace::Point begin = bench.out().at_rest();
    begin.q += bench.period_s * dq;
    begin.dq = 0.1 * i * dq;
    JointSpace::Point kept = begin, end = begin;
    kept.q += begin.dq;
    end.q = kept.q + 0.5 * begin.dq;
    end.dq.setZero();
    const std::uint32_t id = replace(bench, begin, kept, end);
    bench.run(4.0);
    ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
    ASSERT_NEAR((bench.out().q - end.q).norm(), 0.0, 1e-9);
  }
}

void a_replacement_that_begins_at_once_keeps_the_limits_of_a_tip_in_motion(void**) {
  for (int i = -9; i <= 9; ++i) {
    CheckedTip bench;
    bench.set_speed(0.3);
    Trajectory<TaskSpace>* motion = bench.trajectory(kQuintics);
    TaskSpace::Point point = bench.home;
    point.x.p += Vector3(0.2, -0.15, 0.0);
    point.x.r = exp_so3({0.0, 0.3, 0.15}) * point.x.r;
    bench.add(*motion, 1.0, point);
    assert_int_not_equal(bench.send(*motion), 0);
    bench.run(0.5);
    TaskSpace::Point begin = bench.out().at_rest();
    begin.v = 0.1 * i * bench.out().v;
    const auto on = [&](double time_s) {
      TaskSpace::Point later = begin;
      later.x.p += time_s * begin.v.head<3>();
      later.x.r = exp_so3(time_s * begin.v.tail<3>()) * begin.x.r;
      return later;
    };
    TaskSpace::Point end = on(1.5);
    end.v.setZero();
    const std::uint32_t id = replace(bench, begin, on(1.0), end);
    bench.run(4.0);
    ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
    ASSERT_NEAR((bench.out().x.p - end.x.p).norm(), 0.0, 1e-9);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_stop_while_the_path_grows_stays_on_the_path),
      cmocka_unit_test(the_executives_brake_while_the_path_grows_stays_on_the_path),
      cmocka_unit_test(a_first_chunk_shorter_than_the_way_to_stop_moves_as_its_velocity_says),
      cmocka_unit_test(what_is_appended_beside_a_motion_leaves_no_joints_range),
      cmocka_unit_test(a_replacement_that_begins_at_once_keeps_the_limits_of_joints_in_motion),
      cmocka_unit_test(a_replacement_that_begins_at_once_keeps_the_limits_of_a_tip_in_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
