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
                    double period_s) {
  limits_ = params.effective();
  following_error_ = params.following_error, following_time_ = params.following_time;
  max_step_ = limits_.dtau_max * period_s;
  mode_ = mode;
  telemetry_ = {};
  for (int i = 0; i < kDof; ++i) {
    const StepLimits steps = StepLimits::of(limits_, i, period_s);
    positions_[static_cast<std::size_t>(i)].start(steps, state.q[i]);
    velocities_[static_cast<std::size_t>(i)].start(steps, period_s, state.dq[i]);
  }
  TRY(check(state));
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

Status Guard::check(const RobotState& state) {
  for (int i = 0; i < kDof; ++i) {
    const double q = state.q[i], dq = state.dq[i];
    if (!std::isfinite(q)) return trip(Status::kStateNotFinite, i, q, 0.0);
    if (!std::isfinite(dq)) return trip(Status::kStateNotFinite, i, dq, 0.0);
    if (!std::isfinite(state.tau[i])) return trip(Status::kStateNotFinite, i, state.tau[i], 0.0);
    if (q < limits_.q_min[i]) return trip(Status::kMeasuredPositionLimit, i, q, limits_.q_min[i]);
    if (q > limits_.q_max[i]) return trip(Status::kMeasuredPositionLimit, i, q, limits_.q_max[i]);
    if (std::abs(dq) > limits_.dq_max[i])
      return trip(Status::kMeasuredVelocityLimit, i, dq, limits_.dq_max[i]);
  }
  return mode_ == CommandMode::kPosition ? check_following(state) : Status::kOk;
}

Status Guard::check_following(const RobotState& state) {
  for (int i = 0; i < kDof; ++i) {
    const double error = std::abs(positions_[static_cast<std::size_t>(i)].sent() - state.q[i]);
    const double limit = following_error_[i] + following_time_[i] * std::abs(state.dq[i]);
    if (!(error <= limit)) return trip(Status::kFollowingError, i, error, limit);
  }
  return Status::kOk;
}

Status Guard::limit(const RobotState& state, RobotCommand& command) {
  if (command.mode != mode_) return Status::kNotStarted;
  for (int i = 0; i < kDof; ++i) {
    const double wanted = command.value[i];
    if (!std::isfinite(wanted)) return trip(Status::kCommandNotFinite, i, wanted, 0.0);
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

double Guard::allowed(int joint, double wanted, const RobotState& state) {
  const auto j = static_cast<std::size_t>(joint);
  switch (mode_) {
    case CommandMode::kPosition:
      return positions_[j].next(wanted);
    case CommandMode::kVelocity:
      return velocities_[j].next(wanted, state.q[joint]);
    case CommandMode::kEffort:
      break;
  }
  return allowed_effort(joint, wanted);
}

double Guard::allowed_effort(int joint, double wanted) {
  const double last = last_[joint], limit = limits_.tau_max[joint];
  const double step = std::clamp(wanted - last, -max_step_[joint], max_step_[joint]);
  const double within_rate = step == wanted - last ? wanted : last + step;
  return last_[joint] = std::clamp(within_rate, -limit, limit);
}

/// Nothing was sent by the limiters of the modes that were not started.
bool Guard::jerky(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  return positions_[j].jerky() || velocities_[j].jerky();
}

}  // namespace tactus
