// Drives: their settings, the feedback and its checks, and the targets sent to them.
#include "hal/cia402/drives.hpp"

#include <algorithm>
#include <limits>

#include "hal/cia402/hex.hpp"
#include "hal/cia402/protocol_errors.hpp"
#include "hal/cia402/settings_check.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::cia402 {
namespace {

constexpr auto kLargestTorque = std::numeric_limits<std::int16_t>::max();
constexpr int kLongestLimited = 1 << 24;  // cycles that are counted
constexpr auto kSmallestTorque = std::numeric_limits<std::int16_t>::min();

}  // namespace

Status Drives::configure(const Cia402Settings& settings, const Tool& tool, int period_us,
                         int arming_ms, Message& why) {
  settings_ = &settings;
  period_s_ = 1e-6 * period_us;
  most_rise_ = static_cast<int>((std::int64_t{1000} * arming_ms + period_us - 1) / period_us);
  hold_.configure(settings, tool, period_s_);
  const DriveTimes times = {settings.step_ms * kMillisecond_ns, settings.reset_ms * kMillisecond_ns,
                            settings.stop_ms * kMillisecond_ns};
  for (int j = 0; j < kDof; ++j) {
    Joint& joint = joints_[static_cast<std::size_t>(j)];
    joint.units = {settings.increments[j], settings.gear_ratio[j], settings.rated_torque[j],
                   settings.direction[j], settings.position_offset[j]};
    joint.machine.configure(times);
    why = joint_text(j);
    why << ": [cia402] ";
    TRY(judge_drive(settings, limits_, joint.units, j, why));
  }
  TRY(judge_arming_time(settings, arming_ms, why));
  why = Message("[robot] period_us is ");
  if (period_object(period_us).value == 0) {
    why << period_us << ", which a drive cannot be told: 60C2h takes a whole number up to 255 of "
        << "1 ms, 100 us, 10 us or 1 us";
    return Status::kBadValue;
  }
  why = {};
  return Status::kOk;
}

void Drives::set_velocity_units(const JointVector& units) {
  for (int j = 0; j < kDof; ++j)
    if (units[j] > 0.0) joints_[static_cast<std::size_t>(j)].units.speed = units[j];
}

Status Drives::attach(CommandMode mode, const Feedbacks& feedbacks, Message& why) {
  mode_ = mode;
  phase_ = ArmingPhase::kOff;
  failure_ = {};
  moved_ = -1;
  for (int j = 0; j < kDof; ++j) TRY(attach_joint(j, feedbacks[static_cast<std::size_t>(j)], why));
  return Status::kOk;
}

Status Drives::attach_joint(int j, const DriveFeedback& feedback, Message& why) {
  Joint& joint = joints_[static_cast<std::size_t>(j)];
  joint.reason = Status::kOk;
  joint.code = 0;
  joint.missed = joint.limited = joint.owed = joint.confirmed = 0;
  joint.homes = false;
  joint.dq = joint.tau = 0.0;
  joint.last = feedback;
  joint.placed = settings_->homing_method[j] == 0.0 || referenced(j);
  if (place(j, feedback.position) || !joint.placed) return Status::kOk;
  why = joint_text(j);
  why << ": its drive counts " << static_cast<int>(feedback.position) << " increments, which is "
      << joint.q << " rad, outside of " << limits_.q_min[j] << " to " << limits_.q_max[j]
      << " rad; reference the drive, or correct [cia402] position_offset, direction or increments";
  return Status::kNotReferenced;
}

/// Begins to follow the count of a drive; returns whether the joint is then in its range. Finds the
/// turn of a single-turn encoder that is nearest to the middle of this range, and follows one that
/// counts from 0 again in the midst of a motion.
bool Drives::place(int j, std::int32_t count) {
  Joint& joint = joints_[static_cast<std::size_t>(j)];
  joint.watch.start();
  joint.counter.start(count);
  if (settings_->encoder == Encoder::kSingleTurn) {
    const double turn = joint.units.encoder;
    const double middle = 0.5 * (limits_.q_min[j] + limits_.q_max[j]);
    const double turns =
        (middle - joint.units.q(count)) * joint.units.direction / (turn * joint.units.angle_step());
    joint.counter.start(count, static_cast<std::int64_t>(std::floor(turns + 0.5) * turn),
                        static_cast<std::int64_t>(turn));
  }
  joint.q = joint.units.q(joint.counter.total());
  return Range{limits_.q_min[j], limits_.q_max[j]}.contains(joint.q);
}

void Drives::watch(const Feedbacks& feedbacks, std::int64_t sampled_ns) {
  if (steady_ < kSteady) ++steady_;
  LoopBound<kDof> joints;
  for (int j = 0; j < kDof; ++j) {
    joints.tick();
    measure(j, feedbacks[static_cast<std::size_t>(j)], sampled_ns);
    judge(j);
    judge_belief(j);
    judge_hold(j);
  }
}

/// Until it is commanded, an enabled arm stays where it was held; a wrong sign or a wrong torque
/// must not drive it away. A torque that pushes it is found by its velocity first: the limit is of
/// the place where it will be in kLead_s.
void Drives::judge_hold(int j) {
  const Joint& joint = joints_[static_cast<std::size_t>(j)];
  if (following_ || goal() != Goal::kOperationEnabled) return;
  constexpr double kLead_s = 0.05;
  const double away = joint.q - held_[j];
  const bool leaves = mode_ == CommandMode::kEffort && away * joint.dq > 0.0;
  const double pushed = away + (leaves ? kLead_s * joint.dq : 0.0);
  if (std::abs(pushed) <= settings_->hold_tolerance) return;
  const Figures figures = {pushed, settings_->hold_tolerance};
  moved_ = j;
  moved_from_ = held_[j];
  fail(j, Status::kMoved, joint.last.error_code, "moves by ",
       " rad while it is held, more than [cia402] hold_tolerance, ",
       " rad; check direction, rated_torque, hold_stiffness, the encoder, and the mounting and "
       "tool of [robot]",
       &figures);
}

/// The reports of an enabled drive must be possible. A drive may limit its command while its brake
/// opens.
void Drives::judge_belief(int j) {
  Joint& joint = joints_[static_cast<std::size_t>(j)];
  const std::uint32_t code = joint.last.error_code;
  const bool limited = following_ && (joint.last.statusword & kInternalLimit) != 0;
  joint.limited = limited ? std::min(joint.limited, kLongestLimited) + 1 : 0;
  const double limited_ms = 1e3 * period_s_ * joint.limited;
  if (!enabled()) return joint.watch.start();
  const FeedbackWatch& watch = joint.watch;
  if (watch.jumps()) {
    const Figures figures = {watch.change(), watch.most()};
    fail(j, Status::kStateInvalid, code, "its position jumps by ",
         " rad from a sample to the next, more than it can move, ",
         " rad; look at encoder and cabling", &figures);
  } else if (watch.contradicts()) {
    const Figures figures = {watch.by_velocity(), watch.by_positions()};
    fail(j, Status::kStateInvalid, code, "its velocities of the last 50 ms add up to ",
         " rad, its positions to ",
         " rad; compare [cia402] velocity_units and increments with the drive, look at the encoder",
         &figures);
  } else if (settings_->limited_ms > 0 && limited_ms > settings_->limited_ms) {
    const Figures figures = {limited_ms, static_cast<double>(settings_->limited_ms)};
    fail(j, Status::kDriveFault, code, "limits what is commanded (statusword bit 11) for ",
         " ms, longer than [cia402] limited_ms, ",
         " ms; look at its limits of torque (6072h), speed and position, and at its voltage",
         &figures);
  }
}

void Drives::measure(int j, const DriveFeedback& feedback, std::int64_t sampled_ns) {
  Joint& joint = joints_[static_cast<std::size_t>(j)];
  const int periods = joint.missed + 1;
  count_missed(joint, feedback);
  joint.last = feedback;
  if (!feedback.fresh) return;
  joint.placed = joint.placed && (settings_->homing_method[j] == 0.0 || referenced(j));
  const double before = joint.q;
  joint.q = joint.units.q(joint.counter.follow(feedback.position));
  if (!(std::abs(joint.q - before) <= limits_.dq_max[j] * period_s_ * periods)) {
    steady_ = -1;
    unsteady_ = j;
    jump_ = (joint.q - before) / periods;
  }
  const double elapsed_s = periods * period_s_;
  joint.watch.moved(joint.q - before, elapsed_s, period_s_, limits_.dq_max[j]);
  joint.dq =
      feedback.has_velocity ? joint.units.dq(feedback.velocity) : (joint.q - before) / elapsed_s;
  if (feedback.has_velocity) joint.watch.measured(joint.dq, elapsed_s);
  joint.tau = joint.units.tau(feedback.torque);
  joint.stamp_ns = sampled_ns;
}

/// Feedback that is late from some cycle on looks like feedback that was lost. So a later frame
/// does not make up for a cycle without one, but two frames in one cycle do.
void Drives::count_missed(Joint& joint, const DriveFeedback& feedback) {
  const int missing = feedback.fresh ? 0 : 1;
  joint.missed = missing * (joint.missed + (joint.missed <= settings_->max_missed));
  const int forgotten = ++joint.since_owed >= kForgotten ? 1 : 0;
  if (forgotten == 1 || joint.owed == 0) joint.since_owed = 0;
  const int owed = joint.owed + missing - feedback.made_up - forgotten;
  joint.owed = std::min(std::max(owed, 0), settings_->max_missed + 1);
}

/// A drive that holds or follows must stay enabled, send feedback and report no error. One that was
/// lost fails in every phase in which it is used.
void Drives::judge(int j) {
  const Joint& joint = joints_[static_cast<std::size_t>(j)];
  if (!enabled() && !rising()) return;
  const std::uint32_t code = joint.last.error_code;
  if (joint.last.lost != Status::kOk) {
    fail(j, joint.last.lost, code, lost_text(joint.last.lost));
  } else if (joint.missed > settings_->max_missed || joint.owed > settings_->max_missed) {
    fail(j, Status::kBusTimeout, code,
         "no feedback in more cycles than [cia402] max_missed, of which one is forgotten after 1000"
         " cycles; check load and cabling of its bus");
  } else if (operates(j) && joint.last.emergency) {
    fail(j, Status::kDriveFault, code, error_text(joint.last.error_code));
  } else if (operates(j) && state_of(joint.last.statusword) != State::kOperationEnabled) {
    const State state = state_of(joint.last.statusword);
    fail(j, Status::kDriveFault, code, code != 0 ? error_text(joint.last.error_code) : name(state));
  }
}

/// The first fault is the one that is explained.
void Drives::fail(int joint, Status reason, std::uint32_t code, const char* what,
                  const char* detail, const char* rest, const Figures* figures) {
  Joint& failed = joints_[static_cast<std::size_t>(joint)];
  if (failed.reason != Status::kOk) return;
  failed.reason = reason;
  failed.code = code;
  if (phase_ == ArmingPhase::kFailed) return;
  const std::uint16_t seen = rising() ? failed.last.statusword : 0;
  phase_ = ArmingPhase::kFailed;
  failure_ = {joint, code, seen, what, detail, rest, figures != nullptr, {}};
  if (figures != nullptr) failure_.figures = *figures;
}

/// False, and a fault, for a command that the drives cannot take.
bool Drives::follows(const RobotCommand& command) {
  const bool same = command.mode == mode_;
  if (!same) fail(0, Status::kNotOffered, 0, "a command of another mode than that of connecting");
  for (int j = 0; j < kDof && same; ++j) {
    const double sum = command.value[j] + command.dq_ff[j] + command.tau_ff[j];
    if (!(sum - sum == 0.0)) fail(j, Status::kCommandNotFinite, 0, "its command is not finite");
  }
  return phase_ == ArmingPhase::kArmed;
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

/// Only the targets of the mode are sent (the layout of the bus); a torque moves the arm by itself.
JointVector Drives::effort(const RobotCommand& command, bool follow, const JointVector& q,
                           const JointVector& dq) {
  if (mode_ != CommandMode::kEffort) return JointVector::Zero();
  if (!follow) return hold_.step(q, dq);
  hold_.track(q, command.value);
  return command.value;
}

Message Drives::why() const {
  if (failure_.joint < 0) return {};
  Message text = joint_text(failure_.joint);
  text << ": " << failure_.what;
  if (failure_.has_figures) text << failure_.figures.value;
  text << failure_.detail;
  if (failure_.has_figures) text << failure_.figures.limit;
  text << failure_.rest;
  if (failure_.seen != 0) text << " (statusword " << hex(failure_.seen) << ")";
  if (failure_.code != 0) text << " (error code " << hex(failure_.code) << ")";
  return text;
}

void Drives::show(RobotState& state) const {
  state.stamp_ns = joints_[0].stamp_ns;
  LoopBound<kDof> joints;
  for (int j = 0; j < kDof; ++j) {
    joints.tick();
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    state.q[j] = joint.q;
    state.dq[j] = joint.dq;
    state.tau[j] = joint.tau;
    if (joint.stamp_ns < state.stamp_ns) state.stamp_ns = joint.stamp_ns;
    state.drives[static_cast<std::size_t>(j)] = drive_of(joint);
  }
  // The first command continues from the measured torque, and the drives add the weight to it.
  if (settings_->gravity == Gravity::kDrive) state.tau -= hold_.weight(state.q);
}

/// A measured torque at the end of its numbers may be any larger one. In the cycle in which a fault
/// is found the other drives are still enabled: only the one at fault is to be named.
Drive Drives::drive_of(const Joint& joint) const {
  Drive drive;
  const bool saturated =
      joint.last.torque == kLargestTorque || joint.last.torque == kSmallestTorque;
  const State shown = state_of(joint.last.statusword);
  const bool heard = joint.missed <= settings_->max_missed;
  const bool unharmed = phase_ == ArmingPhase::kFailed && joint.reason == Status::kOk && heard &&
                        shown == State::kOperationEnabled;
  drive.valid = heard && !saturated;
  drive.warns = heard && shown != State::kFault && (joint.last.statusword & kWarning) != 0;
  drive.code = joint.last.error_code;
  if (phase_ == ArmingPhase::kArmed || unharmed) {
    drive.state = DriveState::kEnabled;
  } else if (enabled() || rising()) {
    drive.state = DriveState::kArming;
  } else if (joint.reason != Status::kOk) {
    drive = {DriveState::kFault, drive.valid, joint.reason, false, joint.code};
  } else if (!heard) {
    drive.state = DriveState::kUnknown;
  } else if (shown == State::kFault) {
    drive.state = DriveState::kFault;
    drive.reason = Status::kDriveFault;
  } else {
    const bool off = phase_ == ArmingPhase::kOff || joint.machine.reached();
    drive.state = off ? DriveState::kDisabled : DriveState::kStopping;
  }
  return drive;
}

}  // namespace tactus::cia402
