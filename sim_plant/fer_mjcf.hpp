// The plant's own model of the FER: an MJCF text typed from the published tables, independent of
// kernel/model, so that a fault in the kernel's model cannot hide in the plant.
#pragma once

#include <mujoco/mujoco.h>

namespace tactus {

/// The FER without payload and rotor inertia, compiled from memory: no file is looked up. Bodies
/// "link1" .. "link7", "flange" and "payload" (massless, at the flange); one torque motor per
/// joint; jnt_user holds the friction a, b, c of the joint. The caller frees it with
/// mj_deleteModel. Null only when MuJoCo has no memory for it. [init]
mjModel* compile_fer();

}  // namespace tactus
