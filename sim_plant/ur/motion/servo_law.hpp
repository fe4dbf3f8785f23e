// The law of servoj: the gain g pulls the target position, projected over the lookahead time L with
// the present target speed, towards the set-point c,
//
//   ddq = g (c - q - L dq)
//
// as the script manual describes it. This is a system of second order with the natural frequency
// sqrt(g) and the damping ratio L sqrt(g) / 2; it follows a ramp late by L. The solution is exact
// in every period, so a slower time base does not change the path.
#pragma once

namespace tactus::ur {

struct ServoLaw {
  double gain = 300.0;       ///< 1/s^2
  double lookahead_s = 0.1;  ///< s

  /// Moves one joint for `h_s` towards a constant set-point; updates position and speed.
  void step(double set_point, double h_s, double& q, double& dq) const;
};

}  // namespace tactus::ur
