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
// sigma measures the distance instead of the smallest singular value, because it is a smooth
// function of the joints even where two singular values cross, and comes from one factorisation,
// without iteration: sigma <= sigma_min <= sqrt(6) sigma, and the two agree near a singularity.
// Where sigma >= onset the inverse is exact. Everywhere |J#| <= (1 + sqrt(2)) / (2 onset): the
// worst of s / (s^2 + lambda^2) over singular values s >= sigma. No threshold is switched at, so
// there is nothing to chatter about and no hysteresis is needed: lambda^2 and its derivative are
// continuous in the joints.
//
// For corrections, the twists that come from an error that is left, the damping can be larger: by
// lambda_c, so that sigma^2 + lambda_c^2 is at least a given floor. Where sigma^2 is above the
// floor nothing changes.
//
// Metres and radians are weighted alike.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

namespace tactus {

template <int n>
class DampedInverse {
 public:
  using JacobianMatrix = Eigen::Matrix<double, 6, n>;
  using Joints = Eigen::Matrix<double, n, 1>;
  using Twist = Eigen::Matrix<double, 6, 1>;

  /// `onset` > 0: where the damping begins; `floor` >= 0: of sigma^2 + lambda_c^2. A column of
  /// zeros leaves its joint out. From a J that is not finite nothing finite comes. [cyclic]
  DampedInverse(const JacobianMatrix& J, double onset, double floor = 0.0) : J_(J) {
    Matrix6 JJt = J_ * J_.transpose();
    JJt.diagonal().array() += kRounding;
    null_.compute(JJt);
    sigma_ = 1.0 / std::sqrt(trace_of_inverse(null_));
    if (sigma_ < onset) lambda_ = onset - sigma_;
    damped_.compute(plus(JJt, lambda_));
    corrective_ = damped_;
    double null_lambda = kNullShare * lambda_;
    if (const double missing = floor - sigma_ * sigma_; missing > lambda_ * lambda_) {
      const double lambda_c = std::sqrt(missing);
      corrective_.compute(plus(JJt, lambda_c));
      null_lambda += lambda_c - lambda_;
    }
    if (null_lambda > 0.0) null_.compute(plus(JJt, null_lambda));
  }

  /// J# v. [cyclic]
  Joints times(const Twist& v) const { return J_.transpose() * damped_.solve(v); }
  /// The same for a correction, with lambda_c. [cyclic]
  Joints correcting(const Twist& v) const { return J_.transpose() * corrective_.solve(v); }
  /// (I - J# J) dq, which moves the task by no more than lambda |dq| / 20, and not at all where
  /// nothing is damped; where the floor acts by no more than lambda_c |dq| / 2. [cyclic]
  Joints null_space(const Joints& dq) const { return dq - J_.transpose() * null_.solve(J_ * dq); }

  /// Distance from a singularity; about 1e-6 where the rank is lost. [any]
  double sigma() const { return sigma_; }
  double lambda() const { return lambda_; }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  // Keeps the factorisation above rounding where the rank is lost: J J^T is of the order of 1, its
  // rounding error of 1e-16. Elsewhere it changes J^+ by kRounding / sigma^2 of itself.
  static constexpr double kRounding = 1e-12;
  // Share of the damping in the null-space projector. None at all, and it would jump at a
  // singularity, where the posture also decides to which side an arm bends that was stretched out;
  // the whole, and the task would move: by s l^2 / (s^2 + l^2) <= l / 2, l being the share. The
  // projector turns with the joints by up to 1 / l: where an error stays the rest of lambda_c is in
  // it too, so that this gain of the posture is bounded as that of the corrections is.
  static constexpr double kNullShare = 0.1;

  static Matrix6 plus(Matrix6 JJt, double lambda) {
    JJt.diagonal().array() += lambda * lambda;
    return JJt;
  }
  static double trace_of_inverse(const Eigen::LLT<Matrix6>& llt) {  // |L^-1|^2
    double sum = 0.0;
    for (int i = 0; i < 6; ++i) sum += llt.matrixL().solve(Twist::Unit(i)).squaredNorm();
    return sum;
  }

  JacobianMatrix J_;
  Eigen::LLT<Matrix6> damped_, corrective_, null_;
  double sigma_ = 0.0, lambda_ = 0.0;
};

}  // namespace tactus
