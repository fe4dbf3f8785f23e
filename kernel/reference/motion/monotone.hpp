// Monotone interpolation: velocities with which the cubics between waypoints do not overshoot.
//
// Between two waypoints a cubic with the secant d = (p1 - p0) / T stays between p0 and p1 if the
// velocities at its ends have the sign of d and are at most 3 |d| [Fritsch and Carlson 1980]. A
// waypoint that gives no velocity gets the weighted harmonic mean of its two secants
//
//   v = (w0 + w1) / (w0 / d0 + w1 / d1),  w0 = 2 T1 + T0,  w1 = T1 + 2 T0   [Fritsch and Butland
//   1984]
//
// which is less than 3 |d|, or zero where the path turns, begins or ends.
#pragma once

#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

/// Gives every waypoint such a velocity, axis by axis: chooses it if the trajectory gives none,
/// else lowers it as far as needed. The times must increase and all numbers be finite. The secant
/// of a rotation is the rotation vector from one waypoint to the next, in the base frame. [any, not
/// cyclic: proportional to its length]
template <class Space>
void make_monotone(const Trajectory<Space>& trajectory);

}  // namespace tactus
