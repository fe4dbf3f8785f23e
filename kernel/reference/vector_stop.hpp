// The stop of a vector whose velocity has a direction: acceleration and jerk are bounded in length.
//
// An acceleration beside the velocity is run out first, by a jerk against it, during which the
// velocity goes straight to v + a |a| / (2 j); then the vector stops on the line of its velocity,
// as one axis does. So the speed never exceeds the larger of |v| and |v + a |a| / (2 j)|.
#pragma once

#include "kernel/math/axis_motion.hpp"
#include "kernel/types.hpp"

namespace tactus {

struct VectorState {
  Vector3 p = Vector3::Zero(), v = Vector3::Zero(), a = Vector3::Zero();
};

/// The state dt_s later on the stop with |a| <= a_max and |da/dt| <= j_max. [cyclic]
VectorState stop_on(const VectorState& from, double a_max, double j_max, double dt_s);

/// What the stop passes on one axis, 0 to 2. [cyclic]
AxisRange stop_range(const VectorState& from, double a_max, double j_max, int axis);

}  // namespace tactus
