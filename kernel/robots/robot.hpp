// The robot of this program. The build passes its name and the header that includes its two tables.
#pragma once

#include TACTUS_ROBOT_TABLES

namespace tactus {

using Robot = TACTUS_ROBOT;
using RobotCapsules = Capsules<Robot>;

}  // namespace tactus
