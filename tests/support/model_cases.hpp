// Shared by the tests of the rigid-body algorithms: seeded states, a tool without symmetry, and the
// algorithms called with joint angles.
#pragma once

#include <random>

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/model/gravity.hpp"
#include "kernel/model/inverse_dynamics.hpp"

namespace tactus {

using JointMatrix = Eigen::Matrix<double, kDof, kDof>;

/// Returns a tool without symmetry: turned, off the axis, heavy.
inline Tool skew_tool() {
  Tool tool;
  tool.mass_kg = 1.3;
  tool.com = {0.02, -0.03, 0.07};
  tool.tip.p = {0.05, 0.04, 0.21};
  tool.tip.r = Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized();
  return tool;
}

/// Seeded states: positions within the limits, velocities and accelerations of either sign.
struct RandomStates {
  std::mt19937_64 random{20250607};
  JointVector q, dq, ddq;

  void next() {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < kDof; ++i) {
      const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
      q[i] = 0.5 * (limit.q_min + limit.q_max) + 0.5 * (limit.q_max - limit.q_min) * unit(random);
      dq[i] = limit.dq_max * unit(random);
      ddq[i] = limit.ddq_max * unit(random);
    }
  }
};

inline Pose tip_pose(const JointVector& q, const Pose& tip) {
  Jacobian J;
  return forward_kinematics<Robot>(joint_trig<Robot>(q), tip, J);
}

inline Jacobian tip_jacobian(const JointVector& q, const Pose& tip) {
  Jacobian J;
  static_cast<void>(forward_kinematics<Robot>(joint_trig<Robot>(q), tip, J));
  return J;
}

inline JointVector gravity_at(const JointVector& q, const Tool& tool) {
  return gravity<Robot>(joint_trig<Robot>(q), tool);
}

inline JointVector rnea(const JointVector& q, const JointVector& dq, const JointVector& ddq,
                        const Tool& tool) {
  return inverse_dynamics<Robot>(joint_trig<Robot>(q), dq, ddq, tool);
}

/// Returns M(q), column by column: the torque by inverse dynamics for a unit acceleration, minus
/// gravity.
inline JointMatrix mass_matrix(const JointVector& q, const Tool& tool) {
  const JointVector g = gravity_at(q, tool);
  JointMatrix m;
  for (int i = 0; i < kDof; ++i) {
    m.col(i) = rnea(q, JointVector::Zero(), JointVector::Unit(i), tool) - g;
  }
  return m;
}

}  // namespace tactus
