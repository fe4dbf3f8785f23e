// How the base is mounted: its orientation in the world by roll, pitch and yaw [rad] about the
// fixed axes x, y, z of the world, R = RotZ(yaw) RotY(pitch) RotX(roll), as URDF gives a fixed
// joint.
#pragma once

#include "kernel/core/types.hpp"

namespace tactus {

/// Returns gravity in the axes of the base, m/s^2: R^T (0, 0, -9.81), on which yaw has no effect.
/// [init]
Vector3 gravity_in_base(const Vector3& mounting);

}  // namespace tactus
