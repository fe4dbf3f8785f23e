// Drives: how the drives are armed, commanded and stopped.
#include "hal/cia402/drives.hpp"
#include "hal/cia402/protocol_errors.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::cia402 {

void Drives::step(const RobotCommand& command, DriveCommands& out, std::int64_t now_ns) {
  take(command.request);
  const bool follow = phase_ == Phase::kArmed && command.request == DriveRequest::kFollow;
  if (follow && !follows(command)) take(DriveRequest::kArm);  // failed: stops now
  set_controlwords(out, now_ns);
  judge_rise();
  judge_time();
  if (phase_ == Phase::kHoming) home(now_ns);
  if (phase_ == Phase::kFailed) set_controlwords(out, now_ns);
  following_ = follow && phase_ == Phase::kArmed;
  set_target(command, following_, out);
  count_confirmations();
  advance(now_ns);
  if (phase_ != Phase::kReleasing && phase_ != Phase::kHoming) request_ = {};
}

void Drives::count_confirmations() {
  LoopBound<kDof> joints;
  for (Joint& joint : joints_) {
    joints.tick();
    const bool off = goal() == Goal::kDisabled && joint.machine.reached();
    if (!off) joint.confirmed = 0;
    if (off && joint.last.fresh && joint.confirmed < kConfirming) ++joint.confirmed;
  }
}

void Drives::set_controlwords(DriveCommands& out, std::int64_t now_ns) {
  for (int j = 0; j < kDof; ++j) {
    Joint& joint = joints_[static_cast<std::size_t>(j)];
    std::uint16_t word = joint.machine.step(joint.last.statusword, goal_of(j), now_ns);
    if (homes(j) && homing_.step == Homing::Step::kMove && word == kEnableOperation)
      word |= kStartHoming;
    out[static_cast<std::size_t>(j)].controlword = word;
  }
}

/// A fault stays until the drives are requested to be disabled; only then they can be armed again.
void Drives::take(DriveRequest request) {
  if (request == DriveRequest::kDisable) {
    if (phase_ != Phase::kOff) phase_ = Phase::kStopping;
  } else if (phase_ == Phase::kOff) {
    phase_ = Phase::kSwitchingOn;
    since_ns_ = -1;
    rise_left_ = most_rise_;
    homing_.homed = 0;
    failure_ = {};
    for (Joint& joint : joints_) {
      joint.reason = Status::kOk;
      joint.owed = 0;
    }
    for (int j = 0; j < kDof; ++j)
      if (!ready(j)) return;
  }
}

/// Refuses to arm a drive that was lost, does not know its position, or has moved in an arming.
bool Drives::ready(int j) {
  const Joint& joint = joints_[static_cast<std::size_t>(j)];
  const DriveFeedback& last = joint.last;
  if (last.lost != Status::kOk) {
    fail(j, last.lost, last.error_code, lost_text(last.lost));
  } else if (!referenced(j) && settings_->homing_method[j] == 0.0) {
    fail(j, Status::kNotReferenced, last.error_code, "the drive is not referenced; home it");
  } else if (j == moved_) {
    const Figures figures = {joint.q - moved_from_, settings_->hold_tolerance};
    fail(j, Status::kMoved, last.error_code, "left its place while it was held, is ",
         " rad from there ([cia402] hold_tolerance is ",
         " rad), and would move on; mend the cause, then start the program anew", &figures);
  }
  return phase_ != Phase::kFailed;
}

Goal Drives::goal() const {
  switch (phase_) {
    case Phase::kSwitchingOn:
    case Phase::kHoming: return Goal::kSwitchedOn;
    case Phase::kEnabling:
    case Phase::kReleasing:
    case Phase::kArmed: return Goal::kOperationEnabled;
    case Phase::kOff:
    case Phase::kStopping:
    case Phase::kFailed: break;
  }
  return Goal::kDisabled;
}

/// Of one drive: the one that is homed is enabled alone.
Goal Drives::goal_of(int j) const {
  return homes(j) && homing_.enables() ? Goal::kOperationEnabled : goal();
}

/// A drive that goes to fault on its way, falls back again and again, or stays in a state for too
/// long, ends arming.
void Drives::judge_rise() {
  for (int j = 0; j < kDof && rising(); ++j) {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    if (joint.machine.faulted())
      fail(j, Status::kDriveFault, joint.last.error_code,
           "went to fault while it was armed: ", error_text(joint.last.error_code));
    else if (joint.machine.falls_back())
      fail(j, Status::kDriveFault, joint.last.error_code,
           "has fallen back more than 3 times while it was armed, now to '",
           name(joint.machine.state()), "'; look at its supply and its enable input");
    else if (joint.machine.late())
      fail(j, Status::kDriveFault, joint.last.error_code, "stays in '", name(joint.machine.state()),
           "' for longer than [cia402] step_ms or reset_ms");
  }
}

/// Names the joint that all others wait for a cycle before the executive, which does not know it,
/// ends arming.
void Drives::judge_time() {
  if (!rising() || --rise_left_ > 1) return;
  int late = -1;  // the last that is not where it is to be
  LoopBound<kDof> joints;
  for (int j = 0; j < kDof; ++j) {
    joints.tick();
    if (!joints_[static_cast<std::size_t>(j)].machine.reached()) late = j;
  }
  if (phase_ == Phase::kHoming) late = homing_.joint;
  if (late < 0) return;
  const Joint& joint = joints_[static_cast<std::size_t>(late)];
  fail(late, Status::kArmingTime, joint.last.error_code,
       "is not enabled within [executive] arming_ms, but in '", name(joint.machine.state()), "'");
}

/// A drive that was lost cannot say that it has stopped; its own watchdogs stop it.
bool Drives::all_reached() const {
  bool all = true;
  for (const Joint& joint : joints_) {
    const bool gone = phase_ == Phase::kStopping && joint.last.lost != Status::kOk;
    all &= joint.machine.reached() || gone;
  }
  return all;
}

/// The arm is not enabled where its positions cannot be.
void Drives::judge_steadiness() {
  const Figures figures = {jump_, limits_.dq_max[unsteady_] * period_s_};
  fail(unsteady_, Status::kStateInvalid,
       joints_[static_cast<std::size_t>(unsteady_)].last.error_code, "its position jumps by ",
       " rad in a period, more than it can move, ",
       " rad, for longer than [cia402] step_ms; check encoder, increments and gear_ratio",
       &figures);
}

/// Goes to the next phase when all drives have done the present one.
void Drives::advance(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::kSwitchingOn:
      if (!all_reached() || since_ns_ < 0) since_ns_ = now_ns;
      if (all_reached() && steady_ >= kSteady) go_up(now_ns);
      if (now_ns - since_ns_ > settings_->step_ms * kMillisecond_ns && rising()) judge_steadiness();
      break;
    case Phase::kEnabling:
      if (all_reached()) enter(Phase::kReleasing, now_ns);
      break;
    case Phase::kReleasing:
      // To the nearest cycle: a wake-up some microseconds early must not cost a whole one.
      if (now_ns - since_ns_ + half_period_ns() >= settings_->held_ms() * kMillisecond_ns &&
          checked_ == kDof)
        enter(Phase::kArmed, now_ns);
      break;
    case Phase::kStopping:
      if (all_reached()) enter(Phase::kOff, now_ns);
      break;
    case Phase::kOff:
    case Phase::kHoming:
    case Phase::kArmed:
    case Phase::kFailed: break;
  }
}

void Drives::enter(Phase phase, std::int64_t now_ns) {
  phase_ = phase;
  since_ns_ = now_ns;
  if (phase == Phase::kOff)
    for (Joint& joint : joints_) joint.reason = Status::kOk;
  if (phase == Phase::kReleasing) {
    checked_ = 0;
    ask(0, kModeDisplay);
  }
  if (phase != Phase::kEnabling) return;
  for (int j = 0; j < kDof; ++j) held_[j] = joints_[static_cast<std::size_t>(j)].q;
  hold_.start(held_);
}

void Drives::ask(int joint, const Object& object) {
  request_ = {++asked_, joint, object, false, 0};
}

void Drives::tell(int joint, const Object& object, std::int8_t value) {
  request_ = {++asked_, joint, object, true, static_cast<std::uint8_t>(value)};
}

void Drives::answer(std::uint32_t value, const ObjectRefusal& refused) {
  request_ = {};
  if (phase_ == Phase::kReleasing) return judge_mode(value, refused);
  if (phase_ != Phase::kHoming) return;
  if (refused.status != Status::kOk)
    return fail(homing_.joint, refused.status, 0, homing_.refused_text(), refused.why);
  homing_.answered = true;
  homing_.shown = static_cast<Mode>(value);
}

/// While the brakes open, every drive is asked for the mode that it is in.
void Drives::judge_mode(std::uint32_t value, const ObjectRefusal& refused) {
  constexpr const char* kWhat = "its display of the mode of operation (6061h) ";
  const auto mode = static_cast<Mode>(value);
  if (refused.status != Status::kOk)
    return fail(checked_, refused.status, 0, kWhat, "cannot be read: ", refused.why);
  if (mode != mode_of(mode_))
    return fail(checked_, Status::kDriveFault, 0, kWhat, "is not that of the commands, but ",
                name(mode));
  if (++checked_ < kDof) ask(checked_, kModeDisplay);
}

/// False, and a fault, for a command that the drives cannot take.
bool Drives::follows(const RobotCommand& command) {
  const bool same = command.mode == mode_;
  if (!same) fail(0, Status::kNotOffered, 0, "a command of another mode than that of connecting");
  for (int j = 0; j < kDof && same; ++j) {
    const double sum = command.value[j] + command.dq_ff[j] + command.tau_ff[j];
    if (!(sum - sum == 0.0)) fail(j, Status::kCommandNotFinite, 0, "its command is not finite");
  }
  return phase_ == Phase::kArmed;
}

/// Before the drives are enabled the targets are those that move nothing: where the joints are, and
/// no torque. The same after a stop.
void Drives::set_target(const RobotCommand& command, bool follow, DriveCommands& out) {
  const bool holds = goal() == Goal::kOperationEnabled;
  JointVector q, dq;
  for (int j = 0; j < kDof; ++j) {
    q[j] = joints_[static_cast<std::size_t>(j)].q;
    dq[j] = joints_[static_cast<std::size_t>(j)].dq;
  }
  if (!holds || follow) held_ = q;
  const JointVector tau = holds ? effort(command, follow, q, dq) : JointVector(JointVector::Zero());
  LoopBound<kDof> joints;
  for (int j = 0; j < kDof; ++j) {
    joints.tick();
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    DriveCommand to;
    to.controlword = out[static_cast<std::size_t>(j)].controlword;
    to.homes = joint.homes && !(homes(j) && homing_.returns());
    to.target_torque = joint.units.torque(tau[j]);
    to.target_position = joint.count_of(follow ? command.value[j] : held_[j]);
    if (follow) {
      to.target_velocity = joint.units.velocity(command.value[j]);
      to.velocity_offset = joint.units.velocity(command.dq_ff[j]);
      to.torque_offset = joint.units.torque(command.tau_ff[j]);
    }
    out[static_cast<std::size_t>(j)] = to;
  }
}

/// Of the targets, only those of the mode are sent (the bus's layout); torque is the one that moves
/// an arm by itself.
JointVector Drives::effort(const RobotCommand& command, bool follow, const JointVector& q,
                           const JointVector& dq) {
  if (mode_ != CommandMode::kEffort) return JointVector::Zero();
  if (!follow) return hold_.step(q, dq);
  hold_.track(q, command.value);
  return command.value;
}

}  // namespace tactus::cia402
