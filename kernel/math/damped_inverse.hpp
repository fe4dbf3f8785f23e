// Damped least squares: joint velocities for a twist, bounded where the Jacobian loses rank.
//
//   J# = J^T (J J^T + lambda^2 I)^-1
//
// [Nakamura and Hanafusa, Inverse kinematic solutions with singularity robustness for robot
// manipulator control, ASME J. Dyn. Syst. Meas. Control 108, 1986; Wampler 1986]. The damping
// adapts to the distance from a singularity, by the law of the same paper:
//
//   lambda = onset (1 - sigma / onset)   where sigma < onset, else 0
//   sigma  = trace((J J^T)^-1)^(-1/2) = 1 / |J^+|, in the Frobenius norm
//
// sigma measures the distance, rather than the smallest singular value, because it is a smooth
// function of the joints even where two singular values cross, and comes from one factorisation,
// without iteration: sigma <= sigma_min <= sqrt(6) sigma, and the two agree near a singularity.
// Where sigma >= onset the inverse is exact. Everywhere |J#| <= (1 + sqrt(2)) / (2 onset): the
// worst of s / (s^2 + lambda^2) over singular values s >= sigma. Nothing switches at a threshold,
// so nothing chatters and no hysteresis is needed: lambda^2 and its derivative are continuous in
// the joints.
//
// For corrections, the twists that a remaining error causes, the damping can be larger: lambda_c,
// such that sigma^2 + lambda_c^2 is at least a given floor. Where sigma^2 is above the floor
// nothing changes.
//
// Metres and radians have equal weight.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "kernel/math/cholesky.hpp"

namespace tactus {

template <int n>
class DampedInverse {
 public:
  using JacobianMatrix = Eigen::Matrix<double, 6, n>;
  using Joints = Eigen::Matrix<double, n, 1>;
  using Twist = Eigen::Matrix<double, 6, 1>;

  /// `onset` > 0: sigma at which the damping begins; `floor` >= 0: least sigma^2 + lambda_c^2. A
  /// column of zeros leaves its joint out. If J is not finite, no result is. [cyclic]
  DampedInverse(const JacobianMatrix& J, double onset, double floor = 0.0)
      : J_(J), onset_(onset), floor_(floor) {
    for (int i = 0; i < n; ++i) add(J_.col(i), 1.0);
    damp();
  }
  /// Leaves joint i out, which was not left out before: the same as with a column of zeros, except
  /// for the sigma of fewer than six joints, which is exactly zero. [cyclic]
  void leave_out(int i) {
    add(J_.col(i), -1.0);
    J_.col(i).setZero();
    --joints_;
    damp();
  }

  /// Returns J# v for a twist, and for a correction with lambda_c. [cyclic]
  Joints times(const Twist& v) const { return J_.transpose() * damped_.solve(v); }
  Joints correcting(const Twist& v) const { return J_.transpose() * corrective().solve(v); }
  /// Returns the sum of both. [cyclic]
  Joints times(const Twist& v, const Twist& correction) const {
    return J_.transpose() * (damped_.solve(v) + corrective().solve(correction));
  }
  /// Returns (I - J# J) dq. It moves the task by at most lambda |dq| / 20, and not at all without
  /// damping; where the floor acts, by at most lambda_c |dq| / 2. [cyclic]
  Joints null_space(const Joints& dq) const {
    const double lambda = kNullShare * lambda_ + (lambda_c_ - lambda_);
    Cholesky<6> null;
    null.compute(JJt_, lambda * lambda);
    return dq - J_.transpose() * null.solve(J_ * dq);
  }

  /// Distance from a singularity; about 1e-6 where the rank is lost. [any]
  double sigma() const { return sigma_; }
  double lambda() const { return lambda_; }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  // Keeps the factorisation above rounding where the rank is lost: J J^T is of the order of 1, its
  // rounding error of 1e-16. Elsewhere it changes J^+ by a fraction kRounding / sigma^2.
  static constexpr double kRounding = 1e-12;
  // Share of the damping in the null-space projector. Without damping the projector would jump at a
  // singularity, where the posture also decides to which side a stretched arm bends; with all of it
  // the task would move, by s l^2 / (s^2 + l^2) <= l / 2 with l the damping in the projector. The
  // projector turns with the joints by up to 1 / l; so where an error remains, the rest of lambda_c
  // is added to it, which bounds this gain of the posture like that of the corrections.
  static constexpr double kNullShare = 0.1;

  /// Adds `share` c c^T to the lower triangle of J J^T + kRounding I.
  void add(const Twist& c, double share) {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      const double scaled = share * c[j];
#pragma GCC unroll 6
      for (int i = j; i < 6; ++i) JJt_(i, j) += scaled * c[i];
    }
  }
  void damp() {
    damped_.compute(JJt_, 0.0);
    sigma_ = joints_ < 6 ? 0.0 : 1.0 / std::sqrt(damped_.trace_of_inverse());
    lambda_ = sigma_ < onset_ ? onset_ - sigma_ : 0.0;
    if (lambda_ > 0.0) damped_.compute(JJt_, lambda_ * lambda_);
    const double least = floor_ - sigma_ * sigma_;
    lambda_c_ = least > lambda_ * lambda_ ? std::sqrt(least) : lambda_;
    if (lambda_c_ > lambda_) corrective_.compute(JJt_, lambda_c_ * lambda_c_);
  }
  const Cholesky<6>& corrective() const {
    return lambda_c_ > lambda_ ? corrective_ : damped_;
  }

  JacobianMatrix J_;
  double onset_, floor_;
  int joints_ = n;  // that are not left out
  Matrix6 JJt_ = kRounding * Matrix6::Identity();
  Cholesky<6> damped_, corrective_;  // corrective_ only if lambda_c is the larger
  double sigma_ = 0.0, lambda_ = 0.0, lambda_c_ = 0.0;
};

}  // namespace tactus
