// JointLimits: the robot's bounds as the admission of references and the guard use them. The
// numbers are the robot table's; a pipeline file may tighten them in [guard], never widen them.
#pragma once

#include "kernel/describe.hpp"
#include "kernel/types.hpp"

namespace tactus {

struct JointLimits {
  JointVector q_min, q_max;  ///< rad
  JointVector dq_max;        ///< rad/s
  JointVector ddq_max;       ///< rad/s^2
  JointVector dddq_max;      ///< rad/s^3
  JointVector tau_max;       ///< N m
  JointVector dtau_max;      ///< N m/s
  /// Largest step in velocity where straight lines meet, rad/s; a quarter of the velocity limit.
  JointVector velocity_step;

  /// The same with velocity, acceleration and jerk times `share`. [any]
  JointLimits scaled(double share) const {
    JointLimits limits = *this;
    limits.dq_max *= share;
    limits.ddq_max *= share;
    limits.dddq_max *= share;
    return limits;
  }

  /// The limits of the board's robot table.
  JointLimits() {
    for (int i = 0; i < kDof; ++i) {
      const JointLimit& joint = Robot::kLimits[static_cast<std::size_t>(i)];
      q_min[i] = joint.q_min;
      q_max[i] = joint.q_max;
      dq_max[i] = joint.dq_max;
      ddq_max[i] = joint.ddq_max;
      dddq_max[i] = joint.dddq_max;
      tau_max[i] = joint.tau_max;
      dtau_max[i] = joint.dtau_max;
      velocity_step[i] = 0.25 * joint.dq_max;
    }
  }
};

}  // namespace tactus
