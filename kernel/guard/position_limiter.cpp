#include "kernel/guard/position_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

void PositionLimiter::start(const StepLimits& limits, double q) {
  *this = {};
  limits_ = limits;
  q_min_ = limits.q_min;
  q_max_ = limits.q_max;
  limits_.q_min = std::min(q_min_, q);
  limits_.q_max = std::max(q_max_, q);
  sent_ = target_ = q;
}

/// False while the sequence is further than one change from the last target: next() then closes the
/// distance at a speed that can still be braked, in addition to the motion of the target.
bool PositionLimiter::follows(double wanted) const {
  return std::abs(target_ - sent_) <= limits_.change &&
         allowed_steps(limits_, sent_, step_).contains(wanted - sent_);
}

double PositionLimiter::next(double wanted) {
  const double target = std::clamp(wanted, limits_.q_min, limits_.q_max);
  if (follows(wanted)) return move(wanted, target);
  const StepBand band = allowed_steps(limits_, sent_, step_);
  const double ahead = target_ - sent_;
  const double closing = std::copysign(braking_step(std::abs(ahead), limits_.change), ahead);
  return move(sent_ + std::clamp(target - target_ + closing, band.lo, band.hi), target);
}

double PositionLimiter::brake() {
  const StepBand band = allowed_steps(limits_, sent_, step_);
  const double to = sent_ + std::clamp(0.0, band.lo, band.hi);
  return move(to, to);
}

/// Draws limits that were widened for the start in behind the position sent.
void PositionLimiter::draw_in() {
  limits_.q_min = std::min(q_min_, std::max(limits_.q_min, sent_));
  limits_.q_max = std::max(q_max_, std::min(limits_.q_max, sent_));
}

double PositionLimiter::move(double to, double target) {
  const double step = to - sent_, change = step - step_;
  jerky_ = limits_.jerky(change - change_);
  sent_ = to;
  draw_in();
  target_ = target;
  step_ = step;
  change_ = change;
  return sent_;
}

}  // namespace tactus
