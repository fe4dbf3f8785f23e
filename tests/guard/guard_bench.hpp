// A guard with the FER's limits: 1 N m per cycle of a millisecond, 87 N m at joint 1, 12 N m at
// joint 7.
#pragma once

#include "kernel/guard/guard.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kPeriod_s = 1e-3;
inline constexpr double kRounding = 1e-12;

/// A guard started on an arm at rest in the middle of its range, with no torque.
struct GuardBench {
  Guard::Params params;
  RobotState state;
  CommandMode mode = CommandMode::kEffort;
  Guard guard;
  CycleTime now;

  GuardBench() {
    state.q = 0.5 * (params.limits.q_min + params.limits.q_max);
    state.drives.fill({DriveState::kEnabled, true});
  }
  void start() { ASSERT_OK(start(kPeriod_s)); }
  Status start(double period_s) { return guard.start(params, mode, state, period_s, now); }
  Status check() { return guard.check(state, now); }
  /// Returns the value that is sent when `wanted` is commanded.
  JointVector sent(const JointVector& wanted) {
    RobotCommand command = {mode, wanted};
    ASSERT_OK(guard.limit(state, command));
    return command.value;
  }
  JointVector sent(double wanted) { return sent(JointVector(JointVector::Constant(wanted))); }
  const Guard::Telemetry& telemetry() const { return guard.telemetry(); }
  void trips_on(Status expected, int joint) {
    ASSERT_STATUS(check(), expected);
    assert_int_equal(telemetry().tripped_joint, joint);
  }
};

}  // namespace tactus
