#include "kernel/control/pid.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/math/exponential.hpp"

namespace tactus {
namespace {

JointVector clamped(const JointVector& value, const JointVector& limit) {
  JointVector inside;
  for (int i = 0; i < kDof; ++i) inside[i] = std::clamp(value[i], -limit[i], limit[i]);
  return inside;
}

/// Returns the rate of a value that was `before` one period ago; zero at start, without a past.
JointVector difference(const JointVector& now, const JointVector& before, double dt_s) {
  return dt_s == 0.0 ? JointVector(JointVector::Zero()) : JointVector((now - before) / dt_s);
}

}  // namespace

Status Pid::judge() const {
  const bool deaf = (!dq_d.wired() && params.velocity_gain.maxCoeff() > 0.0) ||
                    (!ddq_d.wired() && params.acceleration_gain.maxCoeff() > 0.0);
  return deaf ? Status::kNotConnected : Status::kOk;
}

Status Pid::start() {
  TRY(judge());
  if (!tau_measured->allFinite()) return Status::kCommandNotFinite;
  frozen_ = false;
  transfer_.clear();
  const JointVector e = error(params.dead_band), de = error_rate(0.0);
  JointVector integral = JointVector::Zero();
  if (tau_measured.wired()) {
    const JointVector missing = *tau_measured - other_terms(params, e, de);
    for (int i = 0; i < kDof; ++i) integral[i] = params.gains.ki[i] > 0.0 ? missing[i] : 0.0;
  }
  return emit(e, de, clamped(integral, params.integral_limit));
}

Status Pid::step(double dt_s) {
  const JointVector e = error(params.dead_band), de = filtered(error_rate(dt_s), dt_s);
  const JointVector others = other_terms(params, e, de);
  transfer_.step(dt_s);
  JointVector integral;
  for (int i = 0; i < kDof; ++i) integral[i] = integrated(i, e[i], others[i], dt_s);
  return emit(e, de, integral);
}

/// Returns all terms of the law but the integral.
JointVector Pid::other_terms(const Params& with, const JointVector& e,
                             const JointVector& de) const {
  return with.gains.kp.cwiseProduct(e) + with.gains.kd.cwiseProduct(de) +
         with.velocity_gain.cwiseProduct(*dq_d) + with.acceleration_gain.cwiseProduct(*ddq_d) +
         with.effort_gain.cwiseProduct(*tau_d) + *g;
}

Status Pid::emit(const JointVector& e, const JointVector& de, const JointVector& integral) {
  const JointVector sum = other_terms(params, e, de) + integral;
  if (!sum.allFinite()) return Status::kCommandNotFinite;
  e_ = e;
  de_ = de;
  q_ = *q;
  q_d_ = *q_d;
  integral_ = integral;
  tau.value = clamped(sum, params.output_limit);
  if (transfer_.runs()) tau.value = clamped(tau.value + transfer_.value(), params.output_limit);
  return Status::kOk;
}

JointVector Pid::error(const JointVector& dead_band) const {
  JointVector e = *q_d - *q;
  for (int i = 0; i < kDof; ++i) {
    const double band = dead_band[i];
    e[i] = std::abs(e[i]) <= band ? 0.0 : e[i] - std::copysign(band, e[i]);
  }
  return e;
}

JointVector Pid::error_rate(double dt_s) const {
  const JointVector measured = dq.wired() ? *dq : difference(*q, q_, dt_s);
  if (params.derivative == Derivative::kMeasurement) return -measured;
  return (dq_d.wired() ? *dq_d : difference(*q_d, q_d_, dt_s)) - measured;
}

JointVector Pid::filtered(const JointVector& rate, double dt_s) const {
  JointVector slow = rate;
  for (int i = 0; i < kDof; ++i) {
    const double time_constant = params.derivative_time_constant[i];
    if (time_constant > 0.0) slow[i] += exponential(-dt_s / time_constant) * (de_[i] - rate[i]);
  }
  return slow;
}

double Pid::integrated(int i, double e, double others, double dt_s) const {
  const double ki = params.gains.ki[i], limit = params.output_limit[i];
  if (ki == 0.0 || frozen_) return integral_[i];
  const double growth = ki * 0.5 * (e_[i] + e) * dt_s;
  double integral = integral_[i] + growth;
  const double sum = others + integral;
  const double excess = sum - std::clamp(sum, -limit, limit);
  switch (params.anti_windup) {
    case AntiWindup::kNone: break;
    case AntiWindup::kBackCalculation:
      integral -= (1.0 - exponential(-dt_s / tracking_time_constant(i))) * excess;
      break;
    case AntiWindup::kConditional:
      if (excess * growth > 0.0)
        integral -= std::copysign(std::min(std::abs(excess), std::abs(growth)), growth);
      break;
  }
  return std::clamp(integral, -params.integral_limit[i], params.integral_limit[i]);
}

/// For ki > 0. The default is between the time constants of integral and derivative, as in the
/// source.
double Pid::tracking_time_constant(int i) const {
  const double given = params.tracking_time_constant[i];
  const Gains& gains = params.gains;
  if (given > 0.0) return given;
  return gains.kd[i] > 0.0 ? std::sqrt(gains.kd[i] / gains.ki[i]) : gains.kp[i] / gains.ki[i];
}

/// Returns the torque of the last cycle with other parameters, without limit and fade.
JointVector Pid::torque(const Params& with) const {
  return other_terms(with, error(with.dead_band), de_) + integral_;
}

Verdict Pid::judge_change(const Params& next, const JointLimits& limits) const {
  return judge_torque(torque(next), torque(params), limits);
}

void Pid::retune(const Params& next, const JointLimits& limits) {
  const JointVector difference = tau.value - clamped(torque(next), next.output_limit);
  params = next;
  e_ = error(next.dead_band);
  transfer_.start(difference, transfer_time(difference, limits));
}

}  // namespace tactus
