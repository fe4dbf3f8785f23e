#include "kernel/guard/guard.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

JointLimits Guard::Params::effective() const {
  JointLimits limit = limits;
  limit.q_min += position_margin;
  limit.q_max -= position_margin;
  return limit;
}

Status Guard::start(const Params& params, CommandMode mode, const RobotState& state,
                    double period_s, const CycleTime& now) {
  limits_ = params.effective();
  following_error_ = params.following_error;
  following_time_ = params.following_time;
  period_s_ = period_s;
  max_age_ = params.max_age;
  lag_.setZero();
  max_step_ = limits_.dtau_max * period_s;
  mode_ = mode;
  left_behind_ = false;
  telemetry_ = {};
  for (int i = 0; i < kDof; ++i) {
    const StepLimits steps = StepLimits::of(limits_, i, period_s);
    positions_[static_cast<std::size_t>(i)].start(steps, state.q[i]);
    velocities_[static_cast<std::size_t>(i)].start(steps, period_s, state.dq[i]);
  }
  TRY(check(state, now));
  for (int i = 0; i < kDof && mode == CommandMode::kEffort; ++i) {
    if (std::abs(state.tau[i]) > limits_.tau_max[i])
      return trip(Status::kEffortLimit, i, state.tau[i], limits_.tau_max[i]);
  }
  last_ = state.tau;
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
  const double lo = limits_.q_min[joint], hi = limits_.q_max[joint], most = limits_.dq_max[joint];
  if (!state.drives[static_cast<std::size_t>(joint)].valid)
    return trip(Status::kStateInvalid, joint, q, 0.0);
  for (const double value : {q, dq, tau})
    if (!std::isfinite(value)) return trip(Status::kStateNotFinite, joint, value, 0.0);
  if (q < lo - kMeasuredPosition) return trip(Status::kMeasuredPositionLimit, joint, q, lo);
  if (q > hi + kMeasuredPosition) return trip(Status::kMeasuredPositionLimit, joint, q, hi);
  if (std::abs(dq) > most + kMeasuredVelocity)
    return trip(Status::kMeasuredVelocityLimit, joint, dq, most);
  return Status::kOk;
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
    const double wanted = command.value[i];
    if (!std::isfinite(wanted)) return trip(Status::kCommandNotFinite, i, wanted, 0.0);
  }
  left_behind_ = braked && (left_behind_ || !follows(command.value, state));
  if (left_behind_) {
    telemetry_.limited = false;
    command = brake(state);
    return Status::kOk;
  }
  bool limited = false, rough = false;
  for (int i = 0; i < kDof; ++i) {
    const double wanted = command.value[i];
    command.value[i] = allowed(i, wanted, state);
    rough = rough || jerky(i);
    if (command.value[i] != wanted) {
      limited = true;
      telemetry_.limited_joints |= 1U << i;
    }
  }
  telemetry_.limited = limited;
  telemetry_.limited_cycles += limited ? 1 : 0;
  telemetry_.jerky_cycles += rough ? 1 : 0;
  return Status::kOk;
}

RobotCommand Guard::brake(const RobotState& state) {
  RobotCommand command{mode_, JointVector::Zero()};
  for (int i = 0; i < kDof; ++i) {
    if (mode_ == CommandMode::kPosition)
      command.value[i] = positions_[static_cast<std::size_t>(i)].brake();
    else
      command.value[i] = allowed(i, 0.0, state);
  }
  return command;
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
  return allowed_effort(joint, wanted);
}

double Guard::allowed_effort(int joint, double wanted) {
  const double last = last_[joint], limit = limits_.tau_max[joint];
  const double step = std::clamp(wanted - last, -max_step_[joint], max_step_[joint]);
  const double within_rate = step == wanted - last ? wanted : last + step;
  return last_[joint] = std::clamp(within_rate, -limit, limit);
}

/// The limiters of the modes that were not started have sent nothing, so they are not jerky.
bool Guard::jerky(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  return positions_[j].jerky() || velocities_[j].jerky();
}

}  // namespace tactus
