// JointMotion: a commanded joint position and its velocity, integrated from a wanted velocity and
// kept within the joints' limits.
//
//   q_c(k) = q_c(k-1) + dt dq_c(k)
//
// What bounds dq_c, the stronger first:
//   1. position limits: a joint can always be stopped before its limit, with its acceleration;
//   2. velocity limits;
//   3. the lead: q_c stays within max_lead of the measured q, so a blocked joint is not run away
//      from, and what it catches up when released is known;
//   4. acceleration limits, by moving only part of the way from the present velocities to the
//      wanted ones, the same part for all joints.
// Each yields to those above it. The first two hold always. The third, and with it the first two,
// holds while the joint itself moves no faster than its velocity limit. The fourth holds unless the
// robot does not follow.
#pragma once

#include "kernel/joint_limits.hpp"

namespace tactus {

/// The greatest speed from which a joint can still be stopped within `distance`, this period
/// included: v dt + v^2 / (2 a) <= distance. Zero if there is none. Who moves no faster can obey it
/// in the next period too, braking with no more than a. [Flacco, De Luca, Khatib, IEEE Trans.
/// Robotics 31, 2015, eq. 5, there without the period.] [any]
double stopping_speed(double distance, double acceleration, double dt_s);

class JointMotion {
 public:
  struct Bounds {
    JointVector q_min, q_max;  ///< rad
    JointVector dq_max;        ///< rad/s
    JointVector ddq_max;       ///< rad/s^2
    double max_lead = 0.1;     ///< rad
  };

  /// Begins at q, at rest. From outside the position limits it can only move towards them. [init]
  void start(const Bounds& bounds, const JointVector& q);
  /// Moves on by one period, every joint towards rest by itself, with its whole acceleration.
  /// [cyclic]
  void brake(double dt_s);
  /// Stops the command where it is. [any]
  void halt() { dq_.setZero(); }

  /// Velocities that the position limits admit in this period; zero always is. [cyclic]
  JointVector lowest(double dt_s) const;
  JointVector highest(double dt_s) const;

  /// Moves on by one period, towards the velocity wanted; q is the measured position. All must be
  /// finite. [cyclic]
  void step(const JointVector& wanted_dq, const JointVector& q, double dt_s);

  const JointVector& q() const { return q_; }
  const JointVector& dq() const { return dq_; }

 private:
  Bounds bounds_;
  JointVector q_ = JointVector::Zero(), dq_ = JointVector::Zero();
};

}  // namespace tactus
