// The kinematics of the emulated UR10: the manufacturer's standard DH table, "DH parameters for
// calculations of kinematics and dynamics",
//
//   T = prod RotZ(theta_i) TransZ(d_i) TransX(a_i) RotX(alpha_i)
//
// A pose is x, y, z and a rotation vector, as in the protocols; m and rad, base frame.
#pragma once

#include <array>

#include "kernel/core/types.hpp"

namespace tactus::ur {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;  ///< rad

using Joints = Vector6;  ///< rad, rad/s or N m of six joints

struct DhTable {
  std::array<double, 6> a = {0.0, -0.612, -0.5723, 0.0, 0.0, 0.0};               ///< m
  std::array<double, 6> d = {0.1273, 0.0, 0.0, 0.163941, 0.1157, 0.0922};        ///< m
  std::array<double, 6> alpha = {1.5707963267948966,  0, 0, 1.5707963267948966,  // rad
                                 -1.5707963267948966, 0};
  std::array<double, 6> theta = {};  ///< rad, added to the joint's position
  bool calibrated = false;           ///< the numbers of one arm, not those of its type
};
inline constexpr DhTable kDh;
/// The same article's table of the UR10e.
inline constexpr DhTable kDhOfUr10e = {{0.0, -0.6127, -0.57155, 0.0, 0.0, 0.0},
                                       {0.1807, 0.0, 0.0, 0.17415, 0.11985, 0.11655}};

/// Converts a matrix to a rotation vector, with an angle from 0 to pi, and back.
Vector3 rotation_vector(const Matrix3& r);
Matrix3 rotation_matrix(const Vector3& v);

/// The pose of a frame in another frame.
struct Frame {
  Vector3 p = Vector3::Zero();
  Matrix3 r = Matrix3::Identity();

  static Frame of(const Vector6& pose);
  Vector6 pose() const;
  Frame operator*(const Frame& other) const { return {p + r * other.p, r * other.r}; }
  Frame inverse() const { return {-(r.transpose() * p), r.transpose()}; }
};

/// Returns the flange in the base.
Frame forward(const Joints& q, const DhTable& dh = kDh);
/// Returns the elbow, the origin of the frame after joint 3, in the base, m.
Vector3 elbow(const Joints& q);

/// Returns J with [v; w] of the tool's tip = J dq; `tool` is the tip in the flange.
Eigen::Matrix<double, 6, 6> jacobian(const Joints& q, const Frame& tool);

/// Finds the joint positions nearest to `near` with the tip at `target`. False: none was found, and
/// `q` is unchanged.
bool inverse(const Frame& target, const Frame& tool, const Joints& near, Joints& q);

/// Finds dq with J dq = twist, damped next to a singularity. False: the damping would leave less
/// than half of the twist.
bool joint_speeds(const Joints& q, const Frame& tool, const Vector6& twist, Joints& dq);

}  // namespace tactus::ur
