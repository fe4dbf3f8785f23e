// Drives: how a drive that does not know its position finds it, in arming.
//
// Homing is a motion of the drive's own, without the guard. Only a drive that shows that it is not
// referenced is homed, alone: all others are switched on, with their brakes closed.
#include "hal/cia402/drives.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::cia402 {

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
  enter(Phase::kEnabling, now_ns);
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
  enter(Phase::kHoming, now_ns);
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
      return tell(j, kModeOfOperation, static_cast<std::int8_t>(Mode::kHoming));
    case Homing::Step::kMethod:
      return tell(j, kHomingMethod, static_cast<std::int8_t>(settings_->homing_method[j]));
    case Homing::Step::kReturn:
      return tell(j, kModeOfOperation, static_cast<std::int8_t>(mode_of(mode_)));
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
    return enter(Phase::kSwitchingOn, now_ns);
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

/// A joint that was homed is where its drive says, and that must be in its range.
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
