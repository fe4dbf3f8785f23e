// The wrench that a force/torque sensor at the flange feels, by Newton's laws for its load: a point
// mass m at c, in gravity g, and the contact force of the scene on the tip,
//
//   f = f_e + m (g - a_c)        a_c the acceleration of the point mass
//   n = n_e + c x m (g - a_c)
//
// that is, the wrench of tool and environment on the sensor, about the flange's origin and in its
// axes. At rest without contact it is the tool's weight, downwards; a wall that is pressed pushes
// back.
#pragma once

#include "kernel/core/types.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

/// Returns force, then moment, N and N m. `contact` is about the flange's origin, in the base
/// frame. Poses, velocities and accelerations in `data` must belong to one state. [cyclic]
Vector6 flange_wrench(const mjModel_* model, mjData_* data, const Vector6& contact);

}  // namespace tactus
