// Cartesian pose control in a loop of its own: the law, the kernel's model of the measured joints,
// and a position servo that reaches its command when the period ends, or is blocked. The
// measurement may be some periods old. Works for any robot.
#pragma once

#include <array>

#include "kernel/control/cartesian_pose.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/model/forward_kinematics.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

using JointFlags = Eigen::Array<bool, kDof, 1>;

inline Pose tip_at(const JointVector& q, Jacobian& J) {
  return forward_kinematics<Robot>(joint_trig<Robot>(q), {}, J);
}
inline Pose tip_at(const JointVector& q) {
  Jacobian J;
  return tip_at(q, J);
}
inline double sigma_at(const JointVector& q) {
  Jacobian J;
  static_cast<void>(tip_at(q, J));
  return DampedInverse<kDof>(J, 1e-3).sigma();
}

/// Returns random joints within `share` of their ranges around the middle.
inline JointVector random_joints(RandomVectors& random, double share) {
  const JointLimits limits;
  JointVector q;
  for (int i = 0; i < kDof; ++i)
    q[i] = 0.5 * (limits.q_min[i] + limits.q_max[i]) +
           0.5 * share * (limits.q_max[i] - limits.q_min[i]) * random.unit();
  return q;
}

/// Returns random joints far from a singularity.
inline JointVector regular_joints(RandomVectors& random) {
  JointVector q = random_joints(random, 0.7);
  while (!(sigma_at(q) > 0.12)) q = random_joints(random, 0.7);
  return q;
}

/// Returns the joints of a number, far from a singularity, the same in every run.
inline JointVector regular(int number) {
  RandomVectors random;
  JointVector q = regular_joints(random);
  for (int i = 0; i < number; ++i) q = regular_joints(random);
  return q;
}

struct PoseBench {
  double dt_s = 1e-3;
  int delay = 0;                                     ///< age of the measurement, periods
  JointFlags blocked = JointFlags::Constant(false);  ///< joints that do not move
  JointVector true_q = JointVector::Zero();

  Pose x_d, x;
  Vector6 v_d = Vector6::Zero();
  Jacobian J;
  JointVector q = JointVector::Zero(), q_posture = JointVector::Zero();
  CartesianPose law;

  PoseBench() {
    law.x_d.source = &x_d;
    law.v_d.source = &v_d;
    law.x.source = &x;
    law.J.source = &J;
    law.q.source = &q;
  }
  /// Starts at rest at q0 with the reference there.
  Status start(const JointVector& q0) {
    true_q = q0;
    old_.fill(q0);
    measure();
    x_d = x;
    v_d.setZero();
    return law.start(dt_s);
  }
  void measure() {
    q = delay > 0 ? old_[static_cast<std::size_t>(delay - 1)] : true_q;
    x = tip_at(q, J);
  }
  /// Measures, commands and moves: one period.
  Status step() {
    measure();
    TRY(law.step(dt_s));
    for (std::size_t i = old_.size(); --i > 0;) old_[i] = old_[i - 1];
    old_[0] = true_q;
    for (int i = 0; i < kDof; ++i)
      if (!blocked[i]) true_q[i] = law.q_c.value[i];
    return Status::kOk;
  }
  Status run(double duration_s) {
    for (int k = 0; k < static_cast<int>(duration_s / dt_s + 0.5); ++k) TRY(step());
    return Status::kOk;
  }
  const JointVector& q_c() const { return law.q_c.value; }
  const JointVector& dq_c() const { return law.dq_c.value; }
  /// Errors of the true tip, m and rad.
  Vector3 position_error() const { return x_d.p - tip_at(true_q).p; }
  Vector3 rotation_error() const { return log_so3(x_d.r * tip_at(true_q).r.conjugate()); }

 private:
  std::array<JointVector, 4> old_;
};

inline const JointLimits kLimits;

/// Steps a bench and asserts the limits of every command, positions with the margin of the law.
struct Watch {
  PoseBench& bench;
  bool follows = true;  ///< the robot follows, so accelerations are limited too
  JointVector dq = bench.dq_c();

  Status step() {
    const JointVector before = bench.q_c();
    TRY(bench.step());
    const JointVector& now = bench.dq_c();
    for (int i = 0; i < kDof; ++i) {
      assert_true(std::abs(now[i]) <= kLimits.dq_max[i]);
      assert_true(bench.q_c()[i] <= std::max(kLimits.q_max[i] - 0.01, before[i]) + 1e-12);
      assert_true(bench.q_c()[i] >= std::min(kLimits.q_min[i] + 0.01, before[i]) - 1e-12);
      ASSERT_NEAR(bench.q_c()[i], before[i] + bench.dt_s * now[i], 1e-14);
      if (follows)
        assert_true(std::abs(now[i] - dq[i]) <= kLimits.ddq_max[i] * bench.dt_s * (1.0 + 1e-9));
    }
    assert_true(bench.law.scale.value >= 0.0 && bench.law.scale.value <= 1.0);
    dq = now;
    return Status::kOk;
  }
};

}  // namespace tactus
