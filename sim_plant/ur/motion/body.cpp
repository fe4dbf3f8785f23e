#include "sim_plant/ur/motion/body.hpp"

namespace tactus::ur {
namespace {

constexpr double kInnerStep_s = 0.001;
constexpr double kTimeConstant_s = 0.008;
constexpr double kResidual_s = 0.04;  // time constant of the filter

int inner_steps(double h_s) {
  return static_cast<int>(h_s / kInnerStep_s + 0.5);
}

}  // namespace

Status Body::load(const Joints& q, const Surroundings& around) {
  PlantParams params;
  params.initial_q = q;
  params.mounting = around.mounting;
  params.payload_kg = around.payload_kg;
  params.payload_com = around.payload_com;
  params.payload_tip = around.tip;
  params.tip_radius = around.tip_radius;
  params.material = around.material;
  TRY(arm_.load(params, around.scene));
  target_ = q;
  tau_ = model_ = arm_.stand();
  return Status::kOk;
}

/// Returns the torque that the controller expects for `ddq`: it knows the payload, and a touch only
/// by the error that it causes.
Joints Body::expected(const Joints& ddq) {
  const Joints tau = arm_.inverse_dynamics(ddq);
  return tau + arm_.contact_torque();
}

void Body::move(const Joints& q_t, double h_s) {
  const Joints limit(robot_mjcf().drive_torque.data());
  const Joints from = target_, slope = (q_t - target_) / h_s;
  const int steps = inner_steps(h_s);
  const double step_s = h_s / steps, T = kTimeConstant_s;
  model_ = expected((slope - slope_) / h_s);
  Joints sum = Joints::Zero();
  for (int k = 1; k <= steps; ++k) {
    const Joints target = from + slope * (k * step_s);
    const Joints ddq = 2.0 / T * (slope - arm_.dq()) + (target - arm_.q()) / (T * T);
    const Joints tau = expected(ddq).cwiseMax(-limit).cwiseMin(limit);
    arm_.step(tau + push_, step_s);
    sum += tau;
  }
  target_ = q_t;
  slope_ = slope;
  tau_ = sum / steps;
  residual_ += (h_s / (kResidual_s + h_s)) * (tau_ - model_ - residual_);
}

void Body::drift(double slowing_s, double h_s) {
  const Joints limit(robot_mjcf().drive_torque.data());
  const int steps = inner_steps(h_s);
  Joints sum = Joints::Zero();
  for (int k = 0; k < steps; ++k) {
    const Joints wanted = expected(-arm_.dq() / slowing_s);
    const Joints tau = wanted.cwiseMax(-limit).cwiseMin(limit);
    arm_.step(tau + push_, h_s / steps);
    sum += tau;
  }
  target_ = arm_.q();
  slope_ = arm_.dq();
  model_ = tau_ = sum / steps;
  residual_.setZero();
}

void Body::stand() {
  model_ = tau_ = arm_.stand();
  target_ = arm_.q();
  slope_.setZero();
  residual_.setZero();
}

}  // namespace tactus::ur
