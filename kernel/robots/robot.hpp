// The robot of this program. The build passes its name and the header that includes its two tables.
#pragma once

#include TACTUS_ROBOT_TABLES

namespace tactus {

using Robot = TACTUS_ROBOT;
using RobotCapsules = Capsules<Robot>;

/// True if a joint, counted from 0, moves along its axis. [any]
constexpr bool is_prismatic(int joint) {
  return Robot::kJoints[static_cast<unsigned>(joint)].type == JointType::kPrismatic;
}

/// True if a joint of the robot is prismatic.
inline constexpr bool kSomePrismatic = [] {
  for (int i = 0; i < Robot::kDof; ++i)
    if (is_prismatic(i)) return true;
  return false;
}();

/// Returns the unit of a joint's position, "rad" or "m". [any]
constexpr const char* position_unit(int joint) {
  return is_prismatic(joint) ? "m" : "rad";
}

}  // namespace tactus
