// A SimHal used without an executive: its drives armed, read and commanded by the test.
#pragma once

#include "sim_plant/arm/sim_hal.hpp"

namespace tactus {

inline Status measure(SimHal& hal, RobotState& state) {
  return hal.read({hal.time_ns()}, state);
}

/// Connects, arms the drives and reads the state that they hold.
inline Status arm_drives(SimHal& hal, CommandMode mode, RobotState& state) {
  TRY(hal.connect(mode));
  TRY(hal.write({mode, JointVector::Zero(), DriveRequest::kArm}));
  return measure(hal, state);
}

/// Commands the drives for one period; returns the reason if they are then not enabled.
inline Status follow(SimHal& hal, CommandMode mode, const JointVector& value,
                     const JointVector& dq_ff = JointVector::Zero()) {
  TRY(hal.write({mode, value, DriveRequest::kFollow, {}, dq_ff}));
  RobotState state;
  TRY(measure(hal, state));
  const Drive& drive = state.drives[0];
  return drive.state == DriveState::kEnabled ? Status::kOk
         : drive.state == DriveState::kFault ? drive.reason
                                             : Status::kNotStarted;
}

}  // namespace tactus
