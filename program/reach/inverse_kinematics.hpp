// Inverse kinematics: joints within their limits that bring the tip as near to a pose as they can.
// Levenberg and Marquardt's step with the damping of Sugihara (IEEE Trans. Robotics 27, 2011),
// which vanishes with the error, so that a pose in reach is reached and one out of reach is
// approached; a joint at its limit is left out. A metre and a radian have equal weight.
#pragma once

#include "kernel/core/joint_limits.hpp"

namespace tactus {

/// Distance of the tip from the target.
struct Reach {
  double distance_m = 0.0, angle_rad = 0.0;  ///< that remain
  double sigma = 0.0;  ///< distance from a singularity (kernel/math/damped_inverse.hpp)
  int blocked = -1;    ///< a joint that would have to pass its limit; -1: none

  bool reached() const { return distance_m <= 1e-5 && angle_rad <= 1e-4; }
  double error() const { return distance_m + angle_rad; }
};

class InverseKinematics {
 public:
  /// `tip`: tip frame in the flange frame.
  InverseKinematics(const JointLimits& limits, const Pose& tip) : limits_(limits), tip_(tip) {}

  /// Moves `q`, rad, in at most `steps` steps so that the tip is at `target`, in the base frame, or
  /// near it; returns how near.
  Reach solve(const Pose& target, JointVector& q, int steps) const;
  /// Moves `q` by `share` of the way to `posture` without moving the tip, as far as it can.
  void move_posture(const JointVector& posture, double share, JointVector& q) const;
  Pose tip(const JointVector& q) const;

  const JointLimits& limits() const { return limits_; }

 private:
  JointVector step(const JointVector& q, const Vector6& error, Eigen::Matrix<double, 6, kDof> J,
                   Reach& reach) const;

  JointLimits limits_;
  Pose tip_;
};

}  // namespace tactus
