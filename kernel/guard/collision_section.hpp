// CollisionSection: the [collision] section of a pipeline file, and the scene that the loader makes
// of it and of the boxes in the file: the bodies, and the pairs that may touch.
#pragma once

#include <array>

#include "kernel/core/describe.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/guard/collision_pairs.hpp"
#include "kernel/guard/convex.hpp"
#include "kernel/guard/stopping.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus {

/// The numbers of a scene's bodies: the links, base first, then the tool, then the boxes.
inline constexpr int kFirstBoxBody = kToolBody + 1;
inline constexpr int kMaxObstacles = 8;
inline constexpr int kMaxBodies = kFirstBoxBody + kMaxObstacles;

/// A check looks at the arm now and in every section of its way to rest.
inline constexpr int kCheckedPositions = 1 + kSections;

struct CollisionScene {
  std::array<const char*, kMaxBodies> names{};  ///< those of the boxes are in the port table
  std::array<const Cuboid*, kMaxObstacles> boxes{};
  int body_count = kFirstBoxBody;
  std::array<std::array<bool, kMaxBodies>, kMaxBodies> allowed{};  ///< symmetric

  CollisionScene() {
    for (std::size_t i = 0; i < kToolBody; ++i) names[i] = RobotCapsules::kLinkNames[i];
    names[kToolBody] = "tool";
  }
  int box_count() const { return body_count - kFirstBoxBody; }
};

struct CollisionSection {
  bool present = false;       ///< the file has the section
  int cycles = 5;             ///< over which a check is spread, evenly
  int budget_us = 250;        ///< in each of them
  double margin = 0.01;       ///< m: a smaller distance is a contact
  double tool_radius = 0.02;  ///< m: the tool is a capsule from the flange to the tip,
  Hull tool_points;           ///< or this hull, in the flange frame, and what is within tool_radius
  LinkHulls link_points;      ///< a link is both in its capsules and in this hull, in its frame,
  double link_rounding = 0.0;  ///< or within so much of it, m
  double delay_s = 0.0;        ///< total delay of the measured state and the brake, s
  /// By which time of its velocity a joint that begins at a resting reference leaves it, s, and by
  /// which share of a step of the reference it overshoots. NaN: not known, a contact.
  JointVector lateness = JointVector::Constant(kRequired);
  JointVector overshoot = JointVector::Constant(kRequired);
  /// Compliance of each joint to torques that the law does not model, rad/(N m).
  JointVector compliance = JointVector::Constant(kRequired);
  double unknown_payload = 0.0;                 ///< kg at the tip, unknown to a law of torques
  JointVector braking = JointLimits().ddq_max;  ///< each joint's, braked at once, rad/s^2
  Value allow;                                  ///< "tool table, link7 table"

  CollisionScene scene;

  /// Returns a link with an end of a capsule that is farther from the link's hull than the radius
  /// of the capsule, or -1: the hull may be in another frame or unit. [init]
  int misplaced_hull() const;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("cycles", cycles, Range{1.0, 1.0 * kCheckedPositions}, "cycles");
    visit.param("budget_us", budget_us, Range{1.0, 100000.0}, "us");
    visit.param("margin", margin, Range{1e-3, 0.5}, "m");
    visit.param("tool_radius", tool_radius, Range{1e-4, 0.5}, "m");
    if constexpr (kConvexBodies) {
      visit.lines("tool_point", tool_points,
                  "x y z, x y z: of the tool's hull, in the flange frame, m");
      visit.lines("link_point", link_points,
                  "link5 x y z, x y z: of a link's hull, in the frame of the link, m");
      visit.param("link_rounding", link_rounding, Range{0.0, 0.5}, "m");
    }
    visit.param("delay_s", delay_s, Range{0.0, 1.0}, "s");
    visit.optional("lateness", lateness, Range{0.0, 1.0}, "s");
    visit.optional("overshoot", overshoot, Range{0.0, 1.0}, "1");
    visit.optional("compliance", compliance, Range{0.0, 10.0}, "rad/(N m)");
    visit.param("unknown_payload", unknown_payload, Range{0.0, 100.0}, "kg");
    visit.limit("braking", braking, "rad/s^2");
    visit.text("allow", allow, "pairs that may touch: tool table, link7 table");
  }
};

}  // namespace tactus
