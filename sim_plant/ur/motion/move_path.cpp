#include "sim_plant/ur/motion/move_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::ur {
namespace {

/// Below the first angle there is no circle; above the second it shrinks to a point.
constexpr double kStraight = 1e-4, kSharp = 2.6;  // rad

constexpr double kSettle_s = 0.064;  // a move returns after the arm has settled too
constexpr double kNever_s = std::numeric_limits<double>::infinity();

}  // namespace

Trapezoid Trapezoid::over(double d, double v0, double v1, double v, double a) {
  Trapezoid law;
  const double change = v1 * v1 - v0 * v0;
  if (d > 0.0) a = std::max(a, std::abs(change) / (2.0 * d));
  const double highest = std::sqrt(std::max(0.0, a * d + 0.5 * (v0 * v0 + v1 * v1)));
  // The top speed is at least v1; it is between v0 and v1 if the distance is just enough.
  const double top = std::clamp(v, std::min(v1, highest), highest);
  law.v0_ = v0;
  law.v1_ = v1;
  law.top_ = top;
  law.way_ = d;
  law.a0_ = top < v0 ? -a : a;
  law.a1_ = a;
  law.first_s_ = std::abs(top - v0) / a;
  law.last_s_ = std::max(0.0, top - v1) / a;
  const double ramps = 0.5 * (v0 + top) * law.first_s_ + 0.5 * (top + v1) * law.last_s_;
  law.flat_s_ = top > 0.0 ? std::max(0.0, d - ramps) / top : 0.0;
  return law;
}

double Trapezoid::position(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s()), left = duration_s() - t;
  if (left < last_s_ || left == 0.0) return way_ - (v1_ + 0.5 * a1_ * left) * left;
  if (t < first_s_) return (v0_ + 0.5 * a0_ * t) * t;
  return 0.5 * (v0_ + top_) * first_s_ + top_ * (t - first_s_);
}

double Trapezoid::speed(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s()), left = duration_s() - t;
  if (left < last_s_ || left == 0.0) return v1_ + a1_ * left;
  return t < first_s_ ? v0_ + a0_ * t : top_;
}

double Trapezoid::time_at(double x) const {
  const double first = 0.5 * (v0_ + top_) * first_s_;
  if (x <= 0.0) return 0.0;
  if (x < first) {
    const double v = std::sqrt(std::max(0.0, v0_ * v0_ + 2.0 * a0_ * x));
    return 2.0 * x / (v0_ + v);
  }
  return first_s_ + std::min(flat_s_, top_ > 0.0 ? (x - first) / top_ : 0.0);
}

void Blend::start(const Segment& a, double left, const Segment& b, double gone) {
  a_ = &a;
  b_ = &b;
  left_ = left;
  gone_ = gone;
  k_ = 0.0;
  circle_ = false;
  if (a.move().kind == Move::Kind::kP && b.move().kind == Move::Kind::kP) fit_circle();
}

void Blend::fit_circle() {
  const Vector3 corner = b_->tip(0.0).p;
  touch_ = a_->tip(a_->length() - left_).p;
  const double e = (corner - touch_).norm();
  along_ = (corner - touch_) / e;
  const Vector3 out = (b_->tip(gone_).p - corner).normalized();
  theta_ = std::atan2(along_.cross(out).norm(), along_.dot(out));
  if (!(theta_ > kStraight && theta_ < kSharp)) return;
  across_ = (out - along_.dot(out) * along_).normalized();
  rho_ = e / std::tan(0.5 * theta_);
  k_ = 2.0 - rho_ * theta_ / e;
  circle_ = true;
}

Blend::Share Blend::share(double u) const {
  const double w = 1.0 - u;
  return {a_->length() - left_ * w * w * (1.0 + k_ * u),
          left_ * w * (2.0 * (1.0 + k_ * u) - k_ * w), gone_ * u * u * (1.0 + k_ * w),
          gone_ * u * (2.0 * (1.0 + k_ * w) - k_ * u)};
}

bool Blend::at(double u, const Joints& near, Joints& q, Joints& slope) const {
  if (a_->in_joints() || b_->in_joints()) return at_joints(u, q, slope);
  Vector6 twist;
  const Frame frame = tip(u, twist);
  Joints found;
  if (!inverse(frame, a_->tool(), near, found)) return false;
  q = found;
  return joint_speeds(q, a_->tool(), twist, slope);
}

bool Blend::at_joints(double u, Joints& q, Joints& slope) const {
  const Share s = share(u);
  const Joints& corner = b_->begin();
  Joints q_a, q_b, slope_a, slope_b;
  if (!a_->at(s.x_a, corner, q_a, slope_a) || !b_->at(s.x_b, corner, q_b, slope_b)) return false;
  q = q_a + q_b - corner;
  slope = slope_a * s.dx_a + slope_b * s.dx_b;
  return true;
}

Frame Blend::tip(double u, Vector6& twist) const {
  const Share s = share(u);
  const Frame a = a_->tip(s.x_a), b = b_->tip(s.x_b), corner = b_->tip(0.0);
  const Vector6 twist_a = a_->twist(s.x_a) * s.dx_a, twist_b = b_->twist(s.x_b) * s.dx_b;
  const Matrix3 to_b = a.r * corner.r.transpose();
  Frame frame{a.p + b.p - corner.p, to_b * b.r};
  twist << twist_a.head<3>() + twist_b.head<3>(), twist_a.tail<3>() + to_b * twist_b.tail<3>();
  if (!circle_) return frame;
  const double c = std::cos(theta_ * u), sine = std::sin(theta_ * u);
  frame.p = touch_ + rho_ * (sine * along_ + (1.0 - c) * across_);
  twist.head<3>() = rho_ * theta_ * (c * along_ + sine * across_);
  return frame;
}

double Blend::rate(double a_first, double a_next) const {
  const double a = 2.0 * left_, b = 2.0 * gone_;
  if (a_->in_joints() != b_->in_joints()) return std::sqrt(std::min(a_first / a, a_next / b));
  Joints q = b_->begin(), slope_a, slope_b;
  if (a_->in_joints() && a_->at(a_->length(), q, q, slope_a) && b_->at(0.0, q, q, slope_b))
    return std::sqrt(a_first / (b * slope_b - a * slope_a).cwiseAbs().maxCoeff());
  const Vector6 change = b * b_->twist(0.0) - a * a_->twist(a_->length());
  return std::sqrt(a_first / std::max(change.head<3>().norm(), change.tail<3>().norm()));
}

bool MovePath::begin(const Move& move, const Joints& from, const Frame& tool) {
  if (!now().start(move, from, tool, limits_)) return false;
  done_ = now().length() == 0.0;
  go_to_point(0.0, 0.0);
  return true;
}

/// Plans from `x` with the speed `v` to the end of the segment.
void MovePath::go_to_point(double x, double v) {
  const Segment& segment = now();
  const double a = segment.pace().a;
  stage_ = Stage::kToPoint;
  x0_ = x;
  time_s_ = 0.0;
  law_ = Trapezoid::over(segment.length() - x, v, 0.0, segment.pace().v, a);
  asked_ = false;
  ask_s_ = kNever_s;
  double e = 0.0;
  if (!(segment.move().r > 0.0) || done_) return;
  overlap_ = overlap_ || !segment.way_within(segment.move().r, true, e);
  if (!(e > 0.0)) return;
  const double top = std::max(law_.top(), v);
  const double brakes = std::max(0.0, (top * top - a * e) / (2.0 * a));
  ask_s_ = law_.time_at(segment.length() - e - brakes - x);
}

MovePath::Next MovePath::follow(const Move& move, const Frame& tool) {
  if (!next().start(move, now().end(), tool, limits_)) return Next::kUnreachable;
  asked_ = false;
  ask_s_ = kNever_s;
  if (!fit_blend(tool)) return Next::kStops;
  return blend_into(now().length() - blend_.left());
}

/// Fits a blend between the segments. False: the radii leave none, or the tool has changed.
bool MovePath::fit_blend(const Frame& tool) {
  Segment& segment = next();
  if (!now().tool().p.isApprox(tool.p) || !now().tool().r.isApprox(tool.r)) return false;
  const double r = now().move().r, r_next = segment.move().r, whole = segment.length();
  double left = 0.0, gone = 0.0, end = 0.0;
  overlap_ = !now().way_within(r, true, left) || !segment.way_within(r, false, gone) ||
             gone > (1.0 - kNoLength) * whole;
  if (overlap_) return false;
  if (r_next > 0.0 && segment.way_within(r_next, true, end) && gone + end > whole + kNoLength) {
    segment.leave_out_blend();
    overlap_ = true;
  }
  // Equal shares of both segments minimise the acceleration.
  if (now().in_joints() && segment.in_joints()) left = gone = std::min(left, gone);
  blend_.start(now(), left, segment, gone);
  return true;
}

/// Goes on into the blend, whose entry is at `x_in`.
MovePath::Next MovePath::blend_into(double x_in) {
  const double x = x0_ + law_.position(time_s_), v = law_.speed(time_s_);
  if (x > x_in + kNoLength) return Next::kStops;
  const double way = std::max(0.0, x_in - x);
  if (!choose_rate(way, v)) return Next::kStops;
  stage_ = Stage::kToBlend;
  x0_ = x;
  time_s_ = 0.0;
  law_ = Trapezoid::over(way, v, rate_ * blend_.entry(), now().pace().v, now().pace().a);
  return Next::kBlended;
}

/// Chooses du/dt, with the distance `way` to the entry and the present speed `v`. False: no rate is
/// possible for both these and the joints.
bool MovePath::choose_rate(double way, double v) {
  Joints q = now().end(), slope;
  Rates joints;
  if (!now().at(now().length() - blend_.left(), q, q, slope) ||
      !fastest(blend_, 1.0, limits_, q, joints))
    return false;
  const Rates a = now().pace(), b = next().pace();
  const double in = blend_.entry(), out = blend_.exit();
  const double b_left = next().length() - blend_.gone();
  double e = 0.0;
  if (next().move().r > 0.0 && next().way_within(next().move().r, true, e)) e = std::min(e, b_left);
  const double stops = std::sqrt(b.a * (2.0 * b_left - e));
  const double most = std::min(
      {joints.v, next().most().v / out, stops / out, std::sqrt(v * v + 2.0 * a.a * way) / in});
  const double least = std::sqrt(std::max(0.0, v * v - 2.0 * a.a * way)) / in;
  double wanted = std::min({a.v / in, b.v / out, most});
  if (!blend_.keeps_speed()) wanted = std::min(wanted, blend_.rate(a.a, b.a));
  rate_ = std::max(wanted, least);
  return rate_ <= most * (1.0 + 1e-6) && rate_ > 0.0;
}

double MovePath::advance(double h_s) {
  double used_s = 0.0;
  while (!done_ && used_s < h_s) {
    const double settle_s = stage_ == Stage::kToPoint ? kSettle_s : 0.0;
    const double end_s = stage_ == Stage::kBlend ? 1.0 / rate_ : law_.duration_s() + settle_s;
    const double until_s = std::min(end_s, ask_s_);
    const double step_s = std::min(h_s - used_s, std::max(0.0, until_s - time_s_));
    time_s_ += step_s;
    used_s += step_s;
    if (used_s >= h_s && time_s_ < until_s) break;
    if (ask_s_ < end_s) {
      ask_s_ = kNever_s;
      asked_ = true;
      return used_s;
    }
    next_stage();
  }
  return used_s;
}

void MovePath::next_stage() {
  switch (stage_) {
    case Stage::kToPoint:
      done_ = true;
      asked_ = false;
      return;
    case Stage::kToBlend:
      stage_ = Stage::kBlend;
      time_s_ = 0.0;
      return;
    case Stage::kBlend: now_ = 1 - now_; go_to_point(blend_.gone(), rate_ * blend_.exit());
  }
}

bool MovePath::posture(const Joints& near, Joints& q, Joints& dq) const {
  Joints slope;
  if (stage_ == Stage::kBlend) {
    if (!blend_.at(rate_ * time_s_, near, q, slope)) return false;
    dq = rate_ * slope;
    return true;
  }
  const bool arrived = stage_ == Stage::kToPoint && time_s_ >= law_.duration_s();
  const double x = arrived ? now().length() : x0_ + law_.position(time_s_);
  if (!now().at(x, near, q, slope)) return false;
  dq = law_.speed(time_s_) * slope;
  return true;
}

bool MovePath::take_overlap() {
  const bool overlap = overlap_;
  overlap_ = false;
  return overlap;
}

}  // namespace tactus::ur
