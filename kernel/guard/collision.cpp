#include "kernel/guard/collision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/loop_bound.hpp"
#include "kernel/guard/guard.hpp"

namespace tactus {
namespace {

Vector3 vector_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

/// How far beyond a limit the guard lets a joint be at most, rad or m.
constexpr double kMostBeyond = Guard::kLedBack + Guard::kPositionTolerance;

/// Returns a bound of the distance between the origins of joint frame `joint`, counted from 1, and
/// of `link`, at any position of the joints between them, m.
double longest_way(int joint, int link) {
  double sum = 0.0;
  for (int i = joint; i < link; ++i) {
    const JointFrame& next = Robot::kJoints[static_cast<std::size_t>(i)];
    const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
    sum += Vector3(next.x, next.y, next.z).norm();
    if (is_prismatic<Robot>(i)) sum += std::max(-limit.q_min, limit.q_max) + kMostBeyond;
  }
  return sum;
}

/// Returns how far a point of the shape moves at most with each joint, m/rad: its distance from the
/// axis, bounded by that from the origin of the frame. With a prismatic joint it moves alike.
JointVector reach_of(const Capsule& shape, int link) {
  const double own = std::max(shape.a.norm(), shape.b.norm()) + shape.radius;
  JointVector reach = JointVector::Zero();
  for (int joint = 1; joint <= link; ++joint)
    reach[joint - 1] = is_prismatic<Robot>(joint - 1) ? 1.0 : longest_way(joint, link) + own;
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
                      const Vector3& tip, double period_s, const JointVector* reference) {
  section_ = &section;
  positions_ = kCheckedPositions / section.cycles;
  const JointVector& braking = section.braking;
  braking_ = {2 * section.cycles * period_s + section.delay_s + jerk_ramp_s(limits, braking),
              limits.ddq_max, braking};
  if (reference == nullptr) braking_.reaction_s += section.lateness.maxCoeff();
  period_s_ = period_s;
  followed_ = reference;
  telemetry_ = {};
  add_capsules(section, tip);
  add_pairs();
  begin_anew();
}

void Collision::add_capsules(const CollisionSection& section, const Vector3& tip) {
  for (std::size_t i = 0; i < RobotCapsules::kCapsules.size(); ++i) {
    const LinkCapsule& entry = RobotCapsules::kCapsules[i];
    const Capsule shape = {vector_of(entry.a), vector_of(entry.b), entry.radius};
    bodies_[i] = {entry.link, shape, reach_of(shape, entry.link)};
  }
  double radius = section.tool_radius;
  if constexpr (kConvexBodies) {
    if (section.tool_points.count() > 0) radius += radius_around(section.tool_points, tip);
    add_hulls(section);
  }
  const Capsule tool = {dense(from_flange<Robot>(Vector3::Zero())), dense(from_flange<Robot>(tip)),
                        radius};
  bodies_.back() = {kDof, tool, reach_of(tool, kDof)};
}

bool Collision::is_allowed(int first, int second) const {
  return section_->scene.allowed[static_cast<std::size_t>(first)][static_cast<std::size_t>(second)];
}

void Collision::add_pairs() {
  pair_count_ = 0;
  for (int second = 0; second < kArmCapsules; ++second)
    for (int first = 0; first < second; ++first)
      if (can_meet(first, second) && !is_allowed(body_of(first), body_of(second)))
        add_pair(second, first, bodies_[static_cast<std::size_t>(first)].link, false);
  for (int second = 0; second < kArmCapsules; ++second)
    for (int box = 0; box < section_->scene.box_count() && body_of(second) > 0; ++box)
      if (!is_allowed(kFirstBoxBody + box, body_of(second))) add_pair(second, box, 0, true);
}

void Collision::add_pair(int second, int first, int axis, bool of_box) {
  pairs_[static_cast<std::size_t>(pair_count_++)] = {kNoCredit, static_cast<std::uint8_t>(second),
                                                     static_cast<std::uint8_t>(first),
                                                     static_cast<std::uint8_t>(axis), of_box};
}

/// Takes the boxes as they are now, and lets a check begin without credit.
void Collision::begin_anew() {
  for (int i = 0; i < section_->scene.box_count(); ++i) {
    const auto box = static_cast<std::size_t>(i);
    const Cuboid& cuboid = *section_->scene.boxes[box];
    boxes_[box] = {cuboid.pose.r.toRotationMatrix(), cuboid.pose.p, 0.5 * cuboid.size};
  }
  if (followed_ != nullptr) last_followed_ = *followed_;
  next_ = 0;
  forget();
}

/// No pair has credit any more.
void Collision::forget() {
  travelled_.setZero();
  for (Pair& pair : pairs_) pair.credit = kNoCredit;
}

Status Collision::check(const RobotState& measured, const Vector3& gravity) {
  if (section_ == nullptr) return Status::kNotStarted;
  if (!measured.q.allFinite()) return Status::kStateNotFinite;
  begin_anew();
  constexpr int kEnough = 1 << 20;
  directions_ = kEnough;
  const JointVector sag = sag_at(measured.q, gravity);
  Status status = advance(measured, &sag);
  LoopBound<kCheckedPositions> positions;
  while (status == Status::kOk && next_ > 0) {
    positions.tick();
    status = advance(measured, &sag);
  }
  return status;
}

Status Collision::step(const RobotState& measured) {
  if (section_ == nullptr) return Status::kNotStarted;
  directions_ = kMostDirections;
  return advance(measured);
}

Status Collision::advance(const RobotState& measured, const JointVector* sag) {
  if (!measured.q.allFinite() || !measured.dq.allFinite()) return Status::kStateNotFinite;
  travel(measured.q);
  follow(measured, sag);
  LoopBound<kCheckedPositions> positions;
  for (int i = 0; i < positions_; ++i) {
    positions.tick();
    const Status status = next_ == 0 ? look_now() : look_ahead();
    if (status != Status::kOk) return end(status);
    ++next_;
    if (due_count_ == 0 || next_ == kCheckedPositions) return end(Status::kOk);
  }
  return Status::kOk;
}

/// Adds up the angles. A large sum restarts from zero, as its rounding would reduce the credits.
void Collision::travel(const JointVector& q) {
  constexpr double kLarge = 100.0;  // rad
  bool small = true;
  for (int i = 0; i < kDof; ++i) {
    travelled_[i] += std::abs(q[i] - last_q_[i]);
    last_q_[i] = q[i];
    small = small && travelled_[i] < kLarge;
  }
  if (!small) forget();
}

/// Takes the reference of a check that begins: its velocity is that of the last period.
void Collision::follow(const RobotState& measured, const JointVector* sag) {
  const JointVector& followed = followed_ != nullptr ? *followed_ : measured.q;
  for (int i = 0; i < kDof; ++i) {
    const double position = followed[i];
    const double velocity =
        followed_ != nullptr ? (position - last_followed_[i]) / period_s_ : measured.dq[i];
    last_followed_[i] = position;
    if (next_ > 0) continue;
    q_[i] = measured.q[i];
    reference_.q[i] = 0.5 * (q_[i] + position);
    reference_.dq[i] = velocity;
    const double lag = std::abs(q_[i] - position);
    reference_.error[i] =
        0.5 * lag + section_->lateness[i] * std::abs(measured.dq[i]) + section_->overshoot[i] * lag;
  }
  if (next_ > 0 || sag == nullptr) return;
  reference_.q += 0.5 * *sag;
  reference_.error += 0.5 * sag->cwiseAbs();
}

/// Returns where the joints yield to after the drives are enabled, as the payload that the law does
/// not know pulls at the tip. Its torque changes as they yield: it may tip the arm over, and NaN is
/// then a contact.
JointVector Collision::sag_at(const JointVector& q, const Vector3& gravity) const {
  constexpr int kSteps = 32;
  constexpr double kSettled = 1e-4;  // rad
  const Vector3 weight = section_->unknown_payload * gravity;
  JointVector sag = JointVector::Zero();
  LoopBound<kSteps> steps;
  for (int n = 0; n < kSteps; ++n) {
    steps.tick();
    const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q + sag));
    const Vector3 tip = frames.back().at(bodies_.back().shape.b);
    bool settled = true;
    for (int i = 0; i < kDof; ++i) {
      const LinkFrame& joint = frames[static_cast<std::size_t>(i) + 1];
      const Vector3 axis = joint.r.col(2);
      const Vector3 way = is_prismatic<Robot>(i) ? axis : axis.cross(tip - joint.p);
      const double next = section_->compliance[i] * weight.dot(way);
      settled = settled && std::abs(next - sag[i]) < kSettled;
      sag[i] = next;
    }
    if (settled) return sag;
  }
  return JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Looks at the pairs whose credit does not last until rest. They are due ahead if it still does
/// not.
Status Collision::look_now() {
  from_ = travelled_;
  const JointVector range = stopping_range(braking_, reference_.dq);
  reference_.error += section_->overshoot.cwiseProduct(range);
  const Ways until_rest = ways(from_ + range + 2.0 * reference_.error);
  bool placed = false;
  due_count_ = 0;
  LoopBound<kMaxPairs> pairs;
  for (int i = 0; i < pair_count_; ++i) {
    pairs.tick();
    Pair& pair = pairs_[static_cast<std::size_t>(i)];
    const double lasting = section_->margin + until_rest[pair.second][pair.axis];
    if (pair.credit > lasting) continue;
    if (!placed) place(q_, from_);
    placed = true;
    double distance = proved_distance(pair, lasting);
    if (kConvexBodies && !(distance > section_->margin))
      distance = proved_distance(pair, section_->margin);
    if (!(distance > section_->margin)) return contact(pair, 0.0);
    pair.credit = distance + placed_[pair.second].ways[pair.axis];
    if (!(pair.credit > lasting))
      due_[static_cast<std::size_t>(due_count_++)] = static_cast<std::uint8_t>(i);
  }
  return Status::kOk;
}

/// Looks at the pairs that are due, in section next_ - 1 of the way to rest. For most of them the
/// credit lasts until there.
Status Collision::look_ahead() {
  JointBox box = stopping_box(braking_, reference_.q, reference_.dq, next_ - 1);
  box.half += reference_.error;
  const Ways until_there = ways(from_ + (box.middle - q_).cwiseAbs() + box.half);
  bool placed = false;
  LoopBound<kMaxPairs> pairs;
  for (int i = 0; i < due_count_; ++i) {
    pairs.tick();
    const Pair& pair = pairs_[due_[static_cast<std::size_t>(i)]];
    if (pair.credit > section_->margin + until_there[pair.second][pair.axis]) continue;
    if (!placed) place(box.middle, box.half);
    placed = true;
    const double sweep_m = placed_[pair.second].ways[pair.axis];
    const double needed = section_->margin + sweep_m;
    if (!(proved_distance(pair, needed) > needed)) return contact(pair, sweep_m);
  }
  return Status::kOk;
}

Status Collision::end(Status status) {
  next_ = 0;
  ++telemetry_.checks;
  return status;
}

/// Returns how far a point of each capsule can move against the links before each joint, if the
/// joints turn by such angles: the sum from joint k up.
Collision::Ways Collision::ways(const JointVector& angles) const {
  Ways result;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    double way = 0.0;
    for (int joint = kDof - 1; joint >= 0; --joint) {
      way += bodies_[i].reach[joint] * angles[joint];
      result[i][joint] = way;
    }
  }
  return result;
}

/// Places the arm, and finds how far its points move if the joints turn by such angles.
void Collision::place(const JointVector& q, const JointVector& angles) {
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
  const Ways moved = ways(angles);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const LinkFrame& frame = frames[static_cast<std::size_t>(body.link)];
    placed_[i] = {{frame.at(body.shape.a), frame.at(body.shape.b), body.shape.radius}, moved[i]};
  }
  if constexpr (kConvexBodies) place_hulls(frames);
}

/// Returns a distance of the pair that is proved; where that of capsules and boxes is not more than
/// what is wanted, that of the bodies in them.
double Collision::proved_distance(const Pair& pair, double wanted) {
  const Capsule& moving = placed_[pair.second].capsule;
  const double distance = pair.of_box ? separation(moving, boxes_[pair.first])
                                      : separation(moving, placed_[pair.first].capsule);
  if constexpr (kConvexBodies)
    if (!(distance > wanted) && is_convex(pair))
      return std::max(distance, convex_distance(pair, wanted));
  return distance;
}

Status Collision::contact(const Pair& pair, double sweep_m) {
  const int first = pair.of_box ? kFirstBoxBody + pair.first : body_of(pair.first);
  telemetry_.first = section_->scene.names[static_cast<std::size_t>(first)];
  telemetry_.second = section_->scene.names[static_cast<std::size_t>(body_of(pair.second))];
  telemetry_.predicted = next_ > 0;
  telemetry_.sweep_m = sweep_m;
  telemetry_.unproved = directions_ <= 0;
  return Status::kCollision;
}

}  // namespace tactus
