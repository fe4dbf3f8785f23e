// Compiles the MJCF text of the program's robot to a MuJoCo model.
#pragma once

#include <mujoco/mujoco.h>

namespace tactus {

/// Compiles the robot without payload and rotor inertia from memory, without reading a file. The
/// bodies are "link1", "link2" and so on, "flange" and "payload" (massless, at the flange); each
/// joint has a torque motor; jnt_user holds the friction a, b, c of the joint. The caller frees the
/// model with mj_deleteModel. Null only if MuJoCo runs out of memory. [init]
mjModel* compile_arm();

}  // namespace tactus
