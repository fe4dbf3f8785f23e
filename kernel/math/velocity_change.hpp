// The fastest change of velocity, from (v, a) to (w, 0) with the accelerations of one sign limited
// to A: jerk, hold, jerk back. All motions of axis_motion.hpp are composed of such changes.
//
// A rise applies jerk +j up to the peak x, holds x, and applies -j back to zero. The velocity
// gained,
//
//   w - v = (x^2 - a^2) / 2j + x t_hold + x^2 / 2j,
//
// gives x^2 + j x t_hold = q with the radicand q = j (w - v) + a^2 / 2:
//
//   q < A^2:  x = sqrt(q), t_hold = 0      otherwise:  x = A, t_hold = (q - A^2) / (j A)
//   t_on = (x - a) / j, t_off = x / j
//
// which requires w >= rest_velocity(v, a): then q >= a^2 where a > 0, and t_on >= 0. With
// v_on = v + t_on (a + x) / 2, the velocity at the end of the first ramp, and the last ramp seen
// backwards from w, the distance is
//
//   d = t_on (v + t_on (2a + x) / 6) + t_hold (v_on + x t_hold / 2) + t_off (w - x t_off / 6)
//
// Duration T and distance grow with w, with and without a hold, by
//
//   dT/dw = 1 / x,  dd/dw = w / x + x / 2j
//
// (without a hold: x' = j / 2x, T = (2x - a) / j). A fall is a mirrored rise.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/math/axis_motion.hpp"

namespace tactus {

/// A little less than 2: a deceleration of sqrt(2 j (v_hi - v_lo)) at one limit of velocity could
/// just be run out above the other, and this one after rounding too.
inline constexpr double kAlmostTwo = 1.999999;

struct VelocityChange {
  double on, hold, off;  ///< s
  double peak;           ///< magnitude of the acceleration held
  double distance;
  double duration() const { return on + hold + off; }
};

/// Returns the velocity that remains if the acceleration is run out at once.
inline double rest_velocity(double v, double a, double j) {
  return v + 0.5 * a * std::abs(a) / j;
}

/// Returns the rise of radicand q, for a caller that knows q better than from w - v.
inline VelocityChange rise_of_radicand(double q, double v, double a, double w, double a_max,
                                       double j) {
  const bool holds = q >= a_max * a_max;
  const double x = holds ? a_max : std::sqrt(q);
  const double hold = holds ? (q - a_max * a_max) / (j * a_max) : 0.0;
  const double on = std::max(0.0, (x - a) / j), off = x / j;
  const double v_on = v + 0.5 * on * (a + x);
  const double distance = on * (v + on * (2.0 * a + x) / 6.0) + hold * (v_on + 0.5 * x * hold) +
                          off * (w - x * off / 6.0);
  return {on, hold, off, x, distance};
}

/// Returns the change between velocities v and w without acceleration, of radicand q = j |w - v|.
/// Its mean velocity is that of its ends.
inline VelocityChange change_from_rest(double q, double v, double w, double a_max, double j) {
  const bool holds = q >= a_max * a_max;
  const double x = holds ? a_max : std::sqrt(q);
  const double hold = holds ? (q - a_max * a_max) / (j * a_max) : 0.0;
  return {x / j, hold, x / j, x, 0.5 * (v + w) * (2.0 * x / j + hold)};
}

/// Returns the radicand of a rise, at least that of w = rest_velocity(v, a, j), where the
/// difference of the velocities may leave nothing but rounding.
inline double rise_radicand(double v, double a, double w, double j) {
  return std::max(a > 0.0 ? a * a : 0.0, j * (w - v) + 0.5 * a * a);
}

/// Returns the rise for w >= rest_velocity(v, a, j), a <= a_max.
inline VelocityChange rise(double v, double a, double w, double a_max, double j) {
  return rise_of_radicand(rise_radicand(v, a, w, j), v, a, w, a_max, j);
}

/// Returns the fall for w <= rest_velocity(v, a, j), a >= -a_max; a_max is a magnitude.
inline VelocityChange fall(double v, double a, double w, double a_max, double j) {
  VelocityChange change = rise(-v, -a, -w, a_max, j);
  change.distance = -change.distance;
  return change;
}

/// Appends the phases of a change; `jerk` is that of the first ramp.
inline void append(AxisPlan& plan, const VelocityChange& change, double jerk) {
  plan.append(change.on, jerk);
  plan.append(change.hold, 0.0);
  plan.append(change.off, -jerk);
}

inline AxisLimits mirrored(const AxisLimits& limits) {
  return {-limits.v_hi, -limits.v_lo, limits.a_up, limits.a_dn, limits.j};
}
inline AxisState mirrored(const AxisState& state) {
  return {-state.p, -state.v, -state.a};
}

}  // namespace tactus
