// The motion commands of ur_rtde's program.
#include "sim_plant/ur/programs/register_program.hpp"
#include "sim_plant/ur/script/script_calls.hpp"
#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

using Program = RegisterProgram;

Program::Outcome Program::move_j(Machine& machine) {
  break_off(machine);
  return begin_move(
      machine.motion.move_j(six(0, machine), input(7, machine), input(6, machine), 0.0),
      Code::kCloseToJointLimit, machine);
}

Program::Outcome Program::move_j_pose(Machine& machine) {
  Joints q;
  Motion& motion = machine.motion;
  if (!inverse(Frame::of(six(0, machine)), motion.tool(), motion.q(), q))
    return no_posture(machine);
  break_off(machine);
  return begin_move(motion.move_j(q, input(7, machine), input(6, machine), 0.0),
                    Code::kCloseToJointLimit, machine);
}

Program::Outcome Program::move_l(Machine& machine) {
  break_off(machine);
  return begin_move(
      machine.motion.move_l(Frame::of(six(0, machine)), input(7, machine), input(6, machine), 0.0),
      Code::kSingularity, machine);
}

Program::Outcome Program::move_l_joints(Machine& machine) {
  break_off(machine);
  Motion& motion = machine.motion;
  return begin_move(motion.move_l(forward(six(0, machine)) * motion.tool(), input(7, machine),
                                  input(6, machine), 0.0),
                    Code::kSingularity, machine);
}

/// Runs the lines that the client wrote into the function for a path.
Program::Outcome Program::move_path(Machine& machine) {
  break_off(machine);
  constexpr std::string_view kPath = "def exec_move_path():\n";
  const std::size_t at = text_.find(kPath);
  if (at == std::string_view::npos) return Outcome::kDone;
  path_ = text_.substr(at + kPath.size());
  return begin(machine);
}

Program::Outcome Program::begin_move(bool good, Code otherwise, Machine& machine) {
  if (good) return begin(machine);
  machine.protective_stop({otherwise, 0});
  return Outcome::kEnded;
}

/// Begins a motion that the client waits for, or an asynchronous one.
Program::Outcome Program::begin(Machine& machine) {
  cyclic_ = Cyclic::kNone;
  jogging_ = false;
  moving_ = progress_.told() && integer_input(1, machine) == 1;
  if (!moving_) return Outcome::kMoves;
  tell_progress(0, machine);
  return Outcome::kDone;
}

/// Ends an asynchronous motion, whatever comes next.
void Program::break_off(Machine& machine) {
  path_ = {};
  if (moving_ && progress_.tells_broken_off()) tell_progress(-1, machine);
  moving_ = false;
}

/// Runs the path up to a line that takes time, or to its end.
void Program::follow_path(Machine& machine) {
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

Program::Outcome Program::servo_j(Machine& machine) {
  return servo(six(0, machine), machine);
}

Program::Outcome Program::servo_l(Machine& machine) {
  Joints q;
  const Motion& motion = machine.motion;
  if (!inverse(Frame::of(six(0, machine)), motion.tool(), motion.q(), q))
    return no_posture(machine);
  return servo(q, machine);
}

Program::Outcome Program::servo(const Joints& q, Machine& machine) {
  cyclic_ = Cyclic::kServo;
  goal_ = q;
  t_ = input(8, machine);
  law_ = {input(10, machine), input(9, machine)};
  return Outcome::kDone;
}

Program::Outcome Program::servo_c(Machine& machine) {
  cyclic_ = Cyclic::kServoC;
  goal_ = six(0, machine);
  v_ = input(6, machine);
  a_ = input(7, machine);
  return Outcome::kDone;
}

Program::Outcome Program::speed_j(Machine& machine) {
  cyclic_ = Cyclic::kSpeedJ;
  goal_ = six(0, machine);
  a_ = input(6, machine);
  t_ = input(7, machine);
  return Outcome::kDone;
}

Program::Outcome Program::speed_l(Machine& machine) {
  speed_j(machine);
  cyclic_ = Cyclic::kSpeedL;
  return Outcome::kDone;
}

/// Starts a speed in the axes of the base (0), of the present tool (1) or of a frame (2). Later
/// speeds use the same axes.
Program::Outcome Program::jog_start(Machine& machine) {
  const bool tells_acceleration = has("jog_acc");
  const double feature = input(6, machine);
  if (!jogging_) {
    jog_frame_ = {};
    if (feature == 1.0) jog_frame_ = forward(machine.body.q()) * machine.motion.tool();
    if (feature == 2.0) jog_frame_ = Frame::of(six(tells_acceleration ? 8 : 7, machine));
  }
  jogging_ = true;
  cyclic_ = Cyclic::kSpeedL;
  const Vector6 speed = six(0, machine);
  goal_ << jog_frame_.r * speed.head<3>(), jog_frame_.r * speed.tail<3>();
  a_ = tells_acceleration ? input(7, machine) : 0.5;
  t_ = 0.0;
  return Outcome::kDone;
}

Program::Outcome Program::jog_stop(Machine& machine) {
  return stop(1.2, machine);
}

Program::Outcome Program::speed_stop(Machine& machine) {
  return stop(has("deceleration_rate") ? input(0, machine) : 10.0, machine);
}

Program::Outcome Program::servo_stop(Machine& machine) {
  return stop(has("deceleration_rate") ? input(0, machine) : 20.0, machine);
}

/// Integers 1: type, 2 to 7: selection; doubles 0 to 17: frame, wrench, limits.
Program::Outcome Program::force_mode(Machine& machine) {
  ForceMode mode;
  mode.type = integer_input(1, machine);
  for (int i = 0; i < 6; ++i) mode.selection[i] = integer_input(2 + i, machine);
  mode.task_frame = six(0, machine);
  mode.wrench = six(6, machine);
  mode.limits = six(12, machine);
  machine.start_force_mode(mode);
  return Outcome::kDone;
}

Program::Outcome Program::force_mode_stop(Machine& machine) {
  machine.force_mode = {};
  return stop(10.0, machine);
}

/// Stops an asynchronous move; newer texts need not wait for the stop.
Program::Outcome Program::stop_async(Machine& machine) {
  break_off(machine);
  stop(input(0, machine), machine);
  return has("thread stop_thread():") ? begin(machine) : Outcome::kMoves;
}

Program::Outcome Program::stop(double a, Machine& machine) {
  cyclic_ = Cyclic::kNone;
  jogging_ = false;
  machine.motion.stop_j(a);
  return Outcome::kMoves;
}

}  // namespace tactus::ur
