// Collision: keeps the arm away from its surroundings and itself, as a row of the executive.
//
// It checks every pair of the arm's capsules (kernel/robots/*_capsules.hpp and the tool) on
// different links that are not neighbours, and every moving capsule against every box of the file,
// except the pairs that [collision] allows and those that always touch by the robot's table. A
// contact is a distance that is not proved to be more than `margin`: now, at the measured joints,
// and in every position the joints can take until the arm is at rest (stopping.hpp).
//
// A check looks at ten positions of the arm: now, and in nine sections of the way to rest. All of
// them follow from the state and the boxes of the cycle in which it begins. It is spread evenly
// over N = [collision] cycles, and the next check begins in the cycle after.
//
// Guarantee. If a check of the state (q, dq) ends without a contact, the capsules and boxes of
// every pair that is checked are more than `margin` apart from then until the arm is at rest, if
//   - the joints are where they were measured, with at most the delay delay_s, and the tables are
//     true;
//   - no joint exceeds the acceleration limit of [guard] until the next check ends, N cycles after
//     this one, and one cycle more: in all 2 N cycles after the measurement;
//   - from then on, if that next check finds a contact, every joint brakes with `braking`, reached
//     with the jerk of [guard]: the executive brakes at once after a fault of a row.
// Nothing between the checked positions is missed. In a section of the way joint k is within half_k
// of the middle. Against link i < j, a point of link j moves by at most the sum over k = i+1 ... j
// of (half_k times its largest distance from axis k), and the pair is made thicker by that.
//
// Fails closed: NaN and a degenerate direction are contacts. Cost: every position takes the same
// kinematics and, pair by pair, the same arithmetic, however near the arm is.
#pragma once

#include "kernel/core/hal.hpp"
#include "kernel/guard/collision_section.hpp"
#include "kernel/guard/separation.hpp"
#include "kernel/guard/stopping.hpp"
#include "kernel/model/link_frames.hpp"

namespace tactus {

class Collision {
 public:
  struct Telemetry {
    const char *first = "", *second = "";  ///< the pair of the contact
    bool predicted = false;                ///< ahead, not at the measured joints
    double sweep_m = 0.0;                  ///< thickness added to the pair
    std::int64_t checks = 0;               ///< ended, by a contact too
  };

  /// Sets up the pairs, and lets a check begin anew. `limits` are those of [guard]; `tip` is the
  /// tool tip, m, in the flange frame. The scene must outlive this object. [init]
  [[gnu::cold]] void start(const CollisionSection& section, const JointLimits& limits,
                           const Vector3& tip, double period_s);

  /// Does a cycle's part of a check. `measured` counts in the cycle in which a check begins.
  /// Returns kCollision, with the pair in telemetry, and lets the next check begin;
  /// kStateNotFinite if q or dq is not finite; kNotStarted before start(). [cyclic]
  Status step(const RobotState& measured);

  /// Does a whole check of a state, instead of the one that is under way. Returns as step(). [init]
  Status check(const RobotState& measured);

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  static constexpr int kCapsules = static_cast<int>(RobotCapsules::kCapsules.size()) + 1;
  static constexpr int kMaxPairs = kCapsules * (kCapsules - 1) / 2;
  static constexpr int kMaxBoxPairs = kCapsules * kMaxObstacles;

  /// A capsule; `reach` is the largest distance of its points from each joint's axis, m.
  struct Body {
    int body = 0, link = 0;  // number in the scene; the link it moves with
    Capsule shape;           // in the frame of the link
    JointVector reach = JointVector::Zero();
  };
  /// The second capsule moves against another one, or against a box; `axis` is the first joint
  /// between them, from 0.
  struct Pair {
    int second = 0, first = 0, axis = 0;
  };
  struct Swept {
    Capsule capsule;
    JointVector ways = JointVector::Zero();  // m: from joint k up, in the section
  };

  [[gnu::cold]] void add_capsules(const Vector3& tip, double tool_radius);
  [[gnu::cold]] void add_pairs();
  bool meets(int first, int second) const;
  bool is_allowed(int first, int second) const;
  void begin(const RobotState& measured);
  Status end(Status status);
  Status check_next();
  void place(const JointBox& box);
  Status contact(const Pair& pair, int first_body);
  const Body& body(int index) const { return bodies_[static_cast<std::size_t>(index)]; }
  const Swept& swept(int index) const { return swept_[static_cast<std::size_t>(index)]; }

  const CollisionScene* scene_ = nullptr;
  double margin_ = 0.0;
  int positions_ = 0;  // checked in a cycle
  Braking braking_;
  std::array<Body, kCapsules> bodies_;
  std::array<Pair, kMaxPairs> pairs_;         // of two capsules
  std::array<Pair, kMaxBoxPairs> box_pairs_;  // `first` is a box
  int pair_count_ = 0, box_pair_count_ = 0;

  int next_ = 0;        // position; 0: a check begins
  JointVector q_, dq_;  // of this check
  std::array<BoxShape, kMaxObstacles> boxes_;
  std::array<Swept, kCapsules> swept_;  // in this position
  Telemetry telemetry_;
};

}  // namespace tactus
