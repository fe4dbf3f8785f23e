// How the arm moves in one period: motors, and brakes that hold their joints.
#include <cmath>

#include "sim_plant/drives/drive_arm.hpp"

namespace tactus::drives {
namespace {

constexpr double kInnerStep_s = 0.25e-3;  // of the drives' own loops and of the brakes
// A brake is critically damped: a joint that moves when it closes stands after 10 ms.
constexpr double kBrakeRate = 600.0;  // 1/s
constexpr double kAtRest_rad_s = 1e-5;

}  // namespace

void DriveArm::move_for(double period_s) {
  bool any_braked = false, all_braked = true, servoed = false;
  for (std::size_t i = 0; i < kDof; ++i) {
    any_braked = any_braked || braked_[i];
    all_braked = all_braked && braked_[i];
    servoed = servoed || (has_drive(static_cast<int>(i)) && nodes_[i].axis().servoed());
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
      if (has_drive(i)) tau[i] = node(i).axis().torque({q[i], dq[i], gravity_[i]}, dt_s);
    if (rests) continue;
    arm_.step(any_braked ? with_brakes(tau) : tau, dt_s);
  }
}

/// A brake holds its joint with any torque that this takes; the motor behind it changes nothing.
JointVector DriveArm::with_brakes(const JointVector& tau) {
  const JointVector ddq =
      kBrakeRate * kBrakeRate * (held_q_ - arm_.q()) - 2.0 * kBrakeRate * arm_.dq();
  return arm_.torque_holding(braked_, ddq, tau);
}

}  // namespace tactus::drives
