// What the set-point generator keeps to, and what of the path check is not published; rad, rad/s
// and rad/s^2.
#pragma once

#include <algorithm>

#include "sim_plant/ur/kinematics.hpp"

namespace tactus::ur {

struct MotionLimits {
  Joints speed;                    ///< what the joints move at most
  double acceleration = 40.0;      ///< of a joint in moves: not published
  double position = 6.3355;        ///< 363 degrees: the default safety limit
  double sudden_change = 0.5;      ///< between a servo set-point and the target it is to move
  double sudden_stop = 0.1;        ///< a target speed from which standing still is one
  double stop_acceleration = 4.0;  ///< of a program that ends
  double protective_acceleration = 12.0;

  MotionLimits();
};

/// A speed, acceleration or time of a script, as much of it as arithmetic can take; what is not
/// positive, or no number, is the default.
inline double given_or(double value, double otherwise) {
  return value > 0.0 ? std::clamp(value, 1e-9, 1e9) : otherwise;
}

}  // namespace tactus::ur
