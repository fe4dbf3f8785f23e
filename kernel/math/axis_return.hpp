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
#pragma once

#include "kernel/math/velocity_change.hpp"

namespace tactus {

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

}  // namespace tactus
