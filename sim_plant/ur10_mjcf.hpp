// The plant's own model of the UR10 (CB3): typed from the published tables, independent of
// kernel/model, so that a fault in the kernel's model cannot hide in the plant.
#pragma once

#include <array>

namespace tactus {

struct Ur10Mjcf {
  /// MJCF with the bodies and joints that compile_arm.hpp names. The tensor of a link stands as
  /// user data of its body, the friction a, b, c as that of its joint.
  static const char kText[];

  /// Where the paper's UR10 pipelines begin, rad: upper arm nearly upright, flange in front.
  static constexpr std::array<double, 6> kReadyPose = {0.0, -1.67, 1.87, 2.94, -1.57, 0.0};

  /// How ROS's base_link, in which scenes are described, is turned about z in the base, rad.
  static constexpr double kBaseLinkYaw = 3.14159265358979323846;

  /// What a drive can do, N m and rad/s: the manufacturer's article "Max. joint torques"; the
  /// speeds at which the CB3's safety system steps in by default (131.46 and 191.46 degrees per
  /// second).
  static constexpr std::array<double, 6> kDriveTorque = {330.0, 330.0, 150.0, 56.0, 56.0, 56.0};
  static constexpr std::array<double, 6> kDriveSpeed = {2.2944, 2.2944, 3.3416,
                                                        3.3416, 3.3416, 3.3416};
};

}  // namespace tactus
