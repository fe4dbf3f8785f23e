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
  positions_ = kCheckedPositions / section.cycles;
  const JointVector& braking = section.limits.ddq_max;
  braking_ = {2 * section.cycles * period_s + section.delay_s + jerk_ramp_s(limits, braking),
              limits.ddq_max, braking};
  telemetry_ = {};
  next_ = 0;
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
  return !is_allowed(first, second);
}

bool Collision::is_allowed(int first, int second) const {
  return scene_->allowed[static_cast<std::size_t>(first)][static_cast<std::size_t>(second)];
}

void Collision::add_pairs() {
  pair_count_ = box_pair_count_ = 0;
  for (int second = 0; second < kCapsules; ++second) {
    const Body& moving = body(second);
    for (int first = 0; first < second; ++first)
      if (meets(body(first).body, moving.body))
        pairs_[static_cast<std::size_t>(pair_count_++)] = {second, first, body(first).link};
    for (int box = 0; box < scene_->box_count() && moving.link > 0; ++box)
      if (!is_allowed(kFirstBoxBody + box, moving.body))
        box_pairs_[static_cast<std::size_t>(box_pair_count_++)] = {second, box, 0};
  }
}

Status Collision::check(const RobotState& measured) {
  next_ = 0;
  Status status = step(measured);
  LoopBound<kCheckedPositions> positions;
  while (status == Status::kOk && next_ > 0) {
    positions.tick();
    status = step(measured);
  }
  return status;
}

Status Collision::step(const RobotState& measured) {
  if (scene_ == nullptr) return Status::kNotStarted;
  if (!measured.q.allFinite() || !measured.dq.allFinite()) return Status::kStateNotFinite;
  if (next_ == 0) begin(measured);
  LoopBound<kCheckedPositions> positions;
  for (int i = 0; i < positions_; ++i) {
    positions.tick();
    const Status status = check_next();
    if (status != Status::kOk) return end(status);
    ++next_;
  }
  return next_ < kCheckedPositions ? Status::kOk : end(Status::kOk);
}

void Collision::begin(const RobotState& measured) {
  q_ = measured.q;
  dq_ = measured.dq;
  LoopBound<kMaxObstacles> obstacles;
  for (int i = 0; i < scene_->box_count(); ++i) {
    obstacles.tick();
    const auto box = static_cast<std::size_t>(i);
    const Cuboid& cuboid = *scene_->boxes[box];
    boxes_[box] = {cuboid.pose.r.toRotationMatrix(), cuboid.pose.p, 0.5 * cuboid.size};
  }
}

Status Collision::end(Status status) {
  next_ = 0;
  ++telemetry_.checks;
  return status;
}

/// Checks all pairs in position next_: now, or in a section of the way to rest.
Status Collision::check_next() {
  place(next_ == 0 ? JointBox{q_, JointVector::Zero()}
                   : stopping_box(braking_, q_, dq_, next_ - 1));
  LoopBound<kMaxPairs> pairs;
  for (int i = 0; i < pair_count_; ++i) {
    pairs.tick();
    const Pair& pair = pairs_[static_cast<std::size_t>(i)];
    const Swept& second = swept(pair.second);
    if (!apart(second.capsule, swept(pair.first).capsule, margin_ + second.ways[pair.axis]))
      return contact(pair, body(pair.first).body);
  }
  LoopBound<kMaxBoxPairs> box_pairs;
  for (int i = 0; i < box_pair_count_; ++i) {
    box_pairs.tick();
    const Pair& pair = box_pairs_[static_cast<std::size_t>(i)];
    const Swept& second = swept(pair.second);
    const BoxShape& box = boxes_[static_cast<std::size_t>(pair.first)];
    if (!apart(second.capsule, box, margin_ + second.ways[pair.axis]))
      return contact(pair, kFirstBoxBody + pair.first);
  }
  return Status::kOk;
}

/// Places the arm at the middle of a section, and finds how far each capsule can move in it against
/// the links before each joint.
void Collision::place(const JointBox& box) {
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(box.middle));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const LinkFrame& frame = frames[static_cast<std::size_t>(body.link)];
    swept_[i].capsule = {frame.at(body.shape.a), frame.at(body.shape.b), body.shape.radius};
    double way = 0.0;
    for (int joint = kDof - 1; joint >= 0; --joint) {
      way += body.reach[joint] * box.half[joint];
      swept_[i].ways[joint] = way;
    }
  }
}

Status Collision::contact(const Pair& pair, int first_body) {
  telemetry_.first = scene_->names[static_cast<std::size_t>(first_body)];
  telemetry_.second = scene_->names[static_cast<std::size_t>(body(pair.second).body)];
  telemetry_.predicted = next_ > 0;
  telemetry_.sweep_m = swept(pair.second).ways[pair.axis];
  return Status::kCollision;
}

}  // namespace tactus
