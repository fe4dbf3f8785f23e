// Curve: a path of the arm over a coordinate x from 0 to length(), and how fast it can be followed:
// at samples of the curve with dq/dx = q' and d(q')/dx = q'', no joint exceeds its limits if
//
//   dx/dt <= speed / |q'|,   dx/dt <= sqrt(ddq / |q''|),   d2x/dt2 <= ddq / |q'|
//
// where the last two share the acceleration.
#pragma once

#include "sim_plant/ur/motion/motion_limits.hpp"

namespace tactus::ur {

class Curve {
 public:
  virtual double length() const = 0;
  /// Returns the posture at `x` nearest to `near`, rad, and dq/dx. False: there is none.
  virtual bool at(double x, const Joints& near, Joints& q, Joints& slope) const = 0;

 protected:
  ~Curve() = default;
};

/// Speed and acceleration, in units of x per s and s^2.
struct Rates {
  double v = 0.0, a = 0.0;
};

/// Returns the highest rates that the joints allow, with `share` of their acceleration for bends.
/// `q` is the posture at the beginning and becomes that at the end. False: the arm cannot follow.
/// [any]
bool fastest(const Curve& curve, double share, const MotionLimits& limits, Joints& q, Rates& rates);

}  // namespace tactus::ur
