// The plant's own model of the robot this program is built for, in <robot>_mjcf.cpp: typed from the
// published tables, independent of kernel/model, so that a fault in the kernel's model cannot hide
// in the plant.
#pragma once

#include <array>

#include "kernel/core/types.hpp"

namespace tactus {

struct RobotMjcf {
  /// MJCF of the bodies that compile_arm.hpp names, from link1 to flange, each with its joint and
  /// none closed. The tensor of a link is user data of its body, the friction a, b, c user data of
  /// its joint; a joint without it has none.
  const char* bodies;

  std::array<double, kDof>
      ready_pose;  ///< joint positions at start unless a file gives others, rad

  /// Angle of ROS's base_link about z in the base frame, rad; scenes are described in base_link.
  double base_link_yaw;

  std::array<double, kDof> drive_torque;  ///< maximum of a drive, N m
  std::array<double, kDof> drive_speed;   ///< maximum of a drive, rad/s
};

/// Constants. [any]
const RobotMjcf& robot_mjcf();

}  // namespace tactus
