// The shortest motion from a state inside the limits to (vf, 0) at the distance D, seen so that D
// lies beyond the distance d of the direct change of velocity. Then the jerk begins positive, the
// motion has signs "+ ... - ... +", and there are two forms of it:
//
// 1. Over a velocity w without acceleration: a rise (v, a) -> w >= max(v1, vf), with v1 the rest
//    velocity of (v, a), perhaps a cruise, and a fall w -> vf. See over_velocity.cpp.
// 2. Only if it brakes (a < 0) and is told to stop later (vf < v1): the jerk is positive for a time
//    and turns before the acceleration is zero. See while_braking.cpp.
//
// The second form begins at the direct change and ends where the first begins, at w = v1.
#pragma once

#include "kernel/math/axis_motion.hpp"

namespace tactus {

/// Frame: mirrored where `side` is -1; the start is at position zero.
struct Ascent {
  AxisLimits limits;
  double side;
  double v, a;       ///< at the start
  double v1;         ///< rest velocity of the start
  double vf;         ///< at the end
  double distance;   ///< D
  double missing;    ///< of what has been tried: D less its distance, > 0
  double tolerance;  ///< of distances: what rounding leaves

  bool rises_to_end() const { return vf >= v1; }
};

/// The state and the target (p, v, 0) seen so that what is missing is not negative. The
/// tolerance is the rounding of the way.
Ascent ascent_of(const AxisState& s, double p, double v, const AxisLimits& limits, double missing);
/// Appends form 2 if it is the shortest; else false, and what is missing is that of its end.
bool append_while_braking(AxisPlan& plan, Ascent& ascent);
/// Appends form 1.
void append_over_velocity(AxisPlan& plan, const Ascent& ascent);

}  // namespace tactus
