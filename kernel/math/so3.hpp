// Rotation vectors: exponential and logarithm of SO(3), and the Jacobian between a rotation
// vector's rate and the angular velocity it makes.
//
// Notation of Sola, Deray and Atchuthan, A micro Lie theory for state estimation in robotics, 2018,
// appendix on SO(3). All coefficients are Stumpff functions of s = |phi|^2,
// c_n(s) = sum over k of (-s)^k / (2k + n)!, which are smooth at zero: c_0 = cos |phi|,
// c_1 = sin |phi| / |phi|, c_2 = (1 - cos |phi|) / |phi|^2, and so on.
//
// Fails closed: NaN where a number is not finite or |phi| is more than sincos() takes.
#pragma once

#include "kernel/types.hpp"

namespace tactus {

/// Rotation by |phi| about phi [rad], as unit quaternion (cos |phi|/2, ...): smooth in phi, and
/// with the other sign after a full turn. [any]
Eigen::Quaterniond exp_so3(const Vector3& phi);

/// Rotation vector of r along the shortest arc, |phi| <= pi [rad]. r and -r give the same; of the
/// two vectors of half a turn it is the one whose first component that is not zero is positive. The
/// length of r does not matter between 1/2 and 2; beyond, NaN. [any]
Vector3 log_so3(const Eigen::Quaterniond& r);

/// c_0 ... c_7 at one s >= 0.
struct Stumpff {
  double c0, c1, c2, c3, c4, c5, c6, c7;
};
/// [any]
Stumpff stumpff(double s);

/// J_r(phi) = I - c_2 [phi]x + c_3 [phi]x^2, with which R = exp(phi) turns at omega = J_r dphi in
/// the rotated frame.
class RightJacobian {
 public:
  /// [any]
  explicit RightJacobian(const Vector3& phi);

  Matrix3 matrix() const;
  /// J_r v. [any]
  Vector3 times(const Vector3& v) const;
  /// J_r^-1 v, for |phi| < 2 pi, where J_r becomes singular. [any]
  Vector3 inverse_times(const Vector3& v) const;
  /// (dJ_r/dt) v while phi changes at dphi: J_r ddphi + (dJ_r/dt) dphi is the angular acceleration
  /// in the rotated frame. [any]
  Vector3 rate_times(const Vector3& dphi, const Vector3& v) const;
  /// d^2/dt^2 (J_r dphi) along a path phi(t): the second derivative of the components of the
  /// angular velocity in the rotated frame. [any]
  Vector3 second_rate(const Vector3& dphi, const Vector3& ddphi, const Vector3& dddphi) const;

 private:
  Vector3 phi_;
  Stumpff c_;
};

}  // namespace tactus
