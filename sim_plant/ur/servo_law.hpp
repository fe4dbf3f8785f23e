// What servoj makes of a target: the position, projected over the lookahead time L with the present
// target speed, is pulled towards the set-point c by the gain g,
//
//   ddq = g (c - q - L dq)
//
// in the words of the script manual. A system of second order with the natural frequency sqrt(g)
// and the damping ratio L sqrt(g) / 2; behind a ramp it is late by L. The solution is exact at
// every period, so a slower time base does not change the path.
#pragma once

namespace tactus::ur {

struct ServoLaw {
  double gain = 300.0;       ///< 1/s^2
  double lookahead_s = 0.1;  ///< s

  /// One joint over `h_s` with a set-point that is held: position and speed are replaced.
  void step(double set_point, double h_s, double& q, double& dq) const;
};

}  // namespace tactus::ur
