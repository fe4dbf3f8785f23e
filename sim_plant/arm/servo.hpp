// Servo: the loop inside a robot that takes positions or velocities. A target is held for one
// period. In each of n inner steps of length D the servo chooses an acceleration and commands the
// torque that causes it (computed torque), up to the limits of the drives. The torque compensates
// external forces, as the fast inner loops of a drive do: a wall does not make the servo yield.
// If a motion takes more torque than the drives have, the servo catches up afterwards: smoothly
// with a time constant; with overshoot if it is ideal, because it plans only one period ahead.
//
// The ideal servo reaches q = q_c and dq = v_c, the slope of the targets, at the end of the period;
// for velocities dq = dq_c. With n steps left and an acceleration that changes evenly over them:
//
//   ddq = (6 X - (2n - 1) V) / (n (n + 1))   X = (q_c - q - n D dq) / D^2, V = (v_c - dq) / D
//   ddq = (dq_c - dq) / (n D)
//
// With a time constant T, a critically damped lag of second order, and a lag of first order:
//
//   T^2 ddq + 2 T (dq - dq_ff) + q = q_c     late by 2 T if the speed of the targets is constant
//                                            and not fed forward
//   T ddq + dq = dq_c
#pragma once

#include "kernel/core/hal.hpp"
#include "sim_plant/arm/arm.hpp"

namespace tactus {

class Servo {
 public:
  /// `time_constant_s` >= 0, s; below 0.1 ms the servo is ideal. The arm is at rest at `q`, rad.
  /// [init]
  void start(double time_constant_s, const JointVector& q);

  /// Moves the arm towards a position or velocity for `period_s`; `tau` becomes the torque of the
  /// last inner step, N m. kDriveFault, and nothing moves, if the target is out of reach at the
  /// drives' top speed. The arm must be loaded, and the same in all calls. [cyclic]
  Status move(Arm& arm, const RobotCommand& target, double period_s, JointVector& tau);

 private:
  JointVector acceleration(const Arm& arm, const RobotCommand& target, const JointVector& slope,
                           int steps_left) const;

  double time_constant_s_ = 0.0;
  double step_s_ = 0.0;                         // D
  JointVector q_before_ = JointVector::Zero();  // target of the last period, rad
};

}  // namespace tactus
