// Orientation between two ends: R(t) = R0 exp(phi(t)), where the rotation vector phi is a
// polynomial in time from zero to log(R0^T R1), the shortest arc (Park and Ravani, Smooth invariant
// interpolation of rotations, ACM Transactions on Graphics 16, 1997). Velocity and acceleration are
// its exact derivatives,
//   w = R J_r(phi) dphi,   alpha = R (J_r(phi) ddphi + dJ_r/dt dphi),
// J_r dphi being the angular velocity in the rotated frame; what turns with R adds R (J_r dphi x
// J_r dphi) = 0 to the second.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/reference/polynomial.hpp"
#include "kernel/types.hpp"

namespace tactus {

/// Orientation in the base frame and its first two derivatives, expressed in the base frame.
struct RotationBoundary {
  Eigen::Quaterniond r = Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0);  ///< unit
  Vector3 w = Vector3::Zero();                                    ///< rad/s
  Vector3 alpha = Vector3::Zero();                                ///< rad/s^2
};

/// Three polynomials in t.
struct VectorPolynomial {
  std::array<Polynomial, 3> axis{};

  /// [any]
  Vector3 at(double t) const { return {axis[0].at(t), axis[1].at(t), axis[2].at(t)}; }
  VectorPolynomial derivative() const {
    return {{axis[0].derivative(), axis[1].derivative(), axis[2].derivative()}};
  }
  VectorPolynomial from(double begin) const {
    return {{axis[0].from(begin), axis[1].from(begin), axis[2].from(begin)}};
  }
};

class RotationSegment {
 public:
  /// What is met at both ends: r; r and w; r, w and alpha. Linear is slerp: constant w.
  enum class Order : std::uint8_t { kLinear, kCubic, kQuintic };

  /// At rest, not rotated.
  RotationSegment() = default;
  /// T > 0 in seconds. The orientation's sign is that of from.r throughout, to.r's is ignored. NaN
  /// in what the order meets, or a quaternion far from unit, makes every result NaN. [any]
  RotationSegment(const RotationBoundary& from, const RotationBoundary& to, double T, Order order);

  /// For t in [0, T]. [any]
  RotationBoundary at(double t) const;
  double duration() const { return duration_; }
  /// What it is from `begin` on for so long. [any]
  RotationSegment part(double begin, double duration) const;

  /// Angular velocity and its derivatives in the base, written in the axes of the rotated frame.
  struct Rates {
    Vector3 w, alpha, jerk;
  };
  /// [any]
  Rates rates(double t) const;

  /// No |w| [rad/s], |alpha| [rad/s^2] and |dalpha/dt| [rad/s^3] on [0, T] is larger, to rounding.
  struct Bounds {
    double w, alpha, jerk;
  };
  /// From outside: linear is exact; cubic and quintic are at most 2 % (jerk: 5 %) above what occurs
  /// from rest to rest, 2 % (w), 5 % (alpha) and 15 % (jerk) with ends that move at up to 5 rad per
  /// duration, and looser for segments of many turns. Takes 44 times as long as at(). [any]
  Bounds bounds() const;

 private:
  Eigen::Quaterniond from_ = Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0);
  VectorPolynomial phi_;  // rotation vector from from_, in its frame
  double duration_ = 1.0;
  bool linear_ = true;
};

}  // namespace tactus
