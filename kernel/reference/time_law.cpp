#include "kernel/reference/time_law.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/loop_bound.hpp"

namespace tactus {

void TimeLaw::start(double rate, double s) {
  *this = TimeLaw();
  s_ = s;
  rate_ = target_ = rate;
}

/// Time-optimal motion of a double integrator from (rate, slope) to (target, 0) with bounded slope
/// and curvature: curvature of one sign, a stretch at the largest slope if there is room for one,
/// curvature of the other sign.
void TimeLaw::plan(double target, const RateBounds& bounds) {
  target_ = target;
  const double c = bounds.curvature;
  // Where the rate would come to rest if the slope were taken to zero at once; the target lies on
  // this side of it.
  const double rest = rate_ + slope_ * std::abs(slope_) / (2.0 * c);
  const double side = target >= rest ? 1.0 : -1.0;
  const double way = side * (target - rate_);
  const double first = side * slope_;  // slope now, towards the target positive
  double peak = std::sqrt(std::max(0.0, c * way + 0.5 * first * first));
  double cruise_s = 0.0;
  if (peak > bounds.slope) {
    cruise_s = (peak * peak - bounds.slope * bounds.slope) / (c * bounds.slope);
    peak = bounds.slope;
  }
  phases_[0] = {std::max(0.0, (peak - first) / c), side * c};
  phases_[1] = {cruise_s, 0.0};
  phases_[2] = {peak / c, -side * c};
  phase_ = 0;
  phase_time_s_ = 0.0;
}

/// Compensated summation (Kahan 1965).
void TimeLaw::pass(double path_time_s) {
  const double corrected = path_time_s - carry_;
  const double sum = s_ + corrected;
  carry_ = (sum - s_) - corrected;
  s_ = sum;
}

void TimeLaw::move(double dt_s, double curvature) {
  pass(dt_s * (rate_ + dt_s * (slope_ / 2.0 + dt_s * curvature / 6.0)));
  rate_ += dt_s * (slope_ + dt_s * curvature / 2.0);
  slope_ += dt_s * curvature;
}

void TimeLaw::advance(double dt_s) {
  LoopBound<3> phases;
  while (phase_ < phases_.size()) {
    phases.tick();
    const Phase& phase = phases_[phase_];
    const double left_s = phase.duration_s - phase_time_s_;
    if (dt_s < left_s) {
      move(dt_s, phase.curvature);
      phase_time_s_ += dt_s;
      return;
    }
    move(left_s, phase.curvature);
    dt_s -= left_s;
    phase_time_s_ = 0.0;
    if (++phase_ == phases_.size()) {
      rate_ = target_;
      slope_ = 0.0;
    }
  }
  pass(dt_s * rate_);
}

double TimeLaw::stopping_s(const RateBounds& bounds) const {
  TimeLaw stop = *this;
  stop.plan(0.0, bounds);
  double duration_s = 0.0;
  for (const Phase& phase : stop.phases_) duration_s += phase.duration_s;
  stop.advance(duration_s);
  return stop.s_ - s_;
}

}  // namespace tactus
