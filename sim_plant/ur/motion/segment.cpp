#include "sim_plant/ur/motion/segment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::ur {
namespace {

constexpr int kSamples = 64, kMostSamples = 2048;
constexpr double kBetween = 0.95;  // fraction of a limit, as a margin between two samples
constexpr double kAlike = 0.97;    // agreement with twice as many samples that is enough
constexpr double kFlat = 1e-12;    // a smaller slope or bend limits nothing

bool sampled(const Curve& curve, int samples, double share, const MotionLimits& limits, Joints& q,
             Rates& rates) {
  constexpr double kAny = std::numeric_limits<double>::max();
  rates = {kAny, kAny};
  const double step = curve.length() / samples;
  Joints before = Joints::Zero();
  for (int i = 0; i <= samples; ++i) {
    Joints slope;
    if (!curve.at(i * step, q, q, slope)) return false;
    const double steep = slope.cwiseAbs().maxCoeff();
    const double slow = slope.cwiseAbs().cwiseQuotient(limits.speed).maxCoeff();
    if (slow > kFlat) rates.v = std::min(rates.v, 1.0 / slow);
    if (steep > kFlat) rates.a = std::min(rates.a, (1.0 - share) * limits.acceleration / steep);
    const double bend = i > 0 ? (slope - before).cwiseAbs().maxCoeff() / step : 0.0;
    if (bend > kFlat) rates.v = std::min(rates.v, std::sqrt(share * limits.acceleration / bend));
    before = slope;
  }
  return true;
}

constexpr double kTwoPi = 6.28318530717958648;
constexpr double kLongest_s = 1e6;

}  // namespace

/// Doubles the samples until the result is stable: next to a singularity many are needed to find
/// the speed of a joint.
bool fastest(const Curve& curve, double share, const MotionLimits& limits, Joints& q,
             Rates& rates) {
  const Joints from = q;
  if (!sampled(curve, kSamples, share, limits, q, rates)) return false;
  if (share == 0.0) return true;  // straight in the joints
  for (int samples = 2 * kSamples; samples <= kMostSamples; samples *= 2) {
    const Rates before = rates;
    q = from;
    if (!sampled(curve, samples, share, limits, q, rates)) return false;
    if (rates.v >= kAlike * before.v && rates.a >= kAlike * before.a) break;
  }
  rates = {kBetween * rates.v, kBetween * rates.a};
  return true;
}

bool Segment::start(const Move& move, const Joints& from, const Frame& tool,
                    const MotionLimits& limits) {
  move_ = move;
  tool_ = tool;
  from_ = from;
  tip_from_ = forward(from) * tool;
  arc_ = false;
  to_ = in_joints() ? move.q : from;
  if (!to_.allFinite() || !move.target.p.allFinite() || !move.target.r.allFinite() ||
      !move.via.p.allFinite())
    return false;
  if (in_joints())
    length_ = (to_ - from_).cwiseAbs().maxCoeff();
  else
    measure_tool();
  if (length_ < kNoLength) length_ = 0.0;
  // The path in tool space determines the posture at its end.
  Joints q = from;
  if (length_ > 0.0 && !fastest(*this, in_joints() ? 0.0 : 0.5, limits, q, most_)) return false;
  if (!in_joints()) to_ = q;
  if (to_.cwiseAbs().maxCoeff() > limits.position) return false;
  choose_pace();
  return true;
}

void Segment::measure_tool() {
  const Frame& target = move_.target;
  way_ = target.p - tip_from_.p;
  turn_ = rotation_vector(tip_from_.r.transpose() * target.r);
  arc_ = move_.kind == Move::Kind::kC && fit_circle();
  const double gone = arc_ ? angle_ * (tip_from_.p - center_).norm() : way_.norm();
  const bool turns = !(arc_ && move_.fixed);
  length_ = turns ? std::max(gone, turn_.norm()) : gone;
}

/// Fits the circle through three points; if they are on a line, the tool moves straight.
bool Segment::fit_circle() {
  const Vector3 a = move_.via.p - tip_from_.p, b = way_, n = a.cross(b);
  if (!(n.norm() > 1e-6 * a.norm() * b.norm()) || a.norm() < kNoLength) return false;
  center_ =
      tip_from_.p + (a.squaredNorm() * b - b.squaredNorm() * a).cross(n) / (2.0 * n.squaredNorm());
  axis_ = n.normalized();
  const Vector3 u = tip_from_.p - center_, w = move_.target.p - center_;
  angle_ = std::atan2(axis_.dot(u.cross(w)), u.dot(w));
  if (angle_ < 0.0) angle_ += kTwoPi;
  return true;
}

/// Chooses the pace; a trapezoid that accelerates and brakes for a quarter of its time each reaches
/// 4/3 of its mean speed.
void Segment::choose_pace() {
  const bool joints = in_joints();
  pace_ = {given_or(move_.v, joints ? 1.05 : 0.25), given_or(move_.a, joints ? 1.4 : 1.2)};
  if (move_.t > 0.0) {
    const double v = std::min(length_ / (0.75 * std::min(move_.t, kLongest_s)), most_.v);
    // If that is too fast, the move takes longer.
    pace_ = {v, length_ > 0.0 ? v * v * 3.0 / length_ : 1.0};
  }
  if (length_ > 0.0) pace_ = {std::min(pace_.v, most_.v), std::min(pace_.a, most_.a)};
}

bool Segment::at(double x, const Joints& near, Joints& q, Joints& slope) const {
  if (in_joints()) {
    q = x < length_ ? Joints(from_ + share(x) * (to_ - from_)) : to_;
    slope = length_ > 0.0 ? Joints((to_ - from_) / length_) : Joints::Zero();
    return true;
  }
  Joints found;
  if (!inverse(tip(x), tool_, near, found)) return false;
  q = found;
  return joint_speeds(q, tool_, twist(x), slope);
}

Frame Segment::tip(double x) const {
  const double s = share(x);
  if (in_joints()) return forward(from_ + s * (to_ - from_)) * tool_;
  const Matrix3 around = arc_ ? rotation_matrix(s * angle_ * axis_) : Matrix3::Identity();
  Frame frame;
  frame.p = tip_from_.p + s * way_;
  if (arc_) frame.p = center_ + around * (tip_from_.p - center_);
  frame.r = arc_ && move_.fixed ? around * tip_from_.r : tip_from_.r * rotation_matrix(s * turn_);
  return frame;
}

Vector6 Segment::twist(double x) const {
  Vector6 twist = Vector6::Zero();
  if (!(length_ > 0.0)) return twist;
  if (in_joints()) {
    const Joints way = to_ - from_;
    return jacobian(from_ + share(x) * way, tool_) * way / length_;
  }
  twist.head<3>() = arc_ ? Vector3(angle_ * axis_.cross(tip(x).p - center_)) : way_;
  twist.tail<3>() = arc_ && move_.fixed ? Vector3(angle_ * axis_) : tip_from_.r * turn_;
  return twist / length_;
}

bool Segment::way_within(double r, bool from_end, double& x) const {
  const auto beyond = [&](double way) {
    const Vector3 point = tip(from_end ? length_ : 0.0).p;
    return (tip(from_end ? length_ - way : way).p - point).norm() >= r;
  };
  constexpr int kSteps = 64, kHalvings = 50;
  for (int i = 1; i <= kSteps; ++i) {
    double near = length_ * (i - 1) / kSteps, far = length_ * i / kSteps;
    if (!beyond(far)) continue;
    for (int k = 0; k < kHalvings; ++k)
      (beyond(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
    x = far;
    return true;
  }
  return false;
}

}  // namespace tactus::ur
