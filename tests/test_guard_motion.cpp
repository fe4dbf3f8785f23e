// The guard where positions or velocities are commanded. What the limiters of one joint do is in
// test_position_limiter.cpp and test_velocity_limiter.cpp.
#include "tests/guard_bench.hpp"

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
    bench.state.dq.setConstant(0.2), bench.state.tau.setConstant(1000.0);  // no matter here
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
    for (int k = 0; k < 5000; ++k) {
      const JointVector sent = bench.sent(100.0);
      bench.state.q = mode == CommandMode::kPosition ? sent : bench.state.q + kPeriod_s * sent;
    }
    const JointVector end = bench.params.limits.q_max - JointVector::Constant(0.1);
    ASSERT_NEAR((bench.state.q - end).cwiseAbs().maxCoeff(), 0.0, 1e-8);
  }
}

// Proves GRD-8.

void a_robot_that_does_not_follow_trips_and_names_joint_error_and_limit(void**) {
  for (int i = 0; i < kDof; ++i) {
    for (const double sign : {1.0, -1.0}) {
      GuardBench bench;
      bench.mode = CommandMode::kPosition;
      bench.params.following_error.setConstant(0.05), bench.params.following_time.setConstant(0.02);
      bench.start();
      const double sent = bench.state.q[i];
      bench.state.q[i] = sent + sign * 0.049;
      ASSERT_OK(bench.guard.check(bench.state));
      bench.state.q[i] = sent + sign * 0.051;
      bench.trips_on(Status::kFollowingError, i);
      ASSERT_NEAR(bench.telemetry().tripped_value, 0.051, kRounding);
      ASSERT_NEAR(bench.telemetry().tripped_limit, 0.05, kRounding);
      bench.state.dq[i] = -sign * 0.1;  // 0.052 at this speed, whichever way
      ASSERT_OK(bench.guard.check(bench.state));
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
  ASSERT_OK(bench.guard.check(bench.state));
  for (int k = 0; k < 1000; ++k) bench.sent(JointVector(bench.state.q + 0.5 * JointVector::Ones()));
  bench.trips_on(Status::kFollowingError, 0);
}

void nothing_has_to_be_followed_where_no_positions_are_sent(void**) {
  for (const CommandMode mode : {CommandMode::kVelocity, CommandMode::kEffort}) {
    GuardBench bench;
    bench.mode = mode;
    bench.start();
    bench.state.q.array() += 0.5;
    ASSERT_OK(bench.guard.check(bench.state));
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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
