// Tests the guard on commanded positions and velocities. The limiters of a single joint have their
// own tests: test_position_limiter.cpp and test_velocity_limiter.cpp.
#include "tests/guard/guard_bench.hpp"

namespace tactus {
namespace {

// Proves GRD-2.

void a_command_of_another_mode_than_was_started_is_refused(void**) {
  for (const CommandMode mode :
       {CommandMode::kPosition, CommandMode::kVelocity, CommandMode::kEffort}) {
    for (const CommandMode other :
         {CommandMode::kPosition, CommandMode::kVelocity, CommandMode::kEffort}) {
      GuardBench bench;
      bench.mode = mode;
      bench.start();
      RobotCommand command = {other, JointVector::Zero()};
      ASSERT_STATUS(bench.guard.limit(bench.state, command),
                    mode == other ? Status::kOk : Status::kNotStarted);
    }
  }
}

// Proves GRD-4.

void positions_and_velocities_begin_with_what_is_measured(void**) {
  for (const CommandMode mode : {CommandMode::kPosition, CommandMode::kVelocity}) {
    GuardBench bench;
    bench.mode = mode;
    bench.state.dq.setConstant(0.2);      // irrelevant here
    bench.state.tau.setConstant(1000.0);  // irrelevant here
    bench.start();
    const JointVector held = mode == CommandMode::kPosition ? bench.state.q : bench.state.dq;
    assert_true(bench.sent(held) == held);
    assert_int_equal(bench.telemetry().limited_cycles, 0);
  }
}

void every_joint_is_limited_by_its_own_limits_and_flagged(void**) {
  for (const CommandMode mode : {CommandMode::kPosition, CommandMode::kVelocity}) {
    GuardBench bench;
    bench.mode = mode;
    bench.start();
    const JointLimits& limits = bench.params.limits;
    const JointVector from = mode == CommandMode::kPosition ? bench.state.q : JointVector::Zero();
    const double scale = mode == CommandMode::kPosition ? kPeriod_s * kPeriod_s : kPeriod_s;
    const JointVector sent = bench.sent(from + JointVector::Ones());
    ASSERT_NEAR((sent - from - scale * limits.ddq_max).cwiseAbs().maxCoeff(), 0.0, 1e-10);
    assert_int_equal(bench.telemetry().limited_cycles, 1);
    assert_int_equal(bench.telemetry().jerky_cycles, 1);
    assert_int_equal(bench.telemetry().limited_joints, (1 << kDof) - 1);
  }
}

void the_position_margin_counts_for_what_is_sent(void**) {
  for (const CommandMode mode : {CommandMode::kPosition, CommandMode::kVelocity}) {
    GuardBench bench;
    bench.mode = mode;
    bench.params.position_margin.setConstant(0.1);
    bench.start();
    const JointLimits& limits = bench.params.limits;
    const double way_s = (limits.q_max - limits.q_min).cwiseQuotient(limits.dq_max).maxCoeff();
    for (int k = 0; k * kPeriod_s < way_s + 1.0; ++k) {
      const JointVector sent = bench.sent(100.0);
      bench.state.q = mode == CommandMode::kPosition ? sent : bench.state.q + kPeriod_s * sent;
    }
    const JointVector end = limits.q_max - JointVector::Constant(0.1);
    ASSERT_NEAR((bench.state.q - end).cwiseAbs().maxCoeff(), 0.0, 1e-8);
  }
}

// Proves GRD-8.

void a_robot_that_does_not_follow_trips_and_names_joint_error_and_limit(void**) {
  for (int i = 0; i < kDof; ++i) {
    for (const double sign : {1.0, -1.0}) {
      GuardBench bench;
      bench.mode = CommandMode::kPosition;
      bench.params.following_error.setConstant(0.05);
      bench.params.following_time.setConstant(0.02);
      bench.start();
      const double sent = bench.state.q[i];
      bench.state.q[i] = sent + sign * 0.049;
      ASSERT_OK(bench.check());
      bench.state.q[i] = sent + sign * 0.051;
      bench.trips_on(Status::kFollowingError, i);
      ASSERT_NEAR(bench.telemetry().tripped_value, 0.051, kRounding);
      ASSERT_NEAR(bench.telemetry().tripped_limit, 0.05, kRounding);
      bench.state.dq[i] = -sign * 0.1;  // 0.052 at this speed, in either direction
      ASSERT_OK(bench.check());
      bench.state.q[i] = sent + sign * 0.053;
      bench.trips_on(Status::kFollowingError, i);
    }
  }
}

void the_error_counts_from_what_was_sent_not_from_what_was_wanted(void**) {
  GuardBench bench;
  bench.mode = CommandMode::kPosition;
  bench.start();
  bench.sent(JointVector(bench.state.q + JointVector::Ones()));
  ASSERT_OK(bench.check());
  for (int k = 0; k < 1000; ++k) bench.sent(JointVector(bench.state.q + 0.5 * JointVector::Ones()));
  bench.trips_on(Status::kFollowingError, 0);
}

void nothing_has_to_be_followed_where_no_positions_are_sent(void**) {
  for (const CommandMode mode : {CommandMode::kVelocity, CommandMode::kEffort}) {
    GuardBench bench;
    bench.mode = mode;
    bench.start();
    bench.state.q.array() += 0.5;
    ASSERT_OK(bench.check());
  }
}

// Proves GRD-10.

/// The command is far ahead of the position sent, and stays there.
void a_braked_arm_does_not_catch_up_with_its_command(void**) {
  GuardBench bench;
  bench.mode = CommandMode::kPosition;
  bench.start();
  const JointVector room = 0.9 * (bench.params.limits.q_max - bench.state.q);
  const JointVector wanted = bench.state.q + room.cwiseMin(1.0);
  JointVector sent = bench.state.q, step = JointVector::Zero();
  const auto send = [&](bool braked) {
    RobotCommand command = {bench.mode, wanted};
    ASSERT_OK(bench.guard.limit(bench.state, command, braked));
    step = command.value - sent;
    sent = command.value;
  };
  for (int k = 0; k < 100; ++k) send(false);
  const JointVector begin = sent, dq = step / kPeriod_s, a = bench.params.limits.ddq_max;
  for (int k = 0; k < 1000; ++k) send(true);
  assert_true(step.isZero(0.0));
  const JointVector way = dq.cwiseProduct(dq).cwiseQuotient(2.0 * a);
  assert_true((sent - begin - way).maxCoeff() <= 1e-9);
  for (int k = 0; k < 3000; ++k) send(false);
  ASSERT_NEAR((sent - wanted).norm(), 0.0, 1e-9);
}

void a_braked_arm_whose_velocity_cannot_be_followed_comes_to_rest(void**) {
  GuardBench bench;
  bench.mode = CommandMode::kVelocity;
  bench.start();
  for (int k = 0; k < 50; ++k) bench.sent(2.0);
  for (int k = 0; k < 300; ++k) {
    RobotCommand command = {bench.mode, JointVector::Constant(2.0)};
    ASSERT_OK(bench.guard.limit(bench.state, command, true));
    if (k == 299) assert_true(command.value.isZero(0.0));
  }
}

/// A command that brakes within its limits prevails: the arm brakes on its path.
void a_braked_arm_follows_what_it_can(void**) {
  GuardBench bench;
  bench.mode = CommandMode::kPosition;
  bench.start();
  double q = 0.0, dq = 0.0;
  const double a = 0.9 * bench.params.limits.ddq_max.minCoeff();
  for (int k = 0; k < 200; ++k) {
    dq += (k < 100 ? a : -a) * kPeriod_s;
    q += dq * kPeriod_s;
    RobotCommand command = {bench.mode, bench.state.q + JointVector::Constant(q)};
    const JointVector wanted = command.value;
    ASSERT_OK(bench.guard.limit(bench.state, command, k >= 100));
    assert_true(command.value == wanted);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_command_of_another_mode_than_was_started_is_refused),
      cmocka_unit_test(positions_and_velocities_begin_with_what_is_measured),
      cmocka_unit_test(every_joint_is_limited_by_its_own_limits_and_flagged),
      cmocka_unit_test(the_position_margin_counts_for_what_is_sent),
      cmocka_unit_test(a_robot_that_does_not_follow_trips_and_names_joint_error_and_limit),
      cmocka_unit_test(the_error_counts_from_what_was_sent_not_from_what_was_wanted),
      cmocka_unit_test(nothing_has_to_be_followed_where_no_positions_are_sent),
      cmocka_unit_test(a_braked_arm_does_not_catch_up_with_its_command),
      cmocka_unit_test(a_braked_arm_whose_velocity_cannot_be_followed_comes_to_rest),
      cmocka_unit_test(a_braked_arm_follows_what_it_can),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
