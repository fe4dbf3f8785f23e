#include "sim_plant/ur/programs/external_control.hpp"

namespace tactus::ur {
namespace {

using ScriptInts = std::array<std::int32_t, kScriptCommandInts>;

constexpr double kSpeedAcceleration = 40.0;  // rad/s^2
constexpr int kAttempts = 5;
constexpr double kRetry_s = 0.2;
constexpr double kLog_s = 5.0;  // between two log messages of the same kind
constexpr int kMessagesAtOnce = 64;

constexpr std::string_view kCommandSocket = "script_command_socket";
constexpr double kContact = 0.3;  // fraction of the torque that counts as a collision
constexpr int kCommandsAtOnce = 8;
enum Contact : std::int32_t { kTouched = 0, kEndedWithout = 1 };

double value(const ScriptInts& command, std::size_t i) {
  return command[i] / kFixedPoint;
}

Vector3 three(const ScriptInts& command, std::size_t first) {
  return {value(command, first), value(command, first + 1), value(command, first + 2)};
}

Vector6 six(const ScriptInts& command, std::size_t first) {
  Vector6 values;
  values << three(command, first), three(command, first + 3);
  return values;
}

void start_force_mode(const ScriptInts& command, Machine& machine) {
  ForceMode force;
  force.task_frame = six(command, 1);
  force.selection = six(command, 7);
  force.wrench = six(command, 13);
  force.type = static_cast<int>(value(command, 19));
  force.limits = six(command, 20);
  machine.force_damping = value(command, 26);
  machine.start_force_mode(force);
}

bool touches(const Machine& machine) {
  const Joints share = machine.body.residual().cwiseAbs().cwiseQuotient(machine.settings.collision);
  return share.maxCoeff() > kContact;
}

}  // namespace

ProgramStep ExternalControl::poll(Machine& machine) {
  switch (phase_) {
    case Phase::kConnecting: return connect(machine);
    case Phase::kRunning:
      read_commands(machine);
      read_reverse(machine);
      return ProgramStep::kRunning;
    case Phase::kJoining:
      if (machine.motion.busy() || trajectory_.active()) return ProgramStep::kRunning;
      phase_ = Phase::kRunning;
      enter(waiting_, machine);
      read_reverse(machine);
      return ProgramStep::kRunning;
    case Phase::kEnding:
      if (machine.motion.busy()) return ProgramStep::kRunning;
      for (const std::string_view name : kExternalSockets)
        if (Link* link = machine.links.find(name)) link->close();
      phase_ = halts_ ? Phase::kEnded : Phase::kBehind;
      rest_.start(text_.behind, text_.behind_line, true);
      return poll(machine);
    case Phase::kBehind: return rest_.poll(machine);
    case Phase::kEnded: break;
  }
  return ProgramStep::kEnded;
}

ProgramStep ExternalControl::connect(Machine& machine) {
  while (connected_ < text_.places.size()) {
    const SocketPlace& place = text_.places[connected_];
    Link* link = machine.links.find(kExternalSockets[connected_]);
    if (link == nullptr) return ProgramStep::kEnded;
    if (place.port == 0 || link->open()) {
      ++connected_;
      attempts_ = 0;
      continue;
    }
    if (link->state() == Link::State::kFailed) {
      link->close();
      retry_at_s_ = machine.time_s() + kRetry_s;
      if (++attempts_ == kAttempts) give_up(machine);
    }
    if (attempts_ >= kAttempts) return ProgramStep::kRunning;
    if (link->state() == Link::State::kClosed && machine.time_s() >= retry_at_s_)
      link->want(kExternalSockets[connected_], place.host, place.port);
    return ProgramStep::kRunning;
  }
  machine.messages.text("ExternalControl: External control active");
  phase_ = Phase::kRunning;
  return poll(machine);
}

/// Closes all sockets; the popup waits for an operator.
void ExternalControl::give_up(Machine& machine) {
  for (std::size_t i = 0; i < connected_; ++i)
    if (Link* link = machine.links.find(kExternalSockets[i])) link->close();
  machine.messages.popup("Error connecting to remote", "a socket could not be opened", false, true);
}

void ExternalControl::read_reverse(Machine& machine) {
  Link* link = machine.links.find(kExternalSockets[2]);
  Message message;
  for (int n = 0; n < kMessagesAtOnce && phase_ == Phase::kRunning; ++n) {
    if (trajectory_.clearing()) return;
    if (link == nullptr || !link->read_ints(message.data(), message.size())) {
      silent_s_ += n == 0 ? machine.cycle_s() : 0.0;
      const bool late = timeout_s_ > 0.0 && silent_s_ > timeout_s_ + 1e-9;
      if (!late && link != nullptr && !link->at_end(message.size())) return;
      machine.messages.text(
          "Socket timed out waiting for command on reverse_socket. The script will exit now.");
      return leave(text_.halts_when_silent, machine);
    }
    silent_s_ = 0.0;
    take(message, machine);
  }
}

void ExternalControl::take(const Message& message, Machine& machine) {
  timeout_s_ = message[0] / 1000.0;
  const auto mode = static_cast<ControlMode>(message[7]);
  if (mode_ == ControlMode::kToolInContact && tool_contact_) return;  // the detection ends first
  if (mode == mode_) return obey(message, machine);
  // The old motion ends before the new one begins.
  if (mode_ == ControlMode::kForward) trajectory_.leave(machine);
  if (!trajectory_.active() && !machine.motion.resting()) machine.motion.stop_j(kStopDeceleration);
  if (mode_ == ControlMode::kFreedrive) machine.freedrive = false;
  mode_ = ControlMode::kIdle;
  if (machine.motion.busy() || trajectory_.active()) {
    waiting_ = message;
    phase_ = Phase::kJoining;
    return;
  }
  enter(message, machine);
}

void ExternalControl::enter(const Message& message, Machine& machine) {
  mode_ = static_cast<ControlMode>(message[7]);
  if (mode_ == ControlMode::kStopped) return leave(false, machine);
  if (mode_ == ControlMode::kServoJ || mode_ == ControlMode::kPose) {
    servo_q_ = machine.body.q();
    servo_ = Servo::kNone;
  }
  if (mode_ == ControlMode::kTorque)
    machine.messages.popup("", "Torques are only supported from software 5.23.0", false, true);
  obey(message, machine);
}

void ExternalControl::obey(const Message& message, Machine& machine) {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = message[static_cast<std::size_t>(i) + 1] / kFixedPoint;
  Joints q;
  switch (mode_) {
    case ControlMode::kServoJ: return set_point(values, machine);
    case ControlMode::kPose:
      if (inverse(Frame::of(values), machine.motion.tool(), servo_q_, q))
        return set_point(q, machine);
      machine.messages.runtime_exception(1, 1, "runtime_error:no inverse kinematics");
      return leave(true, machine);
    case ControlMode::kSpeedJ:
    case ControlMode::kSpeedL: speed_ = values; return;
    case ControlMode::kForward: return forward(message, machine);
    case ControlMode::kFreedrive:
      if (message[1] != 0) machine.freedrive = message[1] > 0;
      return;
    default: return;
  }
}

void ExternalControl::forward(const Message& message, Machine& machine) {
  switch (message[1]) {
    case kForwardStart: return trajectory_.start(message[2], false, machine);
    case kForwardStreamStart: return trajectory_.start(0, true, machine);
    case kForwardStreamEnd: return trajectory_.end_stream(message[2]);
    case kForwardCancel: return trajectory_.cancel(message[2], machine);
    default: return;
  }
}

void ExternalControl::set_point(const Joints& q, Machine& machine) {
  const double most = kIgnoreSpeed * machine.cycle_s();
  servo_ = Servo::kNew;
  if ((q - servo_q_).cwiseAbs().maxCoeff() <= most ||
      (q - machine.body.q()).cwiseAbs().maxCoeff() <= most) {
    servo_q_ = q;
    if (warned_) machine.messages.text("ExternalControl: set-points are near enough again");
    warned_ = false;
    return;
  }
  if (!warned_)
    machine.messages.popup("External Control speed limit",
                           "A set-point is too far away and is ignored", true, false);
  if (!warned_ || machine.time_s() >= log_at_s_) {
    machine.messages.text("ExternalControl: a set-point is too far away and is ignored");
    log_at_s_ = machine.time_s() + kLog_s;
  }
  warned_ = true;
}

void ExternalControl::leave(bool halts, Machine& machine) {
  machine.freedrive = false;
  mode_ = ControlMode::kStopped;
  halts_ = halts;
  phase_ = Phase::kEnding;
  machine.motion.stop_j(kStopDeceleration);
}

ProgramStep ExternalControl::command(Machine& machine) {
  if (phase_ == Phase::kBehind) return rest_.command(machine);
  if (trajectory_.active() && phase_ != Phase::kEnding) {
    const ProgramStep step = trajectory_.command(machine);
    return step == ProgramStep::kEnded ? ProgramStep::kWaiting : step;
  }
  if (phase_ != Phase::kRunning) return ProgramStep::kWaiting;
  switch (mode_) {
    case ControlMode::kServoJ:
    case ControlMode::kPose: return servo(machine);
    case ControlMode::kSpeedJ:
      machine.motion.speed_j(speed_, kSpeedAcceleration, machine.cycle_s());
      return ProgramStep::kRunning;
    case ControlMode::kSpeedL:
      machine.motion.speed_l(speed_, kSpeedAcceleration, machine.cycle_s());
      return ProgramStep::kRunning;
    default: return ProgramStep::kWaiting;
  }
}

/// Servos to the new target, or goes on from the last one at the present target speed.
ProgramStep ExternalControl::servo(Machine& machine) {
  if (servo_ == Servo::kNone) return ProgramStep::kWaiting;
  if (servo_ == Servo::kOld) servo_q_ += machine.motion.dq() * machine.cycle_s();
  servo_ = Servo::kOld;
  machine.motion.servo_j(servo_q_, machine.cycle_s(), text_.law);
  return machine.motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

// The commands of external control that are not motions. They come over a socket of their own, and
// only the tool contact detection answers.

void ExternalControl::read_commands(Machine& machine) {
  Link* link = machine.links.find(kCommandSocket);
  if (link == nullptr) return;
  ScriptInts command;
  for (int n = 0; n < kCommandsAtOnce && link->read_ints(command.data(), command.size()); ++n)
    obey_command(command, *link, machine);
  const bool watches = tool_contact_ && mode_ != ControlMode::kToolInContact;
  if (!watches || trajectory_.clearing() || !touches(machine)) return;
  trajectory_.drop(machine);
  machine.freedrive = false;
  machine.motion.stop_j(kStopDeceleration);
  mode_ = ControlMode::kToolInContact;
  link->send_int(kTouched);
}

void ExternalControl::obey_command(const ScriptInts& command, Link& link, Machine& machine) {
  switch (static_cast<ScriptCommand>(command[0])) {
    case ScriptCommand::kSetTargetPayload:
    case ScriptCommand::kSetPayload:
      return machine.set_payload(value(command, 1), three(command, 2));
    case ScriptCommand::kSetToolVoltage:
      machine.io.tool_voltage = static_cast<std::int32_t>(value(command, 1));
      return;
    case ScriptCommand::kStartForceMode: return start_force_mode(command, machine);
    case ScriptCommand::kEndForceMode: machine.force_mode = {}; return;
    case ScriptCommand::kStartToolContact: tool_contact_ = true; return;
    case ScriptCommand::kEndToolContact:
      if (mode_ != ControlMode::kToolInContact) link.send_int(kEndedWithout);
      tool_contact_ = false;
      return;
    case ScriptCommand::kSetTcpOffset: return machine.set_tcp(six(command, 1));
    default: return;  // of the e-Series, or without effect on a stiff arm
  }
}

}  // namespace tactus::ur
