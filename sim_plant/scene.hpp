// Scene: what stands around the simulated arm, as boxes in the frame that ROS calls base_link (x
// forward, z up), as the paper's demonstrations give them. The base frame of a robot's controller,
// and so the kernel's, may be turned against it about z.
#pragma once

#include <array>
#include <cstdint>

#include "sim_plant/contact.hpp"

namespace tactus {

enum class SceneKind : std::uint8_t { kNone, kWall, kBlackboard, kRamp };
inline constexpr std::array<const char*, 4> kSceneWords = {"none", "wall", "blackboard", "ramp"};

inline constexpr int kMaxBoxes = 2;

struct Scene {
  std::array<Box, kMaxBoxes> boxes;
  int count = 0;
};

/// The boxes of a scene in base_link, all moved by `offset`, m. The blackboard stands off by the
/// radius of the tip's ball, m, so that the ball meets it at a place of the tip. [init]
Scene make_scene(SceneKind kind, const Vector3& offset, double tip_radius);

/// A scene as it stands in a frame in which base_link is turned by `yaw` about z, rad. [init]
Scene turned(Scene scene, double yaw);

}  // namespace tactus
