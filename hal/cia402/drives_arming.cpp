// Drives: arming with homing, and stopping.
//
// Homing is a motion of the drive's own, without the guard. Only a drive that shows that it is not
// referenced is homed, alone: all others are switched on, with their brakes closed.
#include "hal/cia402/drives.hpp"
#include "hal/cia402/protocol_errors.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::cia402 {

void Drives::step(const RobotCommand& command, DriveCommands& out, std::int64_t now_ns) {
  take(command.request);
  const bool follow = phase_ == ArmingPhase::kArmed && command.request == DriveRequest::kFollow;
  if (follow && !follows(command)) take(DriveRequest::kArm);  // failed: stops now
  set_controlwords(out, now_ns);
  judge_rise();
  judge_time();
  if (phase_ == ArmingPhase::kHoming) home(now_ns);
  if (phase_ == ArmingPhase::kFailed) set_controlwords(out, now_ns);
  following_ = follow && phase_ == ArmingPhase::kArmed;
  set_target(command, following_, out);
  count_confirmations();
  advance(now_ns);
  if (phase_ != ArmingPhase::kReleasing && phase_ != ArmingPhase::kHoming) request_ = {};
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
    if (phase_ != ArmingPhase::kOff) phase_ = ArmingPhase::kStopping;
  } else if (phase_ == ArmingPhase::kOff) {
    phase_ = ArmingPhase::kSwitchingOn;
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

/// Refuses to arm a drive that was lost, has no position reference, or has moved during arming.
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
  return phase_ != ArmingPhase::kFailed;
}

Goal Drives::goal() const {
  switch (phase_) {
    case ArmingPhase::kSwitchingOn:
    case ArmingPhase::kHoming: return Goal::kSwitchedOn;
    case ArmingPhase::kEnabling:
    case ArmingPhase::kReleasing:
    case ArmingPhase::kArmed: return Goal::kOperationEnabled;
    case ArmingPhase::kOff:
    case ArmingPhase::kStopping:
    case ArmingPhase::kFailed: break;
  }
  return Goal::kDisabled;
}

/// Goal of one drive: a drive is enabled alone while it is homed.
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
  if (phase_ == ArmingPhase::kHoming) late = homing_.joint;
  if (late < 0) return;
  const Joint& joint = joints_[static_cast<std::size_t>(late)];
  fail(late, Status::kArmingTime, joint.last.error_code,
       "is not enabled within [executive] arming_ms, but in '", name(joint.machine.state()), "'");
}

/// A drive that was lost cannot say that it has stopped; its own watchdogs stop it.
bool Drives::all_reached() const {
  bool all = true;
  for (const Joint& joint : joints_) {
    const bool gone = phase_ == ArmingPhase::kStopping && joint.last.lost != Status::kOk;
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
    case ArmingPhase::kSwitchingOn:
      if (!all_reached() || since_ns_ < 0) since_ns_ = now_ns;
      if (all_reached() && steady_ >= kSteady) go_up(now_ns);
      if (now_ns - since_ns_ > settings_->step_ms * kMillisecond_ns && rising()) judge_steadiness();
      break;
    case ArmingPhase::kEnabling:
      if (all_reached()) enter(ArmingPhase::kReleasing, now_ns);
      break;
    case ArmingPhase::kReleasing:
      // To the nearest cycle: a wake-up some microseconds early must not cost a whole one.
      if (now_ns - since_ns_ + half_period_ns() >= settings_->held_ms() * kMillisecond_ns &&
          checked_ == kDof)
        enter(ArmingPhase::kArmed, now_ns);
      break;
    case ArmingPhase::kStopping:
      if (all_reached()) enter(ArmingPhase::kOff, now_ns);
      break;
    case ArmingPhase::kOff:
    case ArmingPhase::kHoming:
    case ArmingPhase::kArmed:
    case ArmingPhase::kFailed: break;
  }
}

void Drives::enter(ArmingPhase phase, std::int64_t now_ns) {
  phase_ = phase;
  since_ns_ = now_ns;
  if (phase == ArmingPhase::kOff)
    for (Joint& joint : joints_) joint.reason = Status::kOk;
  if (phase == ArmingPhase::kReleasing) {
    checked_ = 0;
    ask(0, kModeDisplay);
  }
  if (phase != ArmingPhase::kEnabling) return;
  for (int j = 0; j < kDof; ++j) held_[j] = joints_[static_cast<std::size_t>(j)].q;
  hold_.start(held_);
}

void Drives::ask(int joint, const Object& object) {
  request_ = {++asked_, joint, object, false, 0};
}

void Drives::write_object(int joint, const Object& object, std::int8_t value) {
  request_ = {++asked_, joint, object, true, static_cast<std::uint8_t>(value)};
}

void Drives::answer(std::uint32_t value, const ObjectRefusal& refused) {
  request_ = {};
  if (phase_ == ArmingPhase::kReleasing) return judge_mode(value, refused);
  if (phase_ != ArmingPhase::kHoming) return;
  if (refused.status != Status::kOk)
    return fail(homing_.joint, refused.status, 0, homing_.refused_text(), refused.why);
  homing_.answered = true;
  homing_.shown = static_cast<Mode>(value);
}

/// While the brakes open, the mode of every drive is read.
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

bool Drives::referenced(int j) const {
  const int bit = settings_->referenced_bit;
  return bit < 0 || (joints_[static_cast<std::size_t>(j)].last.statusword >> bit & 1U) != 0;
}

/// True, too, for a drive that was stopped before it had the mode of the commands again.
bool Drives::needs_homing(int j) const {
  return settings_->homing_method[j] != 0.0 &&
         (joints_[static_cast<std::size_t>(j)].homes || !referenced(j));
}

Message Drives::to_home() const {
  Message text;
  for (int j = 0; j < kDof; ++j)
    if (needs_homing(j))
      text << (text.empty() ? "" : ", ") << std::string_view(joint_text(j)) << " (method "
           << settings_->homing_method[j] << ")";
  return text;
}

/// All drives are switched on: homes the next that needs it, then enables them.
void Drives::go_up(std::int64_t now_ns) {
  for (int j = 0; j < kDof; ++j)
    if (needs_homing(j)) return begin_homing(j, now_ns);
  LoopBound<kDof> joints;
  for (int j = 0; j < kDof; ++j) {
    joints.tick();
    if (!ready(j) || !judge_place(j)) return;
  }
  enter(ArmingPhase::kEnabling, now_ns);
}

/// A drive is homed once in an arming: then it must show its reference, within `step_ms`.
void Drives::begin_homing(int j, std::int64_t now_ns) {
  const Joint& joint = joints_[static_cast<std::size_t>(j)];
  const std::uint32_t bit = 1U << static_cast<unsigned>(j);
  if ((homing_.homed & bit) != 0) {
    if (now_ns - since_ns_ <= settings_->step_ms * kMillisecond_ns) return;
    const Figures figures = {settings_->homing_method[j],
                             static_cast<double>(settings_->referenced_bit)};
    return fail(j, Status::kNotReferenced, joint.last.error_code, "has ended homing by method ",
                " but does not show [cia402] referenced_bit, ", "", &figures);
  }
  homing_.homed |= bit;
  homing_.joint = j;
  enter(ArmingPhase::kHoming, now_ns);
  enter(referenced(j) ? Homing::Step::kReturn : Homing::Step::kSelect, now_ns);
}

void Drives::enter(Homing::Step step, std::int64_t now_ns) {
  const int j = homing_.joint;
  homing_.step = step;
  homing_.since_ns = now_ns;
  homing_.answered = false;
  switch (step) {
    case Homing::Step::kSelect:
      joints_[static_cast<std::size_t>(j)].homes = true;
      return write_object(j, kModeOfOperation, static_cast<std::int8_t>(Mode::kHoming));
    case Homing::Step::kMethod:
      return write_object(j, kHomingMethod, static_cast<std::int8_t>(settings_->homing_method[j]));
    case Homing::Step::kReturn:
      return write_object(j, kModeOfOperation, static_cast<std::int8_t>(mode_of(mode_)));
    case Homing::Step::kSelected:
    case Homing::Step::kReturned: return ask(j, kModeDisplay);
    case Homing::Step::kMove: homing_.samples = 0; return;
    case Homing::Step::kEnable:
    case Homing::Step::kRelease:
    case Homing::Step::kDisable: break;
  }
}

/// Goes on with the homing of a drive when it has done the present step.
void Drives::home(std::int64_t now_ns) {
  using Step = Homing::Step;
  const Joint& joint = joints_[static_cast<std::size_t>(homing_.joint)];
  if (now_ns - since_ns_ > settings_->homing_ms * kMillisecond_ns) {
    const Figures figures = {settings_->homing_method[homing_.joint],
                             static_cast<double>(settings_->homing_ms)};
    return fail(homing_.joint, Status::kNotReferenced, joint.last.error_code, "homing by method ",
                " does not end within [cia402] homing_ms, ", " ms", &figures);
  }
  if (homing_.step < Step::kMove && referenced(homing_.joint))  // it was late, and is not lost
    return enter(Step::kDisable, now_ns);
  switch (homing_.step) {
    case Step::kSelect:
      if (homing_.answered) enter(Step::kSelected, now_ns);
      break;
    case Step::kSelected: return judge_display(Mode::kHoming, Step::kMethod, now_ns);
    case Step::kMethod:
      if (homing_.answered) enter(Step::kEnable, now_ns);
      break;
    case Step::kEnable:
      if (joint.machine.reached()) enter(Step::kRelease, now_ns);
      break;
    case Step::kRelease:
      if (now_ns - homing_.since_ns >= settings_->brake_ms * kMillisecond_ns)
        enter(Step::kMove, now_ns);
      break;
    case Step::kMove: return judge_motion(now_ns);
    case Step::kDisable:
      if (joint.machine.reached()) enter(Step::kReturn, now_ns);
      break;
    case Step::kReturn:
      if (homing_.answered) enter(Step::kReturned, now_ns);
      break;
    case Step::kReturned: return judge_display(mode_of(mode_), Step::kReturned, now_ns);
  }
}

/// Goes on with `next` when the drive shows the mode; the last step ends homing.
void Drives::judge_display(Mode wanted, Homing::Step next, std::int64_t now_ns) {
  if (!homing_.answered) return;
  if (homing_.shown == wanted && next != Homing::Step::kReturned) return enter(next, now_ns);
  if (homing_.shown == wanted) {
    joints_[static_cast<std::size_t>(homing_.joint)].homes = false;
    return enter(ArmingPhase::kSwitchingOn, now_ns);
  }
  homing_.answered = false;
  ask(homing_.joint, kModeDisplay);
  if (now_ns - homing_.since_ns <= settings_->step_ms * kMillisecond_ns) return;
  fail(homing_.joint, Status::kDriveFault,
       joints_[static_cast<std::size_t>(homing_.joint)].last.error_code,
       "its display of the mode of operation (6061h) ",
       wanted == Mode::kHoming ? "does not become homing within [cia402] step_ms, but is "
                               : "does not leave homing within [cia402] step_ms, but is ",
       name(homing_.shown));
}

void Drives::judge_motion(std::int64_t now_ns) {
  const DriveFeedback& last = joints_[static_cast<std::size_t>(homing_.joint)].last;
  if (!last.fresh) return;
  const Homing::Verdict verdict = homing_.take(last.statusword);
  if (verdict == Homing::Verdict::kGoesOn) return;
  if (verdict == Homing::Verdict::kAttained) return enter(Homing::Step::kDisable, now_ns);
  const Figures figures = {settings_->homing_method[homing_.joint],
                           static_cast<double>(now_ns - homing_.since_ns) * 1e-6};
  fail(homing_.joint, Status::kNotReferenced, last.error_code, "homing by method ",
       verdict == Homing::Verdict::kErrorAtRest
           ? " ended in an error (bit 13) at standstill (bit 10) after "
           : " ended in an error (bit 13) while it moved (bit 10 is 0) after ",
       " ms", &figures);
}

/// The position that a drive reports after homing must be in the joint's range.
bool Drives::judge_place(int j) {
  Joint& joint = joints_[static_cast<std::size_t>(j)];
  if (joint.placed) return true;
  joint.placed = place(j, joint.last.position);
  if (joint.placed) return true;
  const bool above = joint.q > limits_.q_max[j];
  const Figures figures = {joint.q, above ? limits_.q_max[j] : limits_.q_min[j]};
  fail(j, Status::kNotReferenced, joint.last.error_code, "is homed, and its position is then ",
       above ? " rad, above the end of its range, " : " rad, below the end of its range, ",
       " rad; correct [cia402] position_offset, direction or increments, or its home offset "
       "(607Ch)",
       &figures);
  return false;
}

}  // namespace tactus::cia402
