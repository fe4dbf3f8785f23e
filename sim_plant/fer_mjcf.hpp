// The plant's own model of the FER: typed from the published tables, independent of kernel/model,
// so that a fault in the kernel's model cannot hide in the plant.
#pragma once

#include <array>

namespace tactus {

struct FerMjcf {
  /// MJCF with the bodies and joints that compile_arm.hpp names. The tensor of a link stands as
  /// user data of its body, the friction a, b, c as that of its joint.
  static const char kText[];

  static constexpr double kPi = 3.14159265358979323846;

  /// Elbow up, flange pointing down, away from every limit; rad.
  static constexpr std::array<double, 7> kReadyPose = {0.0, -kPi / 4.0, 0.0,      -3.0 * kPi / 4.0,
                                                       0.0, kPi / 2.0,  kPi / 4.0};

  /// How ROS's base_link, in which scenes are described, is turned about z in the base, rad.
  static constexpr double kBaseLinkYaw = 0.0;

  /// What a drive can do, N m and rad/s: Franka's data sheet (150 and 180 degrees per second).
  static constexpr std::array<double, 7> kDriveTorque = {87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0};
  static constexpr std::array<double, 7> kDriveSpeed = {2.618,  2.618,  2.618, 2.618,
                                                        3.1416, 3.1416, 3.1416};
};

}  // namespace tactus
