// The common first steps of the plans of axis_motion.hpp: the check of the inputs, and the direct
// change of velocity, which decides the direction of all the rest.
#pragma once

#include "kernel/math/velocity_change.hpp"

namespace tactus {

/// True if all numbers are finite and the limits have the right signs. A sum of numbers is finite
/// only if each of them is.
inline bool usable(const AxisState& s, double p, double v, const AxisLimits& l) {
  const double sum = s.p + s.v + s.a + p + v + l.v_lo + l.v_hi + l.a_dn + l.a_up + l.j;
  return sum - sum == 0.0 && l.v_lo < 0.0 && l.v_hi > 0.0 && l.a_dn > 0.0 && l.a_up > 0.0 &&
         l.j > 0.0;
}

/// Returns two units of rounding of the positions. A distance is not known better, and a moving
/// target missed by less than that would cost another approach.
inline double rounding_of_way(double from, double to) {
  return 4.5e-16 * (std::abs(from) + std::abs(to));
}

/// Replaces a plan that has left the range of doubles by one that is NaN.
inline void make_finite(AxisPlan& plan) {
  if (!(plan.duration() - plan.duration() == 0.0)) plan = {};
}

struct DirectChange {
  VelocityChange change;
  double jerk;  ///< of its first ramp
};

/// Returns the fastest change from a state to (w, 0), v_lo <= w <= v_hi, at any position.
inline DirectChange direct_change(const AxisState& s, double w, const AxisLimits& limits) {
  const double j = limits.j;
  return w >= rest_velocity(s.v, s.a, j) ? DirectChange{rise(s.v, s.a, w, limits.a_up, j), j}
                                         : DirectChange{fall(s.v, s.a, w, limits.a_dn, j), -j};
}

/// Appends the return inside the limits and the shortest motion from there to (p, v, 0).
void append_motion(AxisPlan& plan, const AxisState& from, double p, double v,
                   const AxisLimits& limits);

}  // namespace tactus
