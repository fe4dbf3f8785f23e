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

Status Guard::start(const Params& params, const RobotState& state, double period_s) {
  limits_ = params.effective();
  max_step_ = limits_.dtau_max * period_s;
  telemetry_ = {};
  TRY(check(state));
  for (int i = 0; i < kDof; ++i) {
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
  return Status::kOk;
}

Status Guard::limit(RobotCommand& command) {
  bool limited = false;
  for (int i = 0; i < kDof; ++i) {
    const double wanted = command.value[i];
    if (!std::isfinite(wanted)) return trip(Status::kCommandNotFinite, i, wanted, 0.0);
    if (command.mode != CommandMode::kEffort) continue;
    const double step = std::clamp(wanted - last_[i], -max_step_[i], max_step_[i]);
    double allowed = step == wanted - last_[i] ? wanted : last_[i] + step;
    allowed = std::clamp(allowed, -limits_.tau_max[i], limits_.tau_max[i]);
    if (allowed != wanted) {
      limited = true;
      telemetry_.limited_joints |= 1U << i;
    }
    command.value[i] = last_[i] = allowed;
  }
  telemetry_.limited_cycles += limited ? 1 : 0;
  return Status::kOk;
}

}  // namespace tactus
