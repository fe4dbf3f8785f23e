// The commands of ur_rtde's program. A command without a row is done at once by a CB3: it sets
// something that the emulated controller does not have. On an e-Series what is not emulated ends
// the program, as the client would take it for done.
#include "sim_plant/ur/programs/register_program.hpp"

namespace tactus::ur {

using Command = RegisterCommand;
using Program = RegisterProgram;

const Program::Row Program::kRows[] = {
    {Command::kMoveJ, Handshake::kDone, &Program::move_j, {}},
    {Command::kMoveJPose, Handshake::kDone, &Program::move_j_pose, {}},
    {Command::kMoveL, Handshake::kDone, &Program::move_l, {}},
    {Command::kMoveLJoints, Handshake::kDone, &Program::move_l_joints, {}},
    {Command::kMovePath, Handshake::kDone, &Program::move_path, {}},
    {Command::kStopL, Handshake::kDone, &Program::stop_async, {}},
    {Command::kStopJ, Handshake::kDone, &Program::stop_async, {}},
    {Command::kServoJ, Handshake::kReady, &Program::servo_j, {}},
    {Command::kServoL, Handshake::kReady, &Program::servo_l, {}},
    {Command::kServoC, Handshake::kDone, &Program::servo_c, {}},
    {Command::kServoStop, Handshake::kDone, &Program::servo_stop, {}},
    {Command::kZeroFtSensor, Handshake::kDone, &Program::zero_force, {}},
    {Command::kSpeedJ, Handshake::kReady, &Program::speed_j, {}},
    {Command::kSpeedL, Handshake::kReady, &Program::speed_l, {}},
    {Command::kSpeedStop, Handshake::kDone, &Program::speed_stop, {}},
    {Command::kJogStart, Handshake::kDone, &Program::jog_start, {}},
    {Command::kJogStop, Handshake::kDone, &Program::jog_stop, {}},
    {Command::kForceMode, Handshake::kReady, &Program::force_mode, {}},
    {Command::kForceModeStop, Handshake::kDone, &Program::force_mode_stop, {}},
    {Command::kTeachMode, Handshake::kDone, &Program::teach_mode, {}},
    {Command::kEndTeachMode, Handshake::kDone, &Program::end_teach_mode, {}},
    {Command::kSetPayload, Handshake::kDone, &Program::set_payload, {}},
    {Command::kSetTcp, Handshake::kDone, &Program::set_tcp, {}},
    {Command::kProtectiveStop, Handshake::kDone, &Program::protective_stop, "protective_stop()"},
    {Command::kWatchdog, Handshake::kDone, &Program::set_watchdog, {}},
    {Command::kInverse, Handshake::kDone, &Program::inverse_here, {}},
    {Command::kInverseNear, Handshake::kDone, &Program::inverse_near, {}},
    {Command::kHasInverse, Handshake::kDone, &Program::has_inverse,
     "get_inverse_kin_has_solution("},
    {Command::kHasInverseNear, Handshake::kDone, &Program::has_inverse_near,
     "get_inverse_kin_has_solution("},
    {Command::kPoseWithinLimits, Handshake::kDone, &Program::has_inverse, {}},
    {Command::kJointsWithinLimits, Handshake::kDone, &Program::joints_within, {}},
    {Command::kForward, Handshake::kDone, &Program::forward_here, {}},
    {Command::kForwardOf, Handshake::kDone, &Program::forward_of, {}},
    {Command::kPoseTrans, Handshake::kDone, &Program::pose_trans, {}},
    {Command::kTcpOffset, Handshake::kDone, &Program::tcp_offset, "get_tcp_offset()"},
    {Command::kSteady, Handshake::kDone, &Program::steady, {}},
    {Command::kFlangePose, Handshake::kBoth, &Program::flange_pose, {}},
    {Command::kJointTorques, Handshake::kReady, &Program::joint_torques, {}},
    // Commands of the e-Series only; in the text of a CB3 they do nothing.
    {Command::kToolContact, Handshake::kReady, nullptr, {}},
    {Command::kStepTime, Handshake::kReady, nullptr, {}},
    {Command::kPositionHistory, Handshake::kReady, nullptr, {}},
    {Command::kTorque, Handshake::kReady, nullptr, {}},
    {Command::kMassMatrix, Handshake::kReady, nullptr, {}},
    {Command::kCoriolis, Handshake::kReady, nullptr, {}},
    {Command::kTargetAccelerations, Handshake::kReady, nullptr, {}},
    {Command::kJacobian, Handshake::kReady, nullptr, {}},
    {Command::kJacobianRate, Handshake::kReady, nullptr, {}},
};

const Program::Row& Program::row_of(Command command) {
  static constexpr Row kOther = {Command::kNone, Handshake::kDone, nullptr, {}};
  for (const Row& row : kRows)
    if (row.command == command) return row;
  return kOther;
}

Program::Outcome Program::zero_force(Machine& machine) {
  machine.zero_force();
  return Outcome::kDone;
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

/// Sets a watchdog on the command register, at the offset of the text.
Program::Outcome Program::set_watchdog(Machine& machine) {
  machine.watchdogs.set({FieldType::kInt32, Input::kInts, static_cast<std::uint8_t>(int_offset_)},
                        input(0, machine), LateAction::kStop, machine.cycle);
  return Outcome::kDone;
}

}  // namespace tactus::ur
