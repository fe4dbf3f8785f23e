// Sources of the numbers: the simulated worlds and trajectories of the paper's demo repository.
//
// There wall and ramp are boxes in the world of the simulator. With the wall, the robot's base is
// at the world's origin. With the ramp it is 1 m above it, so 1 m is subtracted here (the
// trajectory, z = -0.133 m, is in the base frame).
//
// The place of the real blackboard is not published. Its trajectory begins at x = 0.730 m, goes to
// x = 0.750 m, and slides at y = 0.385 m from z = 0.798 m to z = 0.598 m. Here the tip touches the
// board at x = 0.731 m: by our choice 1 mm after the beginning, which is free of contact.
#include "sim_plant/arm/scene.hpp"

#include <cmath>

namespace tactus {
namespace {

/// Returns a box with this centre and full size, m, turned by `pitch` about y, rad.
Box box(const Vector3& centre, const Vector3& size, double pitch = 0.0) {
  Box result;
  result.pose.p = centre;
  result.pose.r = Eigen::Quaterniond(std::cos(pitch / 2.0), 0.0, std::sin(pitch / 2.0), 0.0);
  result.half_extents = size / 2.0;
  return result;
}

}  // namespace

Scene make_scene(SceneKind kind, const Vector3& offset, double tip_radius) {
  Scene scene;
  switch (kind) {
    case SceneKind::kNone: break;
    case SceneKind::kWall:  // face y = 0.80 m
      scene = {{box({0.0, 0.85, 0.5}, {0.50, 0.10, 1.00})}, 1};
      break;
    case SceneKind::kBlackboard: {
      constexpr double kMeets_m = 0.731, kThickness_m = 0.02;
      const double x = kMeets_m + tip_radius + kThickness_m / 2.0;
      scene = {{box({x, 0.385, 0.7}, {kThickness_m, 1.2, 1.0})}, 1};
      break;
    }
    case SceneKind::kRamp:  // and the plateau it leads to
      scene = {{box({0.18, 0.70, 0.84 - 1.0}, {1.0, 0.3, 0.01}, 0.21),
                box({-0.8, 0.35, 0.45 - 1.0}, {1.0, 1.0, 1.0})},
               2};
      break;
  }
  for (int i = 0; i < scene.count; ++i) scene.boxes[static_cast<std::size_t>(i)].pose.p += offset;
  return scene;
}

Scene turned(Scene scene, double yaw) {
  const Eigen::Quaterniond turn(std::cos(yaw / 2.0), 0.0, 0.0, std::sin(yaw / 2.0));
  for (int i = 0; i < scene.count; ++i) {
    Pose& pose = scene.boxes[static_cast<std::size_t>(i)].pose;
    pose = {turn * pose.p, turn * pose.r};
  }
  return scene;
}

}  // namespace tactus
