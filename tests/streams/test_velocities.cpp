// Velocity references: reached and held within limits, in the axes of the base or of the tip, short
// of position limits, and at rest when they are not renewed.
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

template <class Space>
std::uint32_t drive(MotionBench<Space>& bench, const Velocity<Space>& velocity) {
  std::uint32_t id = 0;
  return bench.client.send(velocity, id).ok() ? id : 0;
}
Velocity<JointSpace> turn(double dq, double timeout_s) {
  Velocity<JointSpace> velocity;
  velocity.rates[0] = dq;
  velocity.timeout_s = timeout_s;
  return velocity;
}

// Proves RG-30.

void a_joint_velocity_is_reached_held_and_ended_by_its_timeout(void**) {
  CheckedJoints bench;
  const std::uint32_t id = drive(bench, turn(0.8, 0.5));
  bench.run(0.4);
  ASSERT_NEAR(bench.out().dq[0], 0.8, 1e-12);
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kExecuted);
  double before = bench.out().dq[0];
  while (!bench.out().standing() && bench.generator.time_s() < 3.0) {
    bench.cycle();
    assert_true(bench.out().dq[0] <= before + 1e-12 && bench.out().dq[0] >= -1e-12);
    before = bench.out().dq[0];
  }
  assert_true(bench.generator.time_s() < 0.7);
  assert_int_equal(name(bench.generator.phase())[0], 'h');  // holding
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kStarved);
}

void renewed_in_time_it_goes_on_and_the_newest_counts(void**) {
  CheckedJoints bench;
  for (int k = 0; k < 20; ++k) {
    drive(bench, turn(k < 10 ? 0.5 : -0.3, 0.1));
    bench.run(0.05);
  }
  ASSERT_NEAR(bench.out().dq[0], -0.3, 1e-12);
  assert_int_equal(static_cast<std::uint32_t>(bench.client.stream().starved), 0);
}

void shares_of_acceleration_and_jerk_are_kept(void**) {
  CheckedJoints bench;
  Velocity<JointSpace> gentle = turn(1.0, 2.0);
  gentle.acceleration = 0.2;
  gentle.jerk = 0.1;
  drive(bench, gentle);
  const SymmetricLimits limits = axis_limits(0);
  double before = 0.0;
  for (int k = 0; k < 1500; ++k) {
    bench.cycle();
    const double a = bench.out().ddq[0];
    assert_true(std::abs(a) <= 0.2 * limits.a * (1.0 + 1e-9));
    assert_true(std::abs(a - before) <= 0.1 * limits.j * 1e-3 * (1.0 + 1e-9) + 1e-12);
    before = a;
  }
  ASSERT_NEAR(bench.out().dq[0], 1.0, 1e-12);
}

/// A gentler velocity that comes while the joint still gains speed does not take it beyond a limit.
void less_jerk_in_the_middle_of_a_change_keeps_the_velocity_limit(void**) {
  const double fastest = axis_limits(0).v;
  CheckedJoints bench;
  drive(bench, turn(fastest, 2.0));
  while (bench.out().dq[0] < 0.99 * fastest) bench.cycle();
  assert_true(bench.out().ddq[0] > 0.0);
  Velocity<JointSpace> gentle = turn(fastest, 2.0);
  gentle.jerk = 0.05;
  drive(bench, gentle);
  bench.run(0.5);
  ASSERT_NEAR(bench.out().dq[0], fastest, 1e-9);
}

/// It brakes in time, comes to rest at the end of the range, and can be driven back.
void a_joint_rests_at_the_end_of_its_range(void**) {
  CheckedJoints bench;
  const JointLimits limits;
  for (const double sign : {1.0, -1.0}) {
    drive(bench, turn(sign * limits.dq_max[0], 10.0));
    bench.run((limits.q_max[0] - limits.q_min[0]) / limits.dq_max[0] + 1.0);
    assert_true(bench.out().standing());
    const double end = sign > 0.0 ? limits.q_max[0] : limits.q_min[0];
    ASSERT_NEAR(bench.out().q[0], end, 1e-6);
  }
}

template <class Fields>
void expect_twist(const TaskSpace::Point& now, const Fields& v) {
  ASSERT_NEAR((now.v - v).norm(), 0.0, 1e-3);
}

void a_twist_is_given_in_the_axes_of_base_tip_or_frame(void**) {
  Vector6 twist;
  twist << 0.05, -0.02, 0.03, 0.1, 0.0, -0.2;
  Velocity<TaskSpace> velocity;
  velocity.rates = twist;
  velocity.timeout_s = 5.0;
  CheckedTip base;
  drive(base, velocity);
  base.run(0.5);
  expect_twist(base.out(), twist);
  velocity.in_tool = true;
  CheckedTip tip;
  drive(tip, velocity);
  tip.run(0.5);
  const Matrix3 R = tip.out().x.r.toRotationMatrix();
  Vector6 turned;
  turned << R * twist.head<3>(), R * twist.tail<3>();
  expect_twist(tip.out(), turned);
  velocity.in_tool = false;
  const Pose table = {{0.5, 0.0, 0.0}, exp_so3({0.3, -0.2, 1.0})};
  CheckedTip frame;
  std::uint32_t id = 0;
  ASSERT_OK(frame.client.send(velocity, id, {&table, nullptr}).status);
  frame.run(0.5);
  const Matrix3 F = table.r.toRotationMatrix();
  turned << F * twist.head<3>(), F * twist.tail<3>();
  expect_twist(frame.out(), turned);
}

void a_tip_stays_in_its_workspace(void**) {
  CheckedTip bench;
  bench.channel.settings.limits.p_max = bench.home.x.p + Vector3(0.2, 0.1, 0.3);
  bench.set_speed(1.0);
  Velocity<TaskSpace> velocity;
  velocity.rates << 0.3, 0.2, 0.1, 0.0, 0.0, 0.3;
  velocity.timeout_s = 3.0;
  drive(bench, velocity);
  bench.run(5.0);
  assert_true(bench.out().standing());
  assert_true(bench.out().x.p[1] > bench.home.x.p[1] + 0.09);
}

void a_bad_velocity_is_refused_and_a_duplicate_dropped(void**) {
  CheckedJoints bench;
  std::uint32_t id = 0;
  const auto refused = [&](const Velocity<JointSpace>& velocity) {
    return bench.client.send(velocity, id).status;
  };
  ASSERT_STATUS(refused(turn(100.0, 1.0)), Status::kVelocityLimit);
  ASSERT_STATUS(refused(turn(0.1, 0.0)), Status::kReferenceTime);
  ASSERT_STATUS(refused(turn(std::nan(""), 1.0)), Status::kReferenceNotFinite);
  Velocity<JointSpace> velocity = turn(0.1, 1.0);
  velocity.jerk = 0.0;
  ASSERT_STATUS(refused(velocity), Status::kBadValue);
  velocity = turn(0.1, 1.0);
  velocity.epoch = velocity.sequence = 1;
  assert_true(drive(bench, velocity) != 0);
  bench.run(0.01);
  const std::uint32_t again = drive(bench, velocity);
  bench.run(0.01);
  ASSERT_STATUS(bench.report_of(again).outcome, Outcome::kSuperseded);
  bench.cancel();
  bench.run(0.01);
  velocity.sequence = 2;
  const std::uint32_t voided = drive(bench, velocity);
  bench.run(0.01);
  ASSERT_STATUS(bench.report_of(voided).verdict.status, Status::kEpochVoid);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_velocity_is_reached_held_and_ended_by_its_timeout),
      cmocka_unit_test(renewed_in_time_it_goes_on_and_the_newest_counts),
      cmocka_unit_test(shares_of_acceleration_and_jerk_are_kept),
      cmocka_unit_test(less_jerk_in_the_middle_of_a_change_keeps_the_velocity_limit),
      cmocka_unit_test(a_joint_rests_at_the_end_of_its_range),
      cmocka_unit_test(a_twist_is_given_in_the_axes_of_base_tip_or_frame),
      cmocka_unit_test(a_tip_stays_in_its_workspace),
      cmocka_unit_test(a_bad_velocity_is_refused_and_a_duplicate_dropped),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
