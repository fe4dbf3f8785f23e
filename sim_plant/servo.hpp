// Servo: the loop inside a robot that takes positions or velocities. A target is held for one
// period; in each of n inner steps of length D the servo chooses an acceleration and asks for the
// torque that gives it to the arm (computed torque), which the drives exert as far as they can. It
// feels what pushes the arm, as the fast inner loops of a drive do: a wall does not make it yield.
// A motion that takes more torque than the drives have is caught up with: smoothly with a
// time constant, with overshoot by the ideal servo, which plans no further than a period ahead.
//
// Ideal, at the end of the period q = q_c and dq = v_c, the slope of the targets; for velocities
// dq = dq_c. With n steps left, and the acceleration to change evenly over them:
//
//   ddq = (6 X - (2n - 1) V) / (n (n + 1))   X = (q_c - q - n D dq) / D^2, V = (v_c - dq) / D
//   ddq = (dq_c - dq) / (n D)
//
// With a time constant T, lags of second order, critically damped, and of first order:
//
//   T^2 ddq + 2 T dq + q = q_c               late by 2 T behind targets of constant speed
//   T ddq + dq = dq_c
#pragma once

#include "kernel/hal.hpp"
#include "sim_plant/arm.hpp"

namespace tactus {

class Servo {
 public:
  /// `time_constant_s` >= 0, s; below 0.1 ms the servo is ideal. The arm stands at `q`, rad. [init]
  void start(double time_constant_s, const JointVector& q);

  /// Moves the arm by `period_s` towards a position or velocity; `tau` becomes the torque of the
  /// last inner step, N m. kDriveFault, and nothing moves, when the target is out of reach at the
  /// drives' top speed. The arm is loaded and follows from one call to the next. [cyclic]
  Status move(Arm& arm, const RobotCommand& target, double period_s, JointVector& tau);

 private:
  JointVector acceleration(const Arm& arm, const RobotCommand& target, const JointVector& slope,
                           int steps_left) const;

  double time_constant_s_ = 0.0;
  double step_s_ = 0.0;                         // D
  JointVector q_before_ = JointVector::Zero();  // rad, the target of the period before
};

}  // namespace tactus
