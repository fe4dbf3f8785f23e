#include "kernel/guard/guard.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {

JointLimits Guard::Params::effective() const {
  JointLimits limit = limits;
  limit.q_min += position_margin;
  limit.q_max -= position_margin;
  return limit;
}

JointLimits Guard::Params::references() const {
  JointLimits limit = effective();
  for (int i = 0; i < kDof; ++i) {  // smaller than with vectors
    const double room = std::max(0.0, position_allowance[i] - kPositionTolerance);
    limit.q_min[i] += room;
    limit.q_max[i] -= room;
    limit.dq_max[i] *= 1.0 - std::max(0.0, velocity_allowance[i] - kVelocityTolerance);
  }
  return limit;
}

Status Guard::start(const Params& params, CommandMode mode, const RobotState& state,
                    double period_s, const CycleTime& now) {
  limits_ = params.effective();
  allowance_ = params.position_allowance.cwiseMin(kPositionTolerance);
  const JointVector faster = params.velocity_allowance.cwiseMin(kVelocityTolerance);
  dq_max_ = limits_.dq_max + limits_.dq_max.cwiseProduct(faster);
  following_error_ = params.following_error;
  following_time_ = params.following_time;
  period_s_ = period_s;
  max_age_ = params.max_age;
  lag_.setZero();
  mode_ = mode;
  left_behind_ = false;
  telemetry_ = {};
  for (int i = 0; i < kDof; ++i) {
    const StepLimits steps = StepLimits::of(limits_, i, period_s);
    outside_[i] = std::min(kLedBack, beyond(i, state.q[i]));
    positions_[static_cast<std::size_t>(i)].start(steps, state.q[i]);
    velocities_[static_cast<std::size_t>(i)].start(steps, period_s, state.dq[i]);
    torques_[static_cast<std::size_t>(i)].start(limits_.tau_max[i], limits_.dtau_max[i] * period_s,
                                                mode == CommandMode::kEffort ? state.tau[i] : 0.0);
    fed_velocities_[static_cast<std::size_t>(i)].start(limits_.dq_max[i],
                                                       limits_.ddq_max[i] * period_s, 0.0);
  }
  TRY(check(state, now));
  for (int i = 0; i < kDof && mode == CommandMode::kEffort; ++i) {
    if (std::abs(state.tau[i]) > limits_.tau_max[i])
      return trip(Status::kEffortLimit, i, state.tau[i], limits_.tau_max[i]);
  }
  return Status::kOk;
}

Status Guard::trip(Status status, int joint, double value, double limit) {
  telemetry_.tripped_joint = joint;
  telemetry_.tripped_value = value;
  telemetry_.tripped_limit = limit;
  return status;
}

Status Guard::check(const RobotState& state, const CycleTime& now) {
  TRY(check_age(state, now));
  for (int i = 0; i < kDof; ++i) TRY(check_joint(i, state));
  return mode_ == CommandMode::kEffort ? Status::kOk : check_following(state);
}

/// A state from the future is no better than an old one.
Status Guard::check_age(const RobotState& state, const CycleTime& now) {
  // A stamp may be nonsense: integers could overflow.
  const double age_ns = static_cast<double>(now.stamp_ns) - static_cast<double>(state.stamp_ns);
  const double age = age_ns * 1e-9 / period_s_;
  const bool young = age >= -1.0 && age <= max_age_ + 0.5;
  return young ? Status::kOk : trip(Status::kStateStale, -1, age, max_age_);
}

Status Guard::check_joint(int joint, const RobotState& state) {
  const double q = state.q[joint], dq = state.dq[joint], tau = state.tau[joint];
  const double play = allowance_[joint] + outside_[joint], most = dq_max_[joint];
  const double lo = limits_.q_min[joint] - play, hi = limits_.q_max[joint] + play;
  if (!state.drives[static_cast<std::size_t>(joint)].valid)
    return trip(Status::kStateInvalid, joint, q, 0.0);
  for (const double value : {q, dq, tau})
    if (!std::isfinite(value)) return trip(Status::kStateNotFinite, joint, value, 0.0);
  if (q < lo) return trip(Status::kMeasuredPositionLimit, joint, q, lo);
  if (q > hi) return trip(Status::kMeasuredPositionLimit, joint, q, hi);
  if (std::abs(dq) > most) return trip(Status::kMeasuredVelocityLimit, joint, dq, most);
  outside_[joint] = std::min(outside_[joint], beyond(joint, q));
  return Status::kOk;
}

/// Returns how far a position is outside of the joint's range, rad; 0 inside.
double Guard::beyond(int joint, double q) const {
  return std::max({0.0, limits_.q_min[joint] - q, q - limits_.q_max[joint]});
}

/// A robot that is sent velocities is compared with the way that they would have taken it.
Status Guard::check_following(const RobotState& state) {
  for (int i = 0; i < kDof; ++i) {
    const auto j = static_cast<std::size_t>(i);
    double error = positions_[j].sent() - state.q[i];
    if (mode_ == CommandMode::kVelocity) {
      const double slower = velocities_[j].sent() - state.dq[i];
      lag_[i] += period_s_ * (slower - lag_[i] / kFading_s);
      error = lag_[i];
    }
    const double limit = following_error_[i] + following_time_[i] * std::abs(state.dq[i]);
    if (!(std::abs(error) <= limit))
      return trip(Status::kFollowingError, i, std::abs(error), limit);
  }
  return Status::kOk;
}

Status Guard::limit(const RobotState& state, RobotCommand& command, bool braked) {
  if (command.mode != mode_) return Status::kNotStarted;
  for (int i = 0; i < kDof; ++i) {
    for (const double wanted : {command.value[i], command.dq_ff[i], command.tau_ff[i]})
      if (!std::isfinite(wanted)) return trip(Status::kCommandNotFinite, i, wanted, 0.0);
  }
  left_behind_ = braked && (left_behind_ || !follows(command.value, state));
  if (left_behind_) {
    telemetry_.limited = false;
    command = brake(state);
    return Status::kOk;
  }
  bool limited = false, rough = false, fed = false;
  LoopBound<kDof> joints;
  for (int i = 0; i < kDof; ++i) {
    joints.tick();
    const double wanted = command.value[i];
    command.value[i] = allowed(i, wanted, state);
    rough = rough || jerky(i);
    const bool changed = command.value[i] != wanted;
    limited = limited || changed;
    if (changed) telemetry_.limited_joints |= 1U << i;
    if (mode_ != CommandMode::kEffort) fed = limit_feed_forward(i, changed, command) || fed;
  }
  telemetry_.limited = limited;
  telemetry_.limited_cycles += limited ? 1 : 0;
  telemetry_.jerky_cycles += rough ? 1 : 0;
  telemetry_.feed_forward_cycles += fed ? 1 : 0;
  return Status::kOk;
}

RobotCommand Guard::brake(const RobotState& state) {
  RobotCommand command{mode_, JointVector::Zero()};
  for (int i = 0; i < kDof; ++i) {
    if (mode_ == CommandMode::kPosition)
      command.value[i] = positions_[static_cast<std::size_t>(i)].brake();
    else
      command.value[i] = allowed(i, 0.0, state);
    if (mode_ == CommandMode::kEffort) continue;
    command.dq_ff[i] = fed_velocities_[static_cast<std::size_t>(i)].next(0.0);
    command.tau_ff[i] = torques_[static_cast<std::size_t>(i)].sent();
  }
  return command;
}

RobotState Guard::held(RobotState measured) const {
  measured.dq.setZero();
  for (int i = 0; i < kDof && mode_ == CommandMode::kPosition; ++i)
    measured.q[i] = positions_[static_cast<std::size_t>(i)].sent();
  return measured;
}

/// True for torques: their law uses the measured state, so there is nothing to catch up with.
bool Guard::follows(const JointVector& wanted, const RobotState& state) const {
  bool all = true;
  for (int i = 0; i < kDof && mode_ != CommandMode::kEffort; ++i) {
    const auto j = static_cast<std::size_t>(i);
    all = all && (mode_ == CommandMode::kPosition ? positions_[j].follows(wanted[i])
                                                  : velocities_[j].follows(wanted[i], state.q[i]));
  }
  return all;
}

double Guard::allowed(int joint, double wanted, const RobotState& state) {
  const auto j = static_cast<std::size_t>(joint);
  switch (mode_) {
    case CommandMode::kPosition: return positions_[j].next(wanted);
    case CommandMode::kVelocity: return velocities_[j].next(wanted, state.q[joint]);
    case CommandMode::kEffort: break;
  }
  return torques_[j].next(wanted);
}

/// Brings the feed-forward of a joint within its limits; returns whether that changed it. The
/// velocity beside a position that was `limited` lies between zero and that of the position sent.
bool Guard::limit_feed_forward(int joint, bool limited, RobotCommand& command) {
  const auto j = static_cast<std::size_t>(joint);
  double &dq = command.dq_ff[joint], &tau = command.tau_ff[joint];
  const double wanted = dq, wanted_tau = tau;
  const double slope = positions_[j].step() / period_s_;  // zero in other modes
  if (limited) dq = std::clamp(dq, std::min(slope, 0.0), std::max(slope, 0.0));
  dq = fed_velocities_[j].next(dq);
  tau = torques_[j].next(tau);
  return dq != wanted || tau != wanted_tau;
}

/// The limiters of the modes that were not started have sent nothing, so they are not jerky.
bool Guard::jerky(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  return positions_[j].jerky() || velocities_[j].jerky();
}

}  // namespace tactus
