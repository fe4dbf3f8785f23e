// The robot of this program. The build passes its name and the header that includes its two tables.
#pragma once

#include TACTUS_ROBOT_TABLES

namespace tactus {

using Robot = TACTUS_ROBOT;
using RobotCapsules = Capsules<Robot>;

/// Returns the unit of the position of joint i, "rad" or "m". [any]
constexpr const char* position_unit(int i) {
  return is_prismatic<Robot>(i) ? "m" : "rad";
}

}  // namespace tactus
