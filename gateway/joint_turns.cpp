#include "gateway/joint_turns.hpp"

#include <cmath>
#include <cstdlib>

namespace tactus {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846, kTurn = 2.0 * kHalfTurn;  // rad

bool continuous(int joint) {
  return (Robot::kContinuousJoints >> joint & 1U) != 0;
}

constexpr double kDigits = 1e-4;  // rad: what a file of four decimals makes of half a turn

/// Returns the angle nearest to `from` that differs from `angle` by whole turns; `angle` itself if
/// it is within half a turn as files write it, or no number, or too far for the digits of a double.
double nearest(double angle, double from) {
  const double step = angle - from;
  const bool turns =
      std::abs(step) > kHalfTurn + kDigits && std::abs(step) <= JointTurns::kMostTurns * kTurn;
  return turns ? angle - kTurn * std::round(step / kTurn) : angle;
}

/// Degrees and other units are outside of the range of the joint; they are no turns.
bool in_range(double angle, int joint) {
  const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(joint)];
  return limit.q_min <= angle && angle <= limit.q_max;
}

bool of_motion(Status status) {
  return status == Status::kPositionLimit || status == Status::kVelocityLimit ||
         status == Status::kVelocityStep || status == Status::kAccelerationLimit ||
         status == Status::kJerkLimit || status == Status::kStartTolerance;
}

Message& add_step(Message& text, const TurnStep& step, const char* moves) {
  return text << Robot::kJointNames[static_cast<std::size_t>(step.joint)] << moves << step.step
              << " rad to waypoint " << step.waypoint + 1;
}

}  // namespace

void JointTurns::begin(Wrap wrap, const JointVector& reference) {
  wrap_ = wrap;
  reference_ = reference;
  longest_ = {};
  restart();
}

void JointTurns::restart() {
  last_ = reference_;
  held_ = 0;
  count_ = 0;
  found_ = 0;
}

void JointTurns::take(JointSpace::Point& point) {
  for (int i = 0; i < kDof; ++i) {
    if ((held_ >> i & 1U) != 0) continue;
    if (wrap_ == Wrap::kNearest && continuous(i)) point.q[i] = nearest(point.q[i], last_[i]);
    note(i, point.q[i]);
    last_[i] = point.q[i];
  }
  ++count_;
}

/// Notes the step to an angle if a whole turn is in it.
void JointTurns::note(int joint, double angle) {
  const double step = angle - last_[joint], shorter = nearest(angle, last_[joint]) - last_[joint];
  const bool turns = std::abs(shorter) < std::abs(step) && in_range(angle, joint);
  if (!turns || (!continuous(joint) && !(std::abs(std::abs(step) - kTurn) <= kNearTurn))) return;
  const TurnStep found = {count_, joint, step, shorter};
  if (found_ < kMost) steps_[found_++] = found;
  if (continuous(joint) && std::abs(step) > std::abs(longest_.step)) longest_ = found;
}

const TurnStep* JointTurns::explain(const Verdict& verdict) const {
  const TurnStep* best = nullptr;
  if (!of_motion(verdict.status) || verdict.waypoint < 0) return best;
  for (std::size_t i = 0; i < found_; ++i) {
    const int apart = std::abs(steps_[i].waypoint - verdict.waypoint);
    if (steps_[i].joint != verdict.axis || apart > 1) continue;
    if (best == nullptr || apart == 0) best = &steps_[i];
  }
  return best;
}

Message remedy(const TurnStep& step) {
  Message text("; ");
  if (!continuous(step.joint))
    return add_step(text, step, " jumps by ")
           << ", a turn (2 pi): write angles that go on where these begin again, within the range "
              "of the joint";
  return add_step(text, step, " goes by ")
         << ", where " << step.nearest
         << " rad lead to the same angle but for turns of 2 pi: wrap = nearest takes that way";
}

Message describe(const TurnStep& step) {
  Message text;
  return add_step(text, step, " turns by ")
         << ", where " << step.nearest
         << " rad lead to the same angle; wrap = nearest takes that way";
}

}  // namespace tactus
