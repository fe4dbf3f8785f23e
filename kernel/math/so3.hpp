// Rotation vectors: exponential and logarithm of SO(3), and the Jacobian between a rotation
// vector's rate and the angular velocity it makes.
//
// Notation of Sola, Deray and Atchuthan, A micro Lie theory for state estimation in robotics, 2018,
// appendix on SO(3). All coefficients are Stumpff functions of s = |phi|^2,
// c_n(s) = sum over k of (-s)^k / (2k + n)!, which are smooth at zero: c_0 = cos |phi|,
// c_1 = sin |phi| / |phi|, c_2 = (1 - cos |phi|) / |phi|^2, and so on.
//
// Fails closed: the result is NaN if a number is not finite or |phi| is beyond the range of
// sincos().
#pragma once

#include "kernel/core/vectors.hpp"

namespace tactus {

/// Returns the rotation by |phi| about phi [rad] as a unit quaternion (cos |phi|/2, ...). It is
/// smooth in phi and has the opposite sign after a full turn. [any]
Eigen::Quaterniond exp_so3(const Vector3& phi);

/// Returns the rotation vector of r along the shortest arc, |phi| <= pi [rad]. r and -r give the
/// same vector; of the two vectors of half a turn, the result is the one whose first nonzero
/// component is positive. r may have any length between 1/2 and 2; outside, the result is NaN.
/// [any]
Vector3 log_so3(const Eigen::Quaterniond& r);

/// c_0 ... c_7 at one s >= 0.
struct Stumpff {
  double c0, c1, c2, c3, c4, c5, c6, c7;
};
/// [any]
Stumpff stumpff(double s);

/// Right Jacobian J_r(phi) = I - c_2 [phi]x + c_3 [phi]x^2: R = exp(phi) turns at omega = J_r dphi,
/// expressed in the rotated frame.
class RightJacobian {
 public:
  /// [any]
  explicit RightJacobian(const Vector3& phi);

  Matrix3 matrix() const;
  /// Returns J_r v. [any]
  Vector3 times(const Vector3& v) const;
  /// Returns J_r^-1 v for |phi| < 2 pi, where J_r becomes singular. [any]
  Vector3 inverse_times(const Vector3& v) const;
  /// Returns (dJ_r/dt) v while phi changes at the rate dphi. J_r ddphi + (dJ_r/dt) dphi is the
  /// angular acceleration in the rotated frame. [any]
  Vector3 rate_times(const Vector3& dphi, const Vector3& v) const;
  /// J_r dphi along a path phi(t) and its first two time derivatives: the components of the angular
  /// velocity in the rotated frame, and their derivatives.
  struct Rates {
    Vector3 w, dw, ddw;
  };
  /// [any]
  Rates rates(const Vector3& dphi, const Vector3& ddphi, const Vector3& dddphi) const;

 private:
  Vector3 phi_;
  Stumpff c_;
};

}  // namespace tactus
