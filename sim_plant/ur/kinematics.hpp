// The kinematics of the emulated UR10: the manufacturer's standard DH table, "DH parameters for
// calculations of kinematics and dynamics",
//
//   T = prod RotZ(theta_i) TransZ(d_i) TransX(a_i) RotX(alpha_i)
//
// A pose is x, y, z and a rotation vector, as on the wire; m and rad, base frame.
#pragma once

#include <array>

#include "kernel/types.hpp"

namespace tactus::ur {

using Joints = Vector6;  ///< rad, rad/s or N m of six joints

struct DhTable {
  std::array<double, 6> a = {0.0, -0.612, -0.5723, 0.0, 0.0, 0.0};               ///< m
  std::array<double, 6> d = {0.1273, 0.0, 0.0, 0.163941, 0.1157, 0.0922};        ///< m
  std::array<double, 6> alpha = {1.5707963267948966,  0, 0, 1.5707963267948966,  // rad
                                 -1.5707963267948966, 0};
};

/// The rotation vector of a matrix, of an angle from 0 to pi, and the matrix of one.
Vector3 rotation_vector(const Matrix3& r);
Matrix3 rotation_matrix(const Vector3& v);

/// A frame in another.
struct Frame {
  Vector3 p = Vector3::Zero();
  Matrix3 r = Matrix3::Identity();

  static Frame of(const Vector6& pose);
  Vector6 pose() const;
  Frame operator*(const Frame& other) const { return {p + r * other.p, r * other.r}; }
  Frame inverse() const { return {-(r.transpose() * p), r.transpose()}; }
};

/// The flange in the base.
Frame forward(const Joints& q);
/// The frame behind joint 3: the elbow.
Vector3 elbow(const Joints& q);

/// [v; w] of the tool's tip = J dq; `tool` is the tip in the flange.
Eigen::Matrix<double, 6, 6> jacobian(const Joints& q, const Frame& tool);

/// The joint positions nearest to `near` with the tip at `target`. False: none was found, and `q`
/// is as it was.
bool inverse(const Frame& target, const Frame& tool, const Joints& near, Joints& q);

/// dq with J dq = twist, damped next to a singularity; false where it would be damped to less than
/// half of what was asked for.
bool joint_speeds(const Joints& q, const Frame& tool, const Vector6& twist, Joints& dq);

}  // namespace tactus::ur
