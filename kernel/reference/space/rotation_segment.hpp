// RotationSegment: the orientation between two ends, R(t) = R0 exp(phi(t)), where the rotation
// vector phi is a polynomial in time from zero to log(R0^T R1), the shortest arc (Park and Ravani,
// Smooth invariant interpolation of rotations, ACM Transactions on Graphics 16, 1997). Angular
// velocity and acceleration are its exact derivatives,
//   w = R J_r(phi) dphi,   alpha = R (J_r(phi) ddphi + dJ_r/dt dphi),
// where J_r dphi is the angular velocity in the rotated frame. The derivative of R itself adds
// R (J_r dphi x J_r dphi) = 0 to alpha.
#pragma once

#include "kernel/core/vectors.hpp"
#include "kernel/reference/space/vector_bounds.hpp"

namespace tactus {

/// Orientation in the base frame and its first two derivatives, expressed in the base frame.
struct RotationBoundary {
  Eigen::Quaterniond r = Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0);  ///< unit
  Vector3 w = Vector3::Zero();                                    ///< rad/s
  Vector3 alpha = Vector3::Zero();                                ///< rad/s^2
};

class RotationSegment {
 public:
  /// Quantities met at both ends: kLinear r, which is slerp with constant w; kCubic r and w;
  /// kQuintic r, w and alpha.
  using Order = Interpolation;

  /// At rest, not rotated.
  RotationSegment() = default;
  /// T > 0 in seconds. The quaternion begins with the sign of from.r; the sign of to.r is ignored.
  /// NaN in a quantity that the order meets, or a quaternion far from unit, makes every result NaN.
  /// [any]
  RotationSegment(const RotationBoundary& from, const RotationBoundary& to, double T, Order order);

  /// Returns orientation, angular velocity and acceleration at t in [0, T]. [any]
  RotationBoundary at(double t) const;
  double duration() const { return duration_; }
  /// Returns the part that begins at `begin` and lasts `duration`, both in s. [any]
  RotationSegment part(double begin, double duration) const;

  /// Returns the angular velocity and its derivatives at t, in the base frame. [any]
  TurningRates rates(double t) const;
  /// Returns upper bounds of |w| [rad/s], |alpha| [rad/s^2] and |dalpha/dt| [rad/s^3] on [0, T].
  /// [any]
  VectorBounds bounds(Accuracy accuracy = Accuracy::kFine) const {
    return rotation_bounds(phi_, duration_, accuracy);
  }

 private:
  Eigen::Quaterniond from_ = Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0);
  VectorPolynomial phi_;  // rotation vector from from_, in the frame of from_
  double duration_ = 1.0;
};

}  // namespace tactus
