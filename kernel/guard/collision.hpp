// Collision: keeps the arm away from its surroundings and itself, as a slow row of the executive.
//
// It checks every pair of the arm's capsules (kernel/robots/*_capsules.hpp and the tool) on
// different links that are not neighbours, and every moving capsule against every box of the file,
// except the pairs that [collision] allows and those that always touch by the robot's table. A
// contact is a distance that is not proved to be more than `margin`: now, at the measured joints,
// and in every position the joints can take until the arm is at rest, if it begins to brake no
// later than one cycle after the next check (stopping.hpp).
//
// Guarantee. If check() returns kOk for the state (q, dq), the capsules and boxes of every pair
// that is checked are more than `margin` apart from now until the arm is at rest, if
//   - the joints are where they were measured, with at most the delay delay_s, and the tables are
//     true;
//   - until one cycle after the next check no joint exceeds the acceleration limit of [guard];
//   - from then on, if that next check is not kOk, every joint brakes with `braking`, reached with
//     the jerk of [guard]: the executive brakes at once after a fault of a row.
// Nothing between the checked positions is missed. In a section of the way joint k is within half_k
// of the middle. Against link i < j, a point of link j moves by at most the sum over k = i+1 ... j
// of (half_k times its largest distance from axis k), and the pair is made thicker by that.
//
// Fails closed: NaN, a degenerate direction, and used-up iterations or support calls are contacts.
// Cost: at most `support_calls` support points in a check, 4000 unless the file says less; the
// kinematics of 2 + kSections positions; and for each of them and each pair a test with balls.
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
    bool exhausted = false;                ///< support_calls were used up at this pair
    std::int64_t checks = 0;
    int support_calls = 0, most_support_calls = 0;  ///< in the last check, in any check
  };

  /// Sets up the pairs. `limits` are those of [guard]; `tip` is the tool tip, m, in the flange
  /// frame. The scene must outlive this object. [init]
  [[gnu::cold]] void start(const CollisionSection& section, const JointLimits& limits,
                           const Vector3& tip, double period_s);

  /// Returns kCollision, with the pair in telemetry; kStateNotFinite if q or dq is not finite;
  /// kNotStarted before start(). [cyclic]
  Status check(const RobotState& measured);

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  static constexpr int kCapsules = static_cast<int>(RobotCapsules::kCapsules.size()) + 1;
  static constexpr int kMaxPairs = kCapsules * (kCapsules - 1) / 2 + kCapsules * kMaxObstacles;

  /// A capsule; `reach` is the largest distance of its points from each joint's axis, m.
  struct Body {
    int body = 0, link = 0;  // number in the scene; the link it moves with
    Capsule shape;           // in the frame of the link
    JointVector reach = JointVector::Zero();
  };
  /// The second capsule moves against the first, or against a box.
  struct Pair {
    int second = 0, first = -1, box = -1;
  };

  [[gnu::cold]] void add_capsules(const Vector3& tip, double tool_radius);
  [[gnu::cold]] void add_pairs();
  bool meets(int first, int second) const;
  Status check_at(const JointVector& q, const JointVector& half, bool predicted);
  bool apart(const Pair& pair, double inflation);
  Status contact(const Pair& pair, double sweep, bool predicted);

  const CollisionScene* scene_ = nullptr;
  double margin_ = 0.0;
  int support_calls_ = 0;
  Braking braking_;
  std::array<Body, kCapsules> bodies_;
  std::array<Pair, kMaxPairs> pairs_;
  int pair_count_ = 0;
  std::array<BoxShape, kMaxObstacles> boxes_;  // in this check
  std::array<Capsule, kCapsules> placed_;      // at the joint positions being checked
  Telemetry telemetry_;
};

}  // namespace tactus
