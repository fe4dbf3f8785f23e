// The stop of a vector with bounds on the lengths of acceleration and jerk.
//
// An acceleration that raises the speed, or is across the velocity, is first reduced to zero by a
// jerk against it, during which the velocity goes straight to v + a |a| / (2 j). Then the vector
// stops on the line of its velocity like a single axis. So the speed never exceeds the larger of
// |v| and |v + a |a| / (2 j)|, at whatever times the stop is replanned.
#pragma once

#include <array>
#include "kernel/core/types.hpp"
#include "kernel/math/axis_motion.hpp"

namespace tactus {

struct VectorState {
  Vector3 p = Vector3::Zero(), v = Vector3::Zero(), a = Vector3::Zero();
};

/// Returns the state dt_s later on the stop with |a| <= a_max and |da/dt| <= j_max. [cyclic]
VectorState stop_on(const VectorState& from, double a_max, double j_max, double dt_s);

/// Returns the range that the stop, made in periods of dt_s, covers on each axis. [cyclic]
std::array<AxisRange, 3> stop_ranges(const VectorState& from, double a_max, double j_max,
                                     double dt_s);

}  // namespace tactus
