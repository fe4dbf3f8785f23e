#include "kernel/guard/collision.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

Vector3 vector_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

/// Returns a bound of the distance between the origins of joint frame `joint`, counted from 1, and
/// of `link`, at any position of the joints between them, m.
double longest_way(int joint, int link) {
  double sum = 0.0;
  for (int i = joint; i < link; ++i) {
    const JointFrame& next = Robot::kJoints[static_cast<std::size_t>(i)];
    sum += Vector3(next.x, next.y, next.z).norm();
  }
  return sum;
}

/// Bounds the distance from axis k by that from the origin of its frame.
JointVector reach_of(const Capsule& shape, int link) {
  const double own = std::max(shape.a.norm(), shape.b.norm()) + shape.radius;
  JointVector reach = JointVector::Zero();
  for (int joint = 1; joint <= link; ++joint) reach[joint - 1] = longest_way(joint, link) + own;
  return reach;
}

/// Returns the time in which a joint turns from full acceleration to braking, with its jerk. While
/// the acceleration changes, and while it fades at the end, the joint is nowhere further than after
/// accelerating for that time.
double jerk_ramp_s(const JointLimits& limits, const JointVector& braking) {
  return (limits.ddq_max + braking).cwiseQuotient(limits.dddq_max).maxCoeff();
}

}  // namespace

void Collision::start(const CollisionSection& section, const JointLimits& limits,
                      const Vector3& tip, double period_s) {
  scene_ = &section.scene;
  margin_ = section.margin;
  support_calls_ = section.support_calls;
  const JointVector& braking = section.limits.ddq_max;
  braking_ = {(section.divisor + 1) * period_s + section.delay_s + jerk_ramp_s(limits, braking),
              limits.ddq_max, braking};
  telemetry_ = {};
  add_capsules(tip, section.tool_radius);
  add_pairs();
}

void Collision::add_capsules(const Vector3& tip, double tool_radius) {
  for (std::size_t i = 0; i < RobotCapsules::kCapsules.size(); ++i) {
    const LinkCapsule& entry = RobotCapsules::kCapsules[i];
    const Capsule shape = {vector_of(entry.a), vector_of(entry.b), entry.radius};
    bodies_[i] = {entry.link, entry.link, shape, reach_of(shape, entry.link)};
  }
  const Capsule tool = {dense(from_flange<Robot>(Vector3::Zero())), dense(from_flange<Robot>(tip)),
                        tool_radius};
  bodies_.back() = {kToolBody, kDof, tool, reach_of(tool, kDof)};
}

/// True if two bodies of the arm can meet: not on one link or on neighbours, and not always
/// touching.
bool Collision::meets(int first, int second) const {
  if (second - first < 2) return false;
  for (const LinkPair& pair : RobotCapsules::kTouching)
    if (pair.first == first && pair.second == second) return false;
  return true;
}

void Collision::add_pairs() {
  pair_count_ = 0;
  const auto add = [this](int first_body, const Pair& pair) {
    const int second_body = bodies_[static_cast<std::size_t>(pair.second)].body;
    if (!scene_
             ->allowed[static_cast<std::size_t>(first_body)][static_cast<std::size_t>(second_body)])
      pairs_[static_cast<std::size_t>(pair_count_++)] = pair;
  };
  for (int second = 0; second < kCapsules; ++second) {
    const Body& moving = bodies_[static_cast<std::size_t>(second)];
    for (int first = 0; first < second; ++first) {
      const int body = bodies_[static_cast<std::size_t>(first)].body;
      if (meets(body, moving.body)) add(body, {second, first, -1});
    }
    for (int box = 0; box < scene_->box_count() && moving.link > 0; ++box)
      add(kFirstBoxBody + box, {second, -1, box});
  }
}

Status Collision::check(const RobotState& measured) {
  if (scene_ == nullptr) return Status::kNotStarted;
  ++telemetry_.checks;
  telemetry_.support_calls = 0;
  if (!measured.q.allFinite() || !measured.dq.allFinite()) return Status::kStateNotFinite;
  LoopBound<kMaxObstacles> obstacles;
  for (int i = 0; i < scene_->box_count(); ++i) {
    obstacles.tick();
    const auto box = static_cast<std::size_t>(i);
    const Cuboid& cuboid = *scene_->boxes[box];
    boxes_[box] = {cuboid.pose.r.toRotationMatrix(), cuboid.pose.p, 0.5 * cuboid.size};
  }
  Status status = check_at(measured.q, JointVector::Zero(), false);
  if (status == Status::kOk) {
    LoopBound<1 + kSections> sections;
    for (const JointBox& box : stopping_boxes(braking_, measured.q, measured.dq)) {
      sections.tick();
      status = check_at(box.middle, box.half, true);
      if (status != Status::kOk) break;
    }
  }
  telemetry_.most_support_calls = std::max(telemetry_.most_support_calls, telemetry_.support_calls);
  return status;
}

Status Collision::check_at(const JointVector& q, const JointVector& half, bool predicted) {
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const LinkFrame& frame = frames[static_cast<std::size_t>(body.link)];
    placed_[i] = {frame.at(body.shape.a), frame.at(body.shape.b), body.shape.radius};
  }
  LoopBound<kMaxPairs> pairs;
  for (int i = 0; i < pair_count_; ++i) {
    pairs.tick();
    const Pair& pair = pairs_[static_cast<std::size_t>(i)];
    const Body& moving = bodies_[static_cast<std::size_t>(pair.second)];
    const int still = pair.first < 0 ? 0 : bodies_[static_cast<std::size_t>(pair.first)].link;
    double sweep = 0.0;
    LoopBound<kDof> joints;
    for (int joint = still; joint < moving.link; ++joint) {
      joints.tick();
      sweep += moving.reach[joint] * half[joint];
    }
    if (!apart(pair, margin_ + sweep)) return contact(pair, sweep, predicted);
  }
  return Status::kOk;
}

bool Collision::apart(const Pair& pair, double inflation) {
  const Capsule& capsule = placed_[static_cast<std::size_t>(pair.second)];
  const bool to_box = pair.first < 0;
  const Capsule& other = placed_[static_cast<std::size_t>(to_box ? pair.second : pair.first)];
  const BoxShape& box = boxes_[static_cast<std::size_t>(to_box ? pair.box : 0)];
  if (to_box ? far_apart(capsule, box, inflation) : far_apart(capsule, other, inflation))
    return true;
  telemetry_.exhausted = telemetry_.support_calls + kSupportCallsOfPair > support_calls_;
  if (telemetry_.exhausted) return false;
  const Separation result =
      to_box ? separate(capsule, box, inflation) : separate(capsule, other, inflation);
  telemetry_.support_calls += result.support_calls;
  return result.proved;
}

Status Collision::contact(const Pair& pair, double sweep, bool predicted) {
  const int second = bodies_[static_cast<std::size_t>(pair.second)].body;
  const int first = pair.first < 0 ? kFirstBoxBody + pair.box
                                   : bodies_[static_cast<std::size_t>(pair.first)].body;
  telemetry_.first = scene_->names[static_cast<std::size_t>(first)];
  telemetry_.second = scene_->names[static_cast<std::size_t>(second)];
  telemetry_.predicted = predicted;
  telemetry_.sweep_m = sweep;
  return Status::kCollision;
}

}  // namespace tactus
