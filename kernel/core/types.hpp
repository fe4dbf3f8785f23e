// The vector types of the arm. Linear part or force first; SI units; each value's declaration names
// its frame.
#pragma once

#include "kernel/core/vectors.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus {

inline constexpr int kDof = Robot::kDof;  ///< joints of the board's robot

using JointVector = Eigen::Matrix<double, kDof, 1>;
using Jacobian = Eigen::Matrix<double, 6, kDof>;  ///< geometric: [v; w] = J dq

/// Position and orientation of one frame in another.
struct Pose {
  Vector3 p = Vector3::Zero();                                    ///< m
  Eigen::Quaterniond r = Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0);  ///< unit quaternion (w, x, y, z)
};

struct Convex;

/// A box, given by its centre and the lengths of its edges: full, or the box around another body.
struct Cuboid {
  Pose pose;                       ///< of its centre; axes along the edges
  Vector3 size = Vector3::Zero();  ///< m
  const Convex* inside = nullptr;  ///< the body, in the axes of the box; null: the box is full
};

/// The tool mounted on the flange, in the flange frame, and the gravity that pulls at it and at the
/// arm. Its point mass adds to the gravity and inertia of the last link.
struct Tool {
  static constexpr double kMostMass_kg = 100.0, kFarthest_m = 2.0;  ///< that a file can state

  double mass_kg = 0.0;
  Vector3 com = Vector3::Zero();                 ///< centre of mass, m
  Pose tip;                                      ///< tip frame, in the flange frame
  Vector3 gravity = {0.0, 0.0, -kGravity_m_s2};  ///< m/s^2, base frame

  /// True if the models would be wrong without it; any tilt changes z. [any]
  bool matters() const {
    return mass_kg > 0.0 || tip.p.squaredNorm() > 0.0 || gravity.z() != -kGravity_m_s2;
  }
};

/// Returns the tool that the models assume: zero in place of what is not given, NaN. [any]
inline Tool assumed(Tool tool) {
  const auto lacks = [](double first) { return !(first == first); };
  if (lacks(tool.mass_kg)) tool.mass_kg = 0.0;
  if (lacks(tool.com.x())) tool.com.setZero();
  if (lacks(tool.tip.p.x())) tool.tip.p.setZero();
  return tool;
}

}  // namespace tactus
