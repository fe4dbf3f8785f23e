// The list of robots, one line each, and the robot of this program. The line of a robot includes
// its two tables; its other files are found by its name (docs/add_a_board.md).
#pragma once

#include "kernel/robots/fer_capsules.hpp"
#include "kernel/robots/gen3_capsules.hpp"
#include "kernel/robots/ur10_capsules.hpp"

#ifndef TACTUS_ROBOT
#error "the board names its robot: ROBOT := Fer in board.mk"
#endif

namespace tactus {

using Robot = TACTUS_ROBOT;
using RobotCapsules = Capsules<Robot>;

}  // namespace tactus
