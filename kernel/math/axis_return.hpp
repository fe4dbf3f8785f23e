// From a state outside the limits of velocity and acceleration back inside, the shortest way and
// never further out than the acceleration that is there makes unavoidable: first the acceleration,
// then the velocity.
//
// Velocity v above v_hi, or about to be because the acceleration a > 0 cannot be run out in time:
// full jerk against it. It comes down to v_hi with the deceleration
//
//   x = sqrt(2 j (v - v_hi) + a^2)
//
// if that is at most b; otherwise b is held until v = v_hi. b is the limit, but at most
// sqrt(2 j (v_hi - v_lo)): a harder deceleration at v_hi cannot be run out above v_lo. One that is
// harder already is held until easing it off to b takes the rest, (a^2 - b^2) / 2j. Below v_lo the
// same in the mirror.
#pragma once

#include "kernel/math/velocity_change.hpp"

namespace tactus {

/// Neither velocity nor acceleration is outside, nor the velocity that this runs out to.
inline bool is_inside(const AxisState& state, const AxisLimits& limits) {
  const double v = state.v, rest = rest_velocity(v, state.a, limits.j);
  return state.a <= limits.a_up && state.a >= -limits.a_dn && std::max(v, rest) <= limits.v_hi &&
         std::min(v, rest) >= limits.v_lo;
}

/// Appends at most three phases and returns the state behind them; none for a state inside.
AxisState append_return(AxisPlan& plan, AxisState state, const AxisLimits& limits);

/// Its first part alone: at most one phase.
AxisState append_acceleration_return(AxisPlan& plan, AxisState state, const AxisLimits& limits);

}  // namespace tactus
