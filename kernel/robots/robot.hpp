// The robot of this program. The build passes its name and the header that includes its two tables.
#pragma once

#if !defined(TACTUS_ROBOT) || !defined(TACTUS_ROBOT_TABLES)
#error "the board names its robot: ROBOT := Fer in board.mk"
#endif

#include TACTUS_ROBOT_TABLES

namespace tactus {

using Robot = TACTUS_ROBOT;
using RobotCapsules = Capsules<Robot>;

}  // namespace tactus
