// Elements of the plans of axis_motion.hpp: the change of velocity, the return inside the limits,
// the direct change, and the two forms of the ascent to a target that is farther away.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/math/axis_motion.hpp"

namespace tactus {

// The fastest change of velocity, from (v, a) to (w, 0) with the accelerations of one sign limited
// to A: jerk, hold, jerk back. All motions are composed of such changes.
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

/// Returns the rise of radicand q, for a caller that has q more exactly than w - v.
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

// The shortest return from a state outside the limits of velocity and acceleration, never further
// out than the present acceleration makes unavoidable: first the acceleration returns, then the
// velocity.
//
// If the velocity v is above v_hi, or will be because the acceleration a > 0 cannot be run out in
// time, the full jerk acts against it. The velocity comes down to v_hi with the deceleration
//
//   x = sqrt(2 j (v - v_hi) + a^2)
//
// if that is at most b; otherwise b is held until v = v_hi. b is the acceleration limit, but at
// most sqrt(2 j (v_hi - v_lo)): a harder deceleration at v_hi cannot be run out above v_lo. A
// deceleration that is already harder is held until easing it off to b takes the rest,
// (a^2 - b^2) / 2j. Below v_lo the motion is mirrored.

/// True if the acceleration, the velocity, and the velocity after running out the acceleration are
/// within the limits.
inline bool is_inside(const AxisState& state, const AxisLimits& limits) {
  const double v = state.v, rest = rest_velocity(v, state.a, limits.j);
  return state.a <= limits.a_up && state.a >= -limits.a_dn && std::max(v, rest) <= limits.v_hi &&
         std::min(v, rest) >= limits.v_lo;
}

/// Appends at most three phases and returns the state after them; none for a state inside.
AxisState append_return(AxisPlan& plan, AxisState state, const AxisLimits& limits);

/// Appends only the return of the acceleration: at most one phase.
AxisState append_acceleration_return(AxisPlan& plan, AxisState state, const AxisLimits& limits);

// The common first steps of the plans: the check of the inputs, and the direct change of velocity,
// which decides the direction of all the rest.

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

// The shortest motion from a state inside the limits to (vf, 0) at the distance D, in the frame in
// which D is beyond the distance d of the direct change of velocity. The jerk then begins positive,
// has the signs "+ ... - ... +", and there are two forms of the motion:
//
// 1. Over a velocity w without acceleration: a rise (v, a) -> w >= max(v1, vf) with v1 the rest
//    velocity of (v, a), perhaps a cruise, and a fall w -> vf.
// 2. Only if the axis brakes (a < 0) and must end at a lower velocity than v1 (vf < v1): the jerk
// is
//    positive for a time and changes sign before the acceleration is zero.
//
// The distances of form 2 begin at the direct change and end where form 1 begins, at w = v1.

/// In a frame that is mirrored if `side` is -1; the start is at position zero.
struct Ascent {
  AxisLimits limits;
  double side;
  double v, a;       ///< at the start
  double v1;         ///< rest velocity of the start
  double vf;         ///< at the end
  double distance;   ///< D
  double missing;    ///< D less the distance of the last trial, > 0
  double tolerance;  ///< of distances, for rounding

  bool rises_to_end() const { return vf >= v1; }
};

/// Returns the state and the target (p, v, 0) in the frame in which `missing` is not negative. The
/// tolerance is the rounding of the positions.
Ascent ascent_of(const AxisState& s, double p, double v, const AxisLimits& limits, double missing);
/// Returns a time of form 2 at which the jerk turns too late, if form 2 is the shortest; otherwise
/// a negative number, with `missing` at the end of form 2.
double late_turn(Ascent& ascent);
/// Appends form 2, which turns before `late`.
void append_while_braking(AxisPlan& plan, const Ascent& ascent, double late);
/// Appends form 1.
void append_over_velocity(AxisPlan& plan, const Ascent& ascent);

}  // namespace tactus
