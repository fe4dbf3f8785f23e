#include "sim_plant/arm/servo.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

constexpr double kMaxServoStep_s = 0.25e-3;
constexpr int kMinInnerSteps = 4;
constexpr double kFastest_s = 0.1e-3;  // a time constant below this counts as zero

Eigen::Map<const JointVector> joints(const std::array<double, kDof>& values) {
  return Eigen::Map<const JointVector>(values.data());
}

}  // namespace

void Servo::start(double time_constant_s, const JointVector& q) {
  time_constant_s_ = time_constant_s < kFastest_s ? 0.0 : time_constant_s;
  q_before_ = q;
}

Status Servo::move(Arm& arm, const RobotCommand& target, double period_s, JointVector& tau) {
  JointVector slope = target.value;  // rad/s
  if (target.mode == CommandMode::kPosition) slope = (target.value - q_before_) / period_s;
  if (!(slope.cwiseAbs().array() <= joints(robot_mjcf().drive_speed).array()).all())
    return Status::kDriveFault;
  if (target.mode == CommandMode::kPosition) q_before_ = target.value;

  double longest_s = std::min(kMaxServoStep_s, period_s / kMinInnerSteps);
  if (time_constant_s_ > 0.0) longest_s = std::min(longest_s, 0.125 * time_constant_s_);
  const int steps = static_cast<int>(std::ceil(period_s / longest_s - 1e-9));
  step_s_ = period_s / steps;
  const auto limit = joints(robot_mjcf().drive_torque);
  for (int left = steps; left > 0; --left) {
    tau = arm.inverse_dynamics(acceleration(arm, target, slope, left));
    tau = tau.cwiseMax(-limit).cwiseMin(limit);
    arm.step(tau, step_s_);
  }
  return Status::kOk;
}

/// Returns the acceleration with `n` inner steps left, rad/s^2.
JointVector Servo::acceleration(const Arm& arm, const RobotCommand& target,
                                const JointVector& slope, int n) const {
  const double T = time_constant_s_, D = step_s_;
  const JointVector q = arm.q(), dq = arm.dq();
  if (target.mode == CommandMode::kVelocity) return (target.value - dq) / (T > 0.0 ? T : n * D);
  if (T > 0.0) return (target.value - q - 2.0 * T * (dq - target.dq_ff)) / (T * T);
  const JointVector X = (target.value - q - n * D * dq) / (D * D), V = (slope - dq) / D;
  return (6.0 * X - (2 * n - 1) * V) / (n * (n + 1));
}

}  // namespace tactus
