// From the MJCF text of the program's robot to a MuJoCo model.
#pragma once

#include <mujoco/mujoco.h>

namespace tactus {

/// The robot without payload and rotor inertia, compiled from memory: no file is looked up. Bodies
/// "link1", "link2" and so on, "flange" and "payload" (massless, at the flange); one torque motor
/// per joint; jnt_user holds the friction a, b, c of the joint. The caller frees it with
/// mj_deleteModel. Null only when MuJoCo has no memory for it. [init]
mjModel* compile_arm();

}  // namespace tactus
