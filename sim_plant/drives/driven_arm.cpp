#include "sim_plant/drives/driven_arm.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::drives {
namespace {

constexpr double kInnerStep_s = 0.25e-3;  // of the drives' own loops and of the brakes
// A brake is critically damped: a joint that moves when it closes stands after 10 ms.
constexpr double kBrakeRate = 600.0;  // 1/s
constexpr double kAtRest_rad_s = 1e-5;

// The velocity loop of a drive takes 3 ms or less on the inertia that its joint has at least.
constexpr double kServoGains[] = {400.0, 400.0, 200.0, 200.0, 40.0, 40.0, 25.0};
// Above the top speed of the robot's data sheet, by a fifth.
constexpr double kSpeedMargin = 1.2;
constexpr double kRatedShare_mNm[] = {3000.0, 500.0};  // of strong and of light joints
constexpr double kStrong_Nm = 30.0;

}  // namespace

AxisSettings axis_settings(const DrivenArmSettings& settings, std::size_t joint) {
  AxisSettings axis;
  axis.max_torque_Nm = robot_mjcf().drive_torque[joint];
  axis.max_speed_rad_s = kSpeedMargin * robot_mjcf().drive_speed[joint];
  axis.rated_mNm =
      static_cast<std::uint32_t>(kRatedShare_mNm[axis.max_torque_Nm > kStrong_Nm ? 0 : 1]);
  axis.gains.kv = kServoGains[std::min<std::size_t>(joint, 6)];
  axis.brake_release_s = settings.brake_release_s;
  axis.gravity_by_drive = settings.gravity_by_drive;
  axis.velocity_unit = settings.velocity_unit;
  axis.homing = settings.homing[joint];
  axis.torque_share = settings.torque_share;
  return axis;
}

Status DrivenArm::load(const DrivenArmSettings& settings, const Axes& axes) {
  settings_ = settings;
  axes_ = axes;
  periods_ = 0;
  TRY(arm_.load(settings.plant));
  braked_.fill(true);
  held_q_ = arm_.q();
  measure();
  return Status::kOk;
}

void DrivenArm::move(double period_s) {
  ++periods_;
  for (int i = 0; i < kDof; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool braked = axes_[at] == nullptr || axes_[at]->braked();
    if (braked && !braked_[at]) held_q_[i] = q_[i];
    braked_[at] = braked;
  }
  step(period_s);
  if (arm_.diverged()) recover();
  measure();
}

void DrivenArm::step(double period_s) {
  bool any_braked = false, all_braked = true, servoed = false;
  for (std::size_t i = 0; i < kDof; ++i) {
    any_braked = any_braked || braked_[i];
    all_braked = all_braked && braked_[i];
    servoed = servoed || (axes_[i] != nullptr && axes_[i]->servoed());
  }
  const bool rests = all_braked && arm_.dq().cwiseAbs().maxCoeff() < kAtRest_rad_s;
  if (rests) arm_.stand();
  const bool fine = any_braked || servoed;
  const int steps =
      fine && !rests ? static_cast<int>(std::ceil(period_s / kInnerStep_s - 1e-9)) : 1;
  const double dt_s = period_s / steps;
  for (int n = 0; n < steps; ++n) {
    const JointVector q = arm_.q(), dq = arm_.dq();
    JointVector tau = JointVector::Zero();
    for (int i = 0; i < kDof; ++i)
      if (Axis* const axis = axes_[static_cast<std::size_t>(i)])
        tau[i] = axis->torque({q[i], dq[i], gravity_[i]}, dt_s);
    if (rests) continue;
    arm_.step(any_braked ? with_brakes(tau) : tau, dt_s);
  }
}

/// A brake holds its joint with any torque that this takes; the motor behind it changes nothing.
JointVector DrivenArm::with_brakes(const JointVector& tau) {
  const JointVector ddq =
      kBrakeRate * kBrakeRate * (held_q_ - arm_.q()) - 2.0 * kBrakeRate * arm_.dq();
  return arm_.torque_holding(braked_, ddq, tau);
}

void DrivenArm::measure() {
  q_ = arm_.q();
  dq_ = arm_.dq();
  bool needed = settings_.gravity_by_drive;
  for (const Axis* axis : axes_) needed = needed || (axis != nullptr && axis->braked());
  if (needed) gravity_ = arm_.gravity();
}

/// A motion that cannot be simulated ends where the arm was before, with every drive in fault.
void DrivenArm::recover() {
  settings_.plant.initial_q = q_;
  if (arm_.load(settings_.plant) != Status::kOk) return;
  for (Axis* axis : axes_)
    if (axis != nullptr) axis->trip();
}

}  // namespace tactus::drives
