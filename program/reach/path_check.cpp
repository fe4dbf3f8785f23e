#include "program/reach/path_check.hpp"

#include <algorithm>
#include <random>

#include "kernel/control/cartesian_pose.hpp"

namespace tactus {
namespace {

constexpr int kApproach = 200;     // samples on the way to the path
constexpr int kSteps = 60;         // of one sample
constexpr int kSearchSteps = 200;  // of one posture that is tried
constexpr int kPostures = 40;      // that are tried
constexpr int kMostSearches = 8;   // for the whole path: they take the longest
const CartesianPose::Params kLaw;  // its defaults: the file may have others

Pose between(const Pose& from, const Pose& to, double share) {
  return {from.p + share * (to.p - from.p), from.r.slerp(share, to.r)};
}

}  // namespace

void PathCheck::approach(const Pose& first) {
  const Pose from = arm_.tip(q_);
  for (int k = 1; k <= kApproach; ++k)
    arm_.solve(between(from, first, static_cast<double>(k) / kApproach), q_, kSteps);
  posture_ = before_ = q_;
}

void PathCheck::go_on(double time_s, const Pose& pose) {
  const double passed_s = begun_ ? time_s - time_s_ : 0.0;
  before_ = q_;
  if (begun_) arm_.move_posture(posture_, std::min(1.0, kLaw.posture_gain * passed_s), q_);
  const Reach reach = arm_.solve(pose, q_, kSteps);
  Finding found;
  found.from_s = found.to_s = found.worst_s = time_s;
  found.place = pose.p;
  judge_reach(found, pose, reach);
  if (reach.reached()) {
    judge_limits(found);
    if (reached_) judge_speeds(found, passed_s);
  } else {
    end(Finding::kNearLimit);
    end(Finding::kFastJoint);
  }
  time_s_ = time_s;
  begun_ = true;
  reached_ = reach.reached();
}

/// Returns whether some posture of the arm, of those tried, brings the tip to the pose; after the
/// most searches, what the last of them has found.
bool PathCheck::elsewhere(const Pose& pose) {
  if (searches_ == kMostSearches) return elsewhere_;
  ++searches_;
  elsewhere_ = found_elsewhere(pose);
  return elsewhere_;
}

bool PathCheck::found_elsewhere(const Pose& pose) const {
  std::minstd_rand random(1);
  const JointLimits& limits = arm_.limits();
  for (int k = 0; k < kPostures; ++k) {
    JointVector q;
    for (int i = 0; i < kDof; ++i) {
      std::uniform_real_distribution<double> any(limits.q_min[i], limits.q_max[i]);
      q[i] = any(random);
    }
    if (arm_.solve(pose, q, kSearchSteps).reached()) return true;
  }
  return false;
}

void PathCheck::judge_reach(Finding found, const Pose& pose, const Reach& reach) {
  if (!reach.reached()) {  // there the arm is singular anyway
    const bool goes_on = open_[Finding::kOutOfReach] != nullptr;
    const bool other = !goes_on && (open_[Finding::kOtherPosture] != nullptr || elsewhere(pose));
    found.kind = other ? Finding::kOtherPosture : Finding::kOutOfReach;
    out_of_reach_ = out_of_reach_ || !other;
    found.value = reach.distance_m;
    found.angle_rad = reach.angle_rad;
    found.joint = reach.blocked;
    found.severity = reach.error();
    return note(found);
  }
  end(Finding::kOutOfReach);
  end(Finding::kOtherPosture);
  if (reach.sigma >= kLaw.damping_onset) return end(Finding::kSingular);
  found.kind = Finding::kSingular;
  found.joint = -1;
  found.value = reach.sigma;
  found.limit = kLaw.damping_onset;
  found.severity = kLaw.damping_onset - reach.sigma;
  note(found);
}

void PathCheck::judge_limits(const Finding& found) {
  const JointLimits& limits = arm_.limits();
  Finding worst = found;
  for (int i = 0; i < kDof; ++i) {
    const bool low = q_[i] - limits.q_min[i] < limits.q_max[i] - q_[i];
    const double limit = low ? limits.q_min[i] : limits.q_max[i];
    const double within = kNear_rad - std::abs(q_[i] - limit);
    if (within > worst.severity) {
      worst.severity = within;
      worst.joint = i;
      worst.value = q_[i];
      worst.limit = limit;
    }
  }
  worst.kind = Finding::kNearLimit;
  worst.joint >= 0 ? note(worst) : end(Finding::kNearLimit);
}

void PathCheck::judge_speeds(const Finding& found, double passed_s) {
  Finding worst = found;
  for (int i = 0; i < kDof; ++i) {
    const double speed = std::abs(q_[i] - before_[i]) / passed_s, limit = arm_.limits().dq_max[i];
    if (speed / limit - 1.0 > worst.severity) {
      worst.severity = speed / limit - 1.0;
      worst.joint = i;
      worst.value = speed;
      worst.limit = limit;
    }
  }
  worst.kind = Finding::kFastJoint;
  worst.joint >= 0 ? note(worst) : end(Finding::kFastJoint);
}

/// Continues the open finding of its kind, or begins one.
void PathCheck::note(const Finding& found) {
  Finding*& open = open_[found.kind];
  if (open == nullptr) {
    const bool full = count_ == kMostFindings;
    left_out_ += full ? 1 : 0;
    open = full ? &beyond_[found.kind] : &findings_[count_++];
    *open = found;
  }
  const double from_s = open->from_s;
  if (found.severity > open->severity) *open = found;
  open->from_s = from_s;
  open->to_s = found.to_s;
}

}  // namespace tactus
