// The arm's capsules for tests: placed by the kernel's link frames, with a bound of how far joints
// move their points.
#pragma once

#include <algorithm>

#include "kernel/guard/guard.hpp"
#include "kernel/guard/separation.hpp"
#include "kernel/model/link_frames.hpp"

namespace tactus {

struct ArmCapsule {
  int link = 0;
  Capsule shape;  ///< m, in the frame of the link

  ArmCapsule() = default;
  ArmCapsule(int link_, const Capsule& shape_) : link(link_), shape(shape_) {}
  explicit ArmCapsule(const LinkCapsule& entry)
      : link(entry.link), shape{Vector3(entry.a), Vector3(entry.b), entry.radius} {}

  Capsule placed(const LinkFrames<Robot>& frames) const {
    const LinkFrame& frame = frames[static_cast<std::size_t>(link)];
    return {frame.at(shape.a), frame.at(shape.b), shape.radius};
  }
  /// No point is farther from axis `joint`, from 0, at any position, m; 1 for a prismatic one.
  double reach(int joint) const {
    if (is_prismatic<Robot>(joint)) return 1.0;
    double sum = shape.radius + std::max(shape.a.norm(), shape.b.norm());
    for (int i = joint + 1; i < link; ++i) {
      const JointFrame& next = Robot::kJoints[static_cast<std::size_t>(i)];
      sum += Vector3(next.x, next.y, next.z).norm();
      const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
      // The guard lets a joint be that far beyond a limit.
      constexpr double kBeyond = Guard::kLedBack + Guard::kPositionTolerance;
      if (is_prismatic<Robot>(i)) sum += std::max(-limit.q_min, limit.q_max) + kBeyond;
    }
    return sum;
  }
  /// How far a point moves at most against the links before joint `axis`, if the joints turn by
  /// these angles, m.
  double way(int axis, const JointVector& angles) const {
    double sum = 0.0;
    for (int joint = axis; joint < link; ++joint) sum += reach(joint) * angles[joint];
    return sum;
  }
};

}  // namespace tactus
