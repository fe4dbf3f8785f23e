// Scene: the surroundings of the simulated arm, as boxes in the frame that ROS calls base_link (x
// forward, z up), as in the paper's demonstrations. The base frame of a robot's controller, and so
// the kernel's, may be turned about z relative to it.
#pragma once

#include <array>
#include <cstdint>

#include "sim_plant/arm/contact.hpp"

namespace tactus {

enum class SceneKind : std::uint8_t { kNone, kWall, kBlackboard, kRamp };

constexpr const char* name(SceneKind kind) {
  switch (kind) {
    case SceneKind::kNone: return "none";
    case SceneKind::kWall: return "wall";
    case SceneKind::kBlackboard: return "blackboard";
    case SceneKind::kRamp: return "ramp";
  }
  return nullptr;
}

inline constexpr int kMaxBoxes = 8;

struct Scene {
  std::array<Box, kMaxBoxes> boxes;
  int count = 0;
};

/// Returns the boxes of a scene in base_link, all moved by `offset`, m. The blackboard is farther
/// away by the radius of the tip's ball, m, so that the ball touches it at the intended place.
/// [init]
Scene make_scene(SceneKind kind, const Vector3& offset, double tip_radius);

/// Returns a scene in a frame in which base_link is turned by `yaw` about z, rad. [init]
Scene turned(Scene scene, double yaw);

}  // namespace tactus
