#include "kernel/math/joint_integrator.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

double stopping_speed(double distance, double acceleration, double dt_s) {
  if (!(distance > 0.0)) return 0.0;
  const double step = acceleration * dt_s;
  // (sqrt(step^2 + 2 a d) - step), written so that nothing cancels
  const double twice = 2.0 * acceleration * distance;
  return twice / (std::sqrt(step * step + twice) + step);
}

void JointIntegrator::start(const Bounds& bounds, const JointVector& q) {
  bounds_ = bounds;
  q_ = q;
  dq_.setZero();
}

JointVector JointIntegrator::lowest(double dt_s) const {
  JointVector dq;
  for (int i = 0; i < kDof; ++i)
    dq[i] = -stopping_speed(q_[i] - bounds_.q_min[i], bounds_.ddq_max[i], dt_s);
  return dq;
}

JointVector JointIntegrator::highest(double dt_s) const {
  JointVector dq;
  for (int i = 0; i < kDof; ++i)
    dq[i] = stopping_speed(bounds_.q_max[i] - q_[i], bounds_.ddq_max[i], dt_s);
  return dq;
}

void JointIntegrator::step(const JointVector& wanted_dq, const JointVector& q, double dt_s) {
  const JointVector change = wanted_dq - dq_;
  double part = 1.0;
  for (int i = 0; i < kDof; ++i) {
    const double most = bounds_.ddq_max[i] * dt_s;
    if (std::abs(change[i]) * part > most) part = most / std::abs(change[i]);
  }
  const JointVector low = lowest(dt_s), high = highest(dt_s);
  for (int i = 0; i < kDof; ++i) {
    const double lead = bounds_.max_lead, most = bounds_.dq_max[i];
    double dq = dq_[i] + part * change[i];
    dq = std::clamp(dq, (q[i] - lead - q_[i]) / dt_s, (q[i] + lead - q_[i]) / dt_s);
    dq = std::clamp(dq, -most, most);
    dq_[i] = std::clamp(dq, low[i], high[i]);
    q_[i] += dt_s * dq_[i];
  }
}

void JointIntegrator::brake(double dt_s) {
  const JointVector most = dt_s * bounds_.ddq_max;
  dq_ -= dq_.cwiseMax(-most).cwiseMin(most);
  q_ += dt_s * dq_;
}

}  // namespace tactus
