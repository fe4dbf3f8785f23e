// JointIntegrator: commanded joint positions and velocities, integrated from desired velocities and
// kept within the joints' limits.
//
//   q_c(k) = q_c(k-1) + dt dq_c(k)
//
// Bounds of dq_c, the strongest first:
//   1. position limits: a joint can always be stopped before its limit, with its acceleration;
//   2. velocity limits;
//   3. the lead: q_c stays within max_lead of the measured q, so the command does not run away from
//      a blocked joint, and the motion after its release is bounded;
//   4. acceleration limits: the velocities change by only part of the difference from the desired
//      ones, the same part for all joints.
// Each bound yields to those above it. The first two always hold. The third holds, together with
// the first two, while the joint itself moves no faster than its velocity limit. The fourth holds
// unless the robot does not follow.
#pragma once

#include "kernel/core/joint_limits.hpp"

namespace tactus {

/// Returns the greatest speed from which a joint can still be stopped within `distance`, including
/// this period: v dt + v^2 / (2 a) <= distance. Zero if there is none. A joint that moves no faster
/// can keep the bound in the next period too, braking with at most a. [Flacco, De Luca, Khatib,
/// IEEE Trans. Robotics 31, 2015, eq. 5, there without the period.] [any]
double stopping_speed(double distance, double acceleration, double dt_s);

class JointIntegrator {
 public:
  struct Bounds {
    JointVector q_min, q_max;  ///< rad
    JointVector dq_max;        ///< rad/s
    JointVector ddq_max;       ///< rad/s^2
    double max_lead = 0.1;     ///< rad
  };

  /// Begins at rest at q. A joint outside its position limits can only move towards them. [init]
  [[gnu::cold]] void start(const Bounds& bounds, const JointVector& q);
  /// Advances one period; every joint brakes separately, with its full acceleration. [cyclic]
  void brake(double dt_s);
  /// Stops the command at its present position. [any]
  void halt() { dq_.setZero(); }

  /// Return the bounds of the velocities that the position limits admit in this period; they
  /// include zero. [cyclic]
  JointVector lowest(double dt_s) const;
  JointVector highest(double dt_s) const;

  /// Advances one period towards the desired velocities; q is the measured position. All inputs
  /// must be finite. [cyclic]
  void step(const JointVector& wanted_dq, const JointVector& q, double dt_s);

  const JointVector& q() const { return q_; }
  const JointVector& dq() const { return dq_; }

 private:
  Bounds bounds_;
  JointVector q_ = JointVector::Zero(), dq_ = JointVector::Zero();
};

}  // namespace tactus
