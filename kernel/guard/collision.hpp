// Collision: keeps the arm away from its surroundings and itself, as a row of the executive.
//
// It checks every pair of the arm's capsules (kernel/robots/*_capsules.hpp and the tool) on
// different links that are not neighbours, and every moving capsule against every box of the file,
// except the pairs that [collision] allows and those that always touch by the robot's table. A
// contact is a distance that is not proved to be more than `margin`: now, at the measured joints,
// and in every position the joints can take until the arm is at rest: the reference that they
// follow moves within limits and brakes (stopping.hpp), and the joints stay between where they are
// and where it gets, but for the overshoot of the loop, [collision] lateness and overshoot.
//
// For a body that is inside a box, and a tool that is the hull of points, the box and the capsule
// around it are looked at first, in closed form; where that proves too little, the bodies
// themselves (convex.hpp). A cycle tries at most kMostDirections for them; what it could not prove
// with these counts as a contact.
//
// Every pair has a credit: the distance that was proved last, plus the way that its second body can
// have made until then. That way is the sum over the joints k between the bodies of (reach_k times
// the angle that joint k has travelled, to and fro), where reach_k is the largest distance of the
// body's points from axis k, and 1 for a prismatic joint and its travel. While the credit exceeds
// the margin plus the way until now plus the farthest way until rest, the pair stays apart, and its
// shapes are not looked at.
//
// A pair without that credit is looked at: now, where its credit begins anew, and if that does not
// last until rest, in nine sections of the way to rest. These ten positions of the arm follow from
// the state of the cycle in which the check begins, and are spread evenly over N = [collision]
// cycles. The next check begins in the cycle after.
//
// Guarantee. If a check of the state (q, dq) ends without a contact, the capsules and boxes of
// every pair that is checked are more than `margin` apart from then until the arm is at rest, if
//   - the joints are where they were measured, with at most the delay delay_s, and the tables are
//     true;
//   - the reference of no joint exceeds the acceleration limit of [guard] until the next check
//     ends, N cycles after this one, and one cycle more: in all 2 N cycles after the measurement;
//   - from then on, if that next check finds a contact, every reference brakes with `braking`,
//     reached with the jerk of [guard]: the executive brakes at once after a fault of a row;
//   - no joint leaves the range between where it was and where its reference gets by more than
//     `lateness` times its velocity and `overshoot` times the lag and the way of the reference.
// Motion between the checked positions is covered. In a section of the way joint k is within half_k
// of the middle. A point of the second body moves by at most the sum of half_k times reach_k, and
// the pair is made thicker by that.
//
// Fails closed: NaN and a degenerate direction are contacts, and give no credit.
#pragma once

#include "kernel/core/hal.hpp"
#include "kernel/guard/collision_section.hpp"
#include "kernel/guard/convex.hpp"
#include "kernel/guard/separation.hpp"
#include "kernel/guard/stopping.hpp"
#include "kernel/model/link_frames.hpp"

namespace tactus {

class Collision {
 public:
  struct Telemetry {
    const char *first = "", *second = "";  ///< the pair of the contact
    bool predicted = false;                ///< ahead, not at the measured joints
    bool unproved = false;                 ///< no direction was left to prove that there is none
    double sweep_m = 0.0;                  ///< thickness added to the pair
    std::int64_t checks = 0;               ///< ended, by a contact too
  };

  /// Sets up the pairs and restarts the check. `limits` are those of [guard]; `tip` is the
  /// tool tip, m, in the flange frame; `reference` are the positions that the joints follow, rad,
  /// null if they are not known. The boxes stay where they are then. Section and reference
  /// must outlive this object. [init]
  [[gnu::cold]] void start(const CollisionSection& section, const JointLimits& limits,
                           const Vector3& tip, double period_s,
                           const JointVector* reference = nullptr);

  /// Restarts the check, with a reference at rest and the boxes as they are now. [init]
  [[gnu::cold]] void begin_anew();

  /// Does a cycle's part of a check. `measured` counts in the cycle in which a check begins.
  /// Returns kCollision, with the pair in telemetry, and lets the next check begin;
  /// kStateNotFinite if q or dq is not finite; kNotStarted before start(). [cyclic]
  Status step(const RobotState& measured);

  /// Does a whole check of a state and of the boxes as they are now, without credit, instead of the
  /// one that is under way. As its drives are enabled, the arm gives way to `unknown_payload` under
  /// `gravity`, m/s^2 in the base frame. Returns as step(). [init]
  [[gnu::cold]] Status check(const RobotState& measured, const Vector3& gravity);

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  static constexpr int kMaxPairs = count_pairs() + kArmCapsules * kMaxObstacles;
  static_assert(kMaxPairs <= 256, "a pair's number has 8 bits");

  /// A capsule; `reach` is the largest distance of its points from each joint's axis, m.
  struct Body {
    int link = 0;   // that it moves with
    Capsule shape;  // in the frame of the link
    JointVector reach = JointVector::Zero();
  };
  static constexpr double kNoCredit = -1.0;

  /// The second capsule moves against another one, or against a box; `axis` is the first joint
  /// between them, from 0.
  struct Pair {
    double credit = kNoCredit;  // m
    std::uint8_t second = 0, first = 0, axis = 0;
    bool of_box = false;
  };
  static constexpr int kMostDirections = 512;
  struct Placed {
    Capsule capsule;
    JointVector ways = JointVector::Zero();  // m: from joint k up
  };
  /// A link or the tool as the hull of points.
  struct ArmHull {
    int body = 0;
    LinkFrame in_link;  // its axes and the middle of the hull, in the frame of the link
    Solid placed;
  };
  static constexpr int kMostHulls = kConvexBodies ? kToolBody + 1 : 0;
  /// The motion that the joints follow: none is farther from it than `error` until it rests.
  struct Reference {
    JointVector q, dq, error;  // rad, rad/s
  };
  using Ways = std::array<JointVector, kArmCapsules>;

  [[gnu::cold]] void add_capsules(const CollisionSection& section, const Vector3& tip);
  [[gnu::cold]] void add_pairs();
  [[gnu::cold]] void add_pair(int second, int first, int axis, bool of_box);
  bool is_allowed(int first, int second) const;
  void forget();
  void follow(const RobotState& measured, const JointVector* sag);
  [[gnu::cold]] JointVector sag_at(const JointVector& q, const Vector3& gravity) const;
  void travel(const JointVector& q);
  Status advance(const RobotState& measured, const JointVector* sag = nullptr);
  Status look_now();
  Status look_ahead();
  Status end(Status status);
  Status contact(const Pair& pair, double sweep_m);
  Ways ways(const JointVector& angles) const;
  void place(const JointVector& q, const JointVector& angles);
  double proved_distance(const Pair& pair, double wanted);

  // In convex_pairs.cpp; a board without convex bodies has none of these.
  void add_hulls(const CollisionSection& section);
  void add_hull(int body, const Hull& points, double rounding, const LinkFrame& axes);
  void place_hulls(const LinkFrames<Robot>& frames);
  const Solid* hull_of(int capsule) const;
  bool is_convex(const Pair& pair) const;
  bool counts_as(int capsule, bool hull) const;
  double convex_distance(const Pair& pair, double wanted);
  double box_distance(const Pair& pair, bool hull, double wanted);
  Solid arm_solid(int capsule, bool hull) const;

  const CollisionSection* section_ = nullptr;
  int positions_ = 0;  // looked at in a cycle
  Braking braking_;
  double period_s_ = 0.0;
  const JointVector* followed_ = nullptr;
  JointVector last_followed_ = JointVector::Zero();
  std::array<Body, kArmCapsules> bodies_;
  std::array<BoxShape, kMaxObstacles> boxes_;
  std::array<Pair, kMaxPairs> pairs_;
  int pair_count_ = 0;

  JointVector last_q_ = JointVector::Zero();
  JointVector travelled_ = JointVector::Zero();  // each joint's angles, to and fro, rad

  int next_ = 0;                               // position; 0: a check begins
  JointVector q_, from_;                       // in which it began, and what had been travelled
  Reference reference_;                        // in which it began
  std::array<std::uint8_t, kMaxPairs> due_{};  // pairs that it looks at ahead
  int due_count_ = 0;
  std::array<Placed, kArmCapsules> placed_;  // in this position
  std::array<ArmHull, kMostHulls> hulls_;
  int hull_count_ = 0;
  int directions_ = 0;  // left in this cycle
  Telemetry telemetry_;
};

}  // namespace tactus
