#include "sim_plant/ur/motion/move_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::ur {
namespace {

constexpr double kSettle_s = 0.064;  // a move returns after the arm has settled too
constexpr double kNever_s = std::numeric_limits<double>::infinity();

}  // namespace

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
