#include "sim_plant/ur/programs/external_control.hpp"

namespace tactus::ur {
namespace {

constexpr double kSpeedAcceleration = 40.0;  // rad/s^2
constexpr int kAttempts = 5;
constexpr double kRetry_s = 0.2;
constexpr double kLog_s = 5.0;  // between two log messages of the same kind
constexpr int kMessagesAtOnce = 64;

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
      for (const std::string_view name : kSockets)
        if (Link* link = machine.links.find(name)) link->close();
      phase_ = halts_ ? Phase::kEnded : Phase::kBehind;
      rest_.start(behind_, behind_line_, true);
      return poll(machine);
    case Phase::kBehind: return rest_.poll(machine);
    case Phase::kEnded: break;
  }
  return ProgramStep::kEnded;
}

ProgramStep ExternalControl::connect(Machine& machine) {
  while (connected_ < places_.size()) {
    const SocketPlace& place = places_[connected_];
    Link* link = machine.links.find(kSockets[connected_]);
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
      link->want(kSockets[connected_], place.host, place.port);
    return ProgramStep::kRunning;
  }
  machine.messages.text("ExternalControl: External control active");
  phase_ = Phase::kRunning;
  return poll(machine);
}

/// Closes all sockets; the popup waits for an operator.
void ExternalControl::give_up(Machine& machine) {
  for (std::size_t i = 0; i < connected_; ++i)
    if (Link* link = machine.links.find(kSockets[i])) link->close();
  machine.messages.popup("Error connecting to remote", "a socket could not be opened", false, true);
}

void ExternalControl::read_reverse(Machine& machine) {
  Link* link = machine.links.find(kSockets[2]);
  Message message;
  for (int n = 0; n < kMessagesAtOnce && phase_ == Phase::kRunning; ++n) {
    if (trajectory_.clearing()) return;
    if (link == nullptr || !link->read_ints(message.data(), message.size())) {
      silent_s_ += n == 0 ? machine.cycle_s() : 0.0;
      const bool late = timeout_s_ > 0.0 && silent_s_ > timeout_s_ + 1e-9;
      if (!late && link != nullptr && !link->at_end(message.size())) return;
      machine.messages.text(
          "Socket timed out waiting for command on reverse_socket. The script will exit now.");
      return leave(halts_when_silent_, machine);
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
  machine.motion.servo_j(servo_q_, machine.cycle_s(), law_);
  return machine.motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

}  // namespace tactus::ur
