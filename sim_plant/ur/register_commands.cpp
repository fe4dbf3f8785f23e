// The commands of ur_rtde's program. A command without a row is done at once: it sets what the
// emulated controller does not have.
#include "sim_plant/ur/register_program.hpp"

namespace tactus::ur {

using Command = RegisterCommand;
using Program = RegisterProgram;

const Program::Row Program::kRows[] = {
    {Command::kMoveJ, Shake::kDone, &Program::move_j, {}},
    {Command::kMoveJPose, Shake::kDone, &Program::move_j_pose, {}},
    {Command::kMoveL, Shake::kDone, &Program::move_l, {}},
    {Command::kMoveLJoints, Shake::kDone, &Program::move_l_joints, {}},
    {Command::kMovePath, Shake::kDone, &Program::move_path, {}},
    {Command::kStopL, Shake::kDone, &Program::stop_async, {}},
    {Command::kStopJ, Shake::kDone, &Program::stop_async, {}},
    {Command::kServoJ, Shake::kReady, &Program::servo_j, {}},
    {Command::kServoL, Shake::kReady, &Program::servo_l, {}},
    {Command::kServoC, Shake::kDone, &Program::servo_c, {}},
    {Command::kServoStop, Shake::kDone, &Program::servo_stop, {}},
    {Command::kSpeedJ, Shake::kReady, &Program::speed_j, {}},
    {Command::kSpeedL, Shake::kReady, &Program::speed_l, {}},
    {Command::kSpeedStop, Shake::kDone, &Program::speed_stop, {}},
    {Command::kJogStart, Shake::kDone, &Program::jog_start, {}},
    {Command::kJogStop, Shake::kDone, &Program::jog_stop, {}},
    {Command::kForceMode, Shake::kReady, &Program::force_mode, {}},
    {Command::kForceModeStop, Shake::kDone, &Program::force_mode_stop, {}},
    {Command::kTeachMode, Shake::kDone, &Program::teach_mode, {}},
    {Command::kEndTeachMode, Shake::kDone, &Program::end_teach_mode, {}},
    {Command::kSetPayload, Shake::kDone, &Program::set_payload, {}},
    {Command::kSetTcp, Shake::kDone, &Program::set_tcp, {}},
    {Command::kProtectiveStop, Shake::kDone, &Program::protective_stop, "protective_stop()"},
    {Command::kWatchdog, Shake::kDone, &Program::set_watchdog, {}},
    {Command::kInverse, Shake::kDone, &Program::inverse_here, {}},
    {Command::kInverseNear, Shake::kDone, &Program::inverse_near, {}},
    {Command::kHasInverse, Shake::kDone, &Program::has_inverse, "get_inverse_kin_has_solution("},
    {Command::kHasInverseNear, Shake::kDone, &Program::has_inverse_near,
     "get_inverse_kin_has_solution("},
    {Command::kPoseWithinLimits, Shake::kDone, &Program::has_inverse, {}},
    {Command::kJointsWithinLimits, Shake::kDone, &Program::joints_within, {}},
    {Command::kForward, Shake::kDone, &Program::forward_here, {}},
    {Command::kForwardOf, Shake::kDone, &Program::forward_of, {}},
    {Command::kPoseTrans, Shake::kDone, &Program::pose_trans, {}},
    {Command::kTcpOffset, Shake::kDone, &Program::tcp_offset, "get_tcp_offset()"},
    {Command::kSteady, Shake::kDone, &Program::steady, {}},
    {Command::kFlangePose, Shake::kBoth, &Program::flange_pose, {}},
    {Command::kJointTorques, Shake::kReady, &Program::joint_torques, {}},
    // What only an e-Series does: in the text of a CB3 there is nothing to do.
    {Command::kToolContact, Shake::kReady, nullptr, {}},
    {Command::kStepTime, Shake::kReady, nullptr, {}},
    {Command::kPositionHistory, Shake::kReady, nullptr, {}},
    {Command::kTorque, Shake::kReady, nullptr, {}},
    {Command::kMassMatrix, Shake::kReady, nullptr, {}},
    {Command::kCoriolis, Shake::kReady, nullptr, {}},
    {Command::kTargetAccelerations, Shake::kReady, nullptr, {}},
    {Command::kJacobian, Shake::kReady, nullptr, {}},
    {Command::kJacobianRate, Shake::kReady, nullptr, {}},
};

const Program::Row& Program::row_of(Command command) {
  static constexpr Row kOther = {Command::kNone, Shake::kDone, nullptr, {}};
  for (const Row& row : kRows)
    if (row.command == command) return row;
  return kOther;
}

Program::Outcome Program::set_payload(Machine& machine) {
  machine.set_payload(input(0, machine),
                      Vector3(input(1, machine), input(2, machine), input(3, machine)));
  return Outcome::kDone;
}

Program::Outcome Program::set_tcp(Machine& machine) {
  machine.set_tcp(six(0, machine));
  return Outcome::kDone;
}

Program::Outcome Program::teach_mode(Machine& machine) {
  machine.freedrive = true;
  return Outcome::kDone;
}

Program::Outcome Program::end_teach_mode(Machine& machine) {
  machine.freedrive = false;
  return Outcome::kDone;
}

Program::Outcome Program::protective_stop(Machine& machine) {
  machine.protective_stop({Code::kFromScript, 0});
  return Outcome::kEnded;
}

/// On the register of the commands, whichever offset the text has.
Program::Outcome Program::set_watchdog(Machine& machine) {
  machine.watchdogs.set({FieldType::kInt32, Input::kInts, static_cast<std::uint8_t>(int_offset_)},
                        input(0, machine), LateAction::kStop, machine.cycle);
  return Outcome::kDone;
}

}  // namespace tactus::ur
