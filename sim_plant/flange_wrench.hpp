// What a force/torque sensor at the flange feels, by Newton's laws for all that hangs on it: a
// point mass m at c, in gravity g, and the contact force of the scene on the tip,
//
//   f = f_e + m (g - a_c)        a_c the acceleration of the point mass
//   n = n_e + c x m (g - a_c)
//
// that is what tool and environment together exert on the sensor, at the flange's origin and in its
// axes. At rest and free it is the tool's weight, downwards; pressing on a wall the wall pushes
// back.
#pragma once

#include "kernel/types.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

/// Force first, N and N m. `contact` is at the flange's origin and in the base frame. The state in
/// `data` is complete: poses, velocities and accelerations belong together. [cyclic]
Vector6 flange_wrench(const mjModel_* model, mjData_* data, const Vector6& contact);

}  // namespace tactus
