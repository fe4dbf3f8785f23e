// The commands of ur_rtde's program. What is not emulated is done at once by a CB3: it sets
// something that the emulated controller does not have. On an e-Series it ends the program, as the
// client would take it for done.
#include <algorithm>

#include "sim_plant/ur/programs/register_program.hpp"
#include "sim_plant/ur/script/script_calls.hpp"
#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

using Command = RegisterCommand;
using Outcome = RegisterProgram::Outcome;

RegisterProgram::Handshake RegisterProgram::handshake_of(Command command) {
  switch (command) {
    case Command::kFlangePose: return Handshake::kBoth;
    case Command::kServoJ:
    case Command::kServoL:
    case Command::kSpeedJ:
    case Command::kSpeedL:
    case Command::kForceMode:
    case Command::kJointTorques:
    // Commands of the e-Series only; in the text of a CB3 they do nothing.
    case Command::kToolContact:
    case Command::kStepTime:
    case Command::kPositionHistory:
    case Command::kTorque:
    case Command::kMassMatrix:
    case Command::kCoriolis:
    case Command::kTargetAccelerations:
    case Command::kJacobian:
    case Command::kJacobianRate: return Handshake::kReady;
    default: return Handshake::kDone;
  }
}

Outcome RegisterProgram::act(Command command, Machine& machine) {
  if (const auto moved = move(command, machine)) return *moved;
  if (const auto led = lead(command, machine)) return *led;
  if (const auto set_up = set(command, machine)) return *set_up;
  if (const auto answered = answer(command, machine)) return *answered;
  return not_emulated(command, machine);
}

/// Moves to the target in the doubles 0 to 5, with the speed in 6 and the acceleration in 7. Paths
/// and stops are moves too.
std::optional<Outcome> RegisterProgram::move(Command command, Machine& machine) {
  Motion& motion = machine.motion;
  const Vector6 target = six(0, machine);
  const double v = input(6, machine), a = input(7, machine);
  Joints q = target;
  switch (command) {
    case Command::kMoveJPose:
      if (!inverse(Frame::of(target), motion.tool(), motion.q(), q)) return no_posture(machine);
      [[fallthrough]];
    case Command::kMoveJ:
      break_off(machine);
      return begin_move(motion.move_j(q, a, v, 0.0), Code::kCloseToJointLimit, machine);
    case Command::kMoveL:
    case Command::kMoveLJoints: {
      const bool joints = command == Command::kMoveLJoints;
      break_off(machine);
      return begin_move(
          motion.move_l(joints ? forward(q) * motion.tool() : Frame::of(target), a, v, 0.0),
          Code::kSingularity, machine);
    }
    case Command::kMovePath: return move_path(machine);
    case Command::kStopL:
    case Command::kStopJ:  // of an asynchronous move; newer texts need not wait for the stop
      break_off(machine);
      stop(target[0], machine);
      return has("thread stop_thread():") ? begin(machine) : Outcome::kMoves;
    default: return {};
  }
}

/// Runs the lines that the client wrote into the function for a path.
Outcome RegisterProgram::move_path(Machine& machine) {
  break_off(machine);
  constexpr std::string_view kPath = "def exec_move_path():\n";
  const std::size_t at = text_.find(kPath);
  if (at == std::string_view::npos) return Outcome::kDone;
  path_ = text_.substr(at + kPath.size());
  return begin(machine);
}

Outcome RegisterProgram::begin_move(bool good, Code otherwise, Machine& machine) {
  if (good) return begin(machine);
  machine.protective_stop({otherwise, 0});
  return Outcome::kEnded;
}

/// Begins a motion that the client waits for, or an asynchronous one.
Outcome RegisterProgram::begin(Machine& machine) {
  cyclic_ = Cyclic::kNone;
  jogging_ = false;
  moving_ = progress_.told() && integer_input(1, machine) == 1;
  if (!moving_) return Outcome::kMoves;
  tell_progress(0, machine);
  return Outcome::kDone;
}

/// Ends an asynchronous motion, whatever comes next.
void RegisterProgram::break_off(Machine& machine) {
  path_ = {};
  if (moving_ && progress_.tells_broken_off()) tell_progress(-1, machine);
  moving_ = false;
}

/// Runs the path up to a line that takes time, or to its end.
void RegisterProgram::follow_path(Machine& machine) {
  std::string_view line;
  while (next_line(path_, line)) {
    std::string_view code = trimmed(without_comment(line));
    if (leading_name(code) == "end") break;
    ScriptCall call;
    if (!read_call(code, {}, call)) continue;
    if (call.name == "signal_async_progress") {
      tell_progress(integer(call.number("value", 0, 0.0)), machine);
      continue;
    }
    if (run_call(call, true, machine).result == CallResult::kNoReach)
      machine.protective_stop({Code::kCloseToJointLimit, 0});
    if (machine.motion.busy()) return;
  }
  path_ = {};
}

/// Sets or ends the command that is given in every cycle.
std::optional<Outcome> RegisterProgram::lead(Command command, Machine& machine) {
  const Vector6 values = six(0, machine);
  const double rate = has("deceleration_rate") ? values[0] : -1.0;
  switch (command) {
    case Command::kServoL:
    case Command::kServoJ: {
      const Motion& motion = machine.motion;
      Joints q = values;
      if (command == Command::kServoL && !inverse(Frame::of(values), motion.tool(), motion.q(), q))
        return no_posture(machine);
      follow(Cyclic::kServo, q, 0.0, input(8, machine));
      law_ = {input(10, machine), input(9, machine)};
      return Outcome::kDone;
    }
    case Command::kServoC:
      follow(Cyclic::kServoC, values, input(7, machine), 0.0);
      v_ = input(6, machine);
      return Outcome::kDone;
    case Command::kSpeedJ:
    case Command::kSpeedL:
      follow(command == Command::kSpeedJ ? Cyclic::kSpeedJ : Cyclic::kSpeedL, values,
             input(6, machine), input(7, machine));
      return Outcome::kDone;
    case Command::kJogStart: return jog(values, machine);
    case Command::kJogStop: return stop(1.2, machine);
    case Command::kServoStop: return stop(rate < 0.0 ? 20.0 : rate, machine);
    case Command::kSpeedStop: return stop(rate < 0.0 ? 10.0 : rate, machine);
    case Command::kForceModeStop: machine.force_mode = {}; return stop(10.0, machine);
    default: return {};
  }
}

void RegisterProgram::follow(Cyclic cyclic, const Vector6& goal, double a, double t) {
  cyclic_ = cyclic;
  goal_ = goal;
  a_ = a;
  t_ = t;
}

/// Starts a speed in the axes of the base (0), of the present tool (1) or of a frame (2). Later
/// speeds use the same axes.
Outcome RegisterProgram::jog(const Vector6& speed, Machine& machine) {
  const bool tells_acceleration = has("jog_acc");
  const double feature = input(6, machine);
  if (!jogging_) {
    jog_frame_ = {};
    if (feature == 1.0) jog_frame_ = forward(machine.body.q()) * machine.motion.tool();
    if (feature == 2.0) jog_frame_ = Frame::of(six(tells_acceleration ? 8 : 7, machine));
  }
  jogging_ = true;
  Vector6 goal;
  goal << jog_frame_.r * speed.head<3>(), jog_frame_.r * speed.tail<3>();
  follow(Cyclic::kSpeedL, goal, tells_acceleration ? input(7, machine) : 0.5, 0.0);
  return Outcome::kDone;
}

Outcome RegisterProgram::stop(double a, Machine& machine) {
  cyclic_ = Cyclic::kNone;
  jogging_ = false;
  machine.motion.stop_j(a);
  return Outcome::kMoves;
}

std::optional<Outcome> RegisterProgram::set(Command command, Machine& machine) {
  const Vector6 values = six(0, machine);
  switch (command) {
    case Command::kZeroFtSensor: machine.zero_force(); break;
    case Command::kTeachMode: machine.freedrive = true; break;
    case Command::kEndTeachMode: machine.freedrive = false; break;
    case Command::kSetPayload: machine.set_payload(values[0], values.segment<3>(1)); break;
    case Command::kSetTcp: machine.set_tcp(values); break;
    case Command::kProtectiveStop:
      if (!has("protective_stop()")) break;
      machine.protective_stop({Code::kFromScript, 0});
      return Outcome::kEnded;
    case Command::kWatchdog:  // on the command register, at the offset of the text
      machine.watchdogs.set(
          {FieldType::kInt32, Input::kInts, static_cast<std::uint8_t>(int_offset_)}, values[0],
          LateAction::kStop, machine.cycle);
      break;
    case Command::kForceMode: {  // integers 1: type, 2 to 7: selection
      ForceMode mode;
      mode.type = integer_input(1, machine);
      for (int i = 0; i < 6; ++i) mode.selection[i] = integer_input(2 + i, machine);
      mode.task_frame = values;
      mode.wrench = six(6, machine);
      mode.limits = six(12, machine);
      machine.start_force_mode(mode);
      break;
    }
    default: return {};
  }
  return Outcome::kDone;
}

/// Answers with a flag in the second integer, or with six numbers in the first doubles.
std::optional<Outcome> RegisterProgram::answer(Command command, Machine& machine) {
  const Frame& tool = machine.motion.tool();
  const Vector6 values = six(0, machine), second = six(6, machine);
  const bool near = command == Command::kInverseNear || command == Command::kHasInverseNear;
  Joints q;
  const auto reachable = [&] {
    return inverse(Frame::of(values), tool, near ? second : machine.motion.q(), q);
  };
  switch (command) {
    case Command::kInverse:
    case Command::kInverseNear: return reachable() ? answer_six(q, machine) : no_posture(machine);
    case Command::kHasInverse:
    case Command::kHasInverseNear:
      if (!has("get_inverse_kin_has_solution(")) return Outcome::kDone;
      [[fallthrough]];
    case Command::kPoseWithinLimits: return answer_flag(reachable(), machine);
    case Command::kJointsWithinLimits:
      return answer_flag((values.array().abs() <= machine.settings.motion.position).all(), machine);
    case Command::kSteady: return answer_flag(machine.motion.resting(), machine);
    case Command::kForward:
      return answer_six((forward(machine.measured_q()) * tool).pose(), machine);
    case Command::kForwardOf:
      return answer_six((forward(values) * Frame::of(second)).pose(), machine);
    case Command::kFlangePose: return answer_six(forward(machine.measured_q()).pose(), machine);
    case Command::kPoseTrans:
      return answer_six((Frame::of(values) * Frame::of(second)).pose(), machine);
    case Command::kTcpOffset:
      return has("get_tcp_offset()") ? answer_six(machine.tcp_offset, machine) : Outcome::kDone;
    case Command::kJointTorques:  // without those that hold and move the arm itself
      return answer_six(machine.body.residual(), machine);
    default: return {};
  }
}

Outcome RegisterProgram::answer_flag(bool flag, Machine& machine) const {
  write(1, flag ? 1 : 0, machine);
  return Outcome::kDone;
}

/// Answers six values; NaN is not answered.
Outcome RegisterProgram::answer_six(const Vector6& values, Machine& machine) const {
  auto* doubles = machine.io.output.doubles.data() + double_offset_;
  if (values.allFinite()) std::copy(values.begin(), values.end(), doubles);
  return Outcome::kDone;
}

}  // namespace tactus::ur
