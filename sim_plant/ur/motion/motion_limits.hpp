// The limits of the set-point generator, and those of the path check, which are not published; rad,
// rad/s and rad/s^2.
#pragma once

#include <algorithm>

#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

struct MotionLimits {
  Joints speed;                    ///< highest speed of the joints
  double acceleration = 40.0;      ///< of a joint in moves: not published
  double position = 6.3355;        ///< 363 degrees: the default safety limit
  double sudden_change = 0.5;      ///< distance of a servo set-point from the present target
  double sudden_stop = 0.1;        ///< target speed from which a standstill is too sudden
  double stop_acceleration = 4.0;  ///< of a program that ends
  double protective_acceleration = 12.0;

  MotionLimits();
};

/// Limits a speed, acceleration or time of a script to a range that arithmetic can handle; returns
/// the default for a value that is not positive or NaN.
inline double given_or(double value, double otherwise) {
  return value > 0.0 ? std::clamp(value, 1e-9, 1e9) : otherwise;
}

}  // namespace tactus::ur
