// The shortest motion from a state inside the limits to (vf, 0) at the distance D, in the frame in
// which D is beyond the distance d of the direct change of velocity. The jerk then begins positive,
// has the signs "+ ... - ... +", and there are two forms of the motion:
//
// 1. Over a velocity w without acceleration: a rise (v, a) -> w >= max(v1, vf) with v1 the rest
//    velocity of (v, a), perhaps a cruise, and a fall w -> vf. See over_velocity.cpp.
// 2. Only if the axis brakes (a < 0) and must end at a lower velocity than v1 (vf < v1): the jerk
// is
//    positive for a time and changes sign before the acceleration is zero. See while_braking.cpp.
//
// The distances of form 2 begin at the direct change and end where form 1 begins, at w = v1.
#pragma once

#include "kernel/math/axis_motion.hpp"

namespace tactus {

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
