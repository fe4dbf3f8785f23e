// JointTurns: the whole turns between the waypoints of a trajectory. Recorders write the angles of
// joints without end within one turn, so that 170 degrees are followed by -170; taken as they are
// written, the joint turns back by 340 degrees.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/describe.hpp"
#include "kernel/core/text.hpp"
#include "kernel/core/types.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

/// Interpretation of the angles of continuous joints (Robot::kContinuousJoints). Angles of a joint
/// with stops are always taken as given, as each turn is another position for it.
enum class Wrap : std::uint8_t {
  kAsGiven,
  kNearest,  ///< each is the nearest to the waypoint before that differs by whole turns
};

constexpr const char* name(Wrap wrap) {
  switch (wrap) {
    case Wrap::kAsGiven: return "as_given";
    case Wrap::kNearest: return "nearest";
  }
  return nullptr;
}

/// A step to a waypoint in place of which one that differs by whole turns would be shorter; of a
/// joint with stops, one of nearly a turn.
struct TurnStep {
  int waypoint = -1, joint = -1;     ///< from 0; the step to waypoint 0 is that from the arm
  double step = 0.0, nearest = 0.0;  ///< rad; they differ by whole turns
};

class JointTurns {
 public:
  /// Farther apart, in turns, positions are no angles of one motion, and are taken as given.
  static constexpr double kMostTurns = 1e4;
  /// A step of a joint with stops that is so near to a whole turn is no motion, rad: a recorder of
  /// 50 samples a second moves a joint at 5 rad/s by less.
  static constexpr double kNearTurn = 0.1;

  /// Begins with the reference of the joints, rad, to which the first waypoint is compared; not
  /// finite: unknown, it is as given. [any]
  void begin(Wrap wrap, const JointVector& reference);
  /// Takes the same trajectory once more, from its first waypoint on. [any]
  void restart();
  /// Joints that are left out hold, and have no angles. [any]
  void leave_out(const JointSpace::Header& header) { held_ = header.held; }
  /// Takes the next waypoint; moves the angles of joints without end by whole turns if they are to
  /// be the nearest ones. NaN and what is farther than kMostTurns stay. [any]
  void take(JointSpace::Point& point);
  void take(const TaskSpace::Point&) {}

  /// Returns the step that explains a refusal: one of its joint to its waypoint, or one beside it.
  /// Null: none does. Only the first kMost steps of a trajectory are stored. [any]
  const TurnStep* explain(const Verdict& verdict) const;
  /// Returns the longest step of a joint without end; null: none is longer than half a turn.
  const TurnStep* longest() const { return longest_.joint >= 0 ? &longest_ : nullptr; }

 private:
  static constexpr std::size_t kMost = 64;

  void note(int joint, double angle);

  Wrap wrap_ = Wrap::kAsGiven;
  JointVector reference_ = JointVector::Constant(kInfinity);
  JointVector last_ = reference_;
  std::uint32_t held_ = 0;
  int count_ = 0;  // waypoints that were taken
  std::array<TurnStep, kMost> steps_;
  std::size_t found_ = 0;
  TurnStep longest_;
};

/// "; joint_1 goes by -5.93412 rad to waypoint 2, ...": the cause of a refusal, and its remedy.
/// [any]
Message remedy(const TurnStep& step);
/// Says that the long way is taken. [any]
Message describe(const TurnStep& step);

}  // namespace tactus
