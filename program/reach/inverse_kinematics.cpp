#include "program/reach/inverse_kinematics.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "kernel/math/damped_inverse.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/model/forward_kinematics.hpp"

namespace tactus {
namespace {

constexpr double kOnset = 1e-4;         // of the damping of the null space: rounding only
constexpr double kRounding = 1e-12;     // keeps the factorisation above rounding
constexpr double kDamping = 0.5;        // lambda^2 over the error
constexpr double kLargestStep = 0.3;    // rad
constexpr double kSmallestStep = 1e-9;  // rad; nothing is gained any more

}  // namespace

Pose InverseKinematics::tip(const JointVector& q) const {
  JacobianOf<Robot> J;
  return forward_kinematics<Robot>(joint_trig<Robot>(q), tip_, J);
}

/// Returns (J^T J + lambda^2 I)^-1 J^T e, without the joints that it would take beyond a limit at
/// which they are: `reach` names the last of them.
JointVector InverseKinematics::step(const JointVector& q, const Vector6& error,
                                    Eigen::Matrix<double, 6, kDof> J, Reach& reach) const {
  using Square = Eigen::Matrix<double, kDof, kDof>;
  const double damping = kDamping * error.norm() + kRounding;
  JointVector step;
  for (int left_out = 0; left_out <= kDof; ++left_out) {
    const Square A = J.transpose() * J + damping * Square::Identity();
    step = A.ldlt().solve(J.transpose() * error);
    int blocked = -1;
    for (int i = 0; i < kDof; ++i)
      if ((step[i] < 0.0 && q[i] <= limits_.q_min[i]) ||
          (step[i] > 0.0 && q[i] >= limits_.q_max[i]))
        blocked = i;
    if (blocked < 0) break;
    reach.blocked = blocked;
    J.col(blocked).setZero();
  }
  return step * std::min(1.0, kLargestStep / std::max(step.cwiseAbs().maxCoeff(), 1e-12));
}

Reach InverseKinematics::solve(const Pose& target, JointVector& q, int steps) const {
  Reach reach;
  for (int k = 0;; ++k) {
    JacobianOf<Robot> J;
    const Pose x = forward_kinematics<Robot>(joint_trig<Robot>(q), tip_, J);
    const Vector6 error = stacked(target.p - x.p, log_so3(target.r * x.r.conjugate()));
    reach = {error.head<3>().norm(), error.tail<3>().norm()};
    reach.sigma = DampedInverse<kDof>(J, kOnset).sigma();
    const JointVector dq = step(q, error, J, reach);
    if (reach.reached() || k == steps || dq.norm() < kSmallestStep) return reach;
    q = (q + dq).cwiseMax(limits_.q_min).cwiseMin(limits_.q_max);
  }
}

/// Six joints have no motion that leaves the tip where it is.
void InverseKinematics::move_posture([[maybe_unused]] const JointVector& posture,
                                     [[maybe_unused]] double share,
                                     [[maybe_unused]] JointVector& q) const {
  if constexpr (kDof > 6) {
    JacobianOf<Robot> J;
    forward_kinematics<Robot>(joint_trig<Robot>(q), tip_, J);
    const DampedInverse<kDof> inverse(J, kOnset);
    q += inverse.null_space(share * (posture - q));
    q = q.cwiseMax(limits_.q_min).cwiseMin(limits_.q_max);
  }
}

}  // namespace tactus
