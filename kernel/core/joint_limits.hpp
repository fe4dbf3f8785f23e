// JointLimits: the bounds of the robot's joints for the admission of references and the guard. The
// numbers come from the robot table; a pipeline file may tighten them in [guard], never widen them.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

struct JointLimits {
  JointVector q_min, q_max;  ///< rad
  JointVector dq_max;        ///< rad/s
  JointVector ddq_max;       ///< rad/s^2
  JointVector dddq_max;      ///< rad/s^3
  JointVector tau_max;       ///< N m
  JointVector dtau_max;      ///< N m/s
  /// Largest velocity step between two straight segments, rad/s; a quarter of the velocity limit.
  JointVector velocity_step;

  /// Returns these limits with velocities of at most `speed`, rad/s. [any]
  JointLimits slowed(double speed) const {
    JointLimits limits = *this;
    limits.dq_max = dq_max.cwiseMin(speed);
    return limits;
  }

  /// Takes the limits of the board's robot table.
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
