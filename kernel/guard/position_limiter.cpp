#include "kernel/guard/position_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

void PositionLimiter::start(const StepLimits& limits, double q) {
  *this = {};
  limits_ = limits;
  sent_ = target_ = q;
}

double PositionLimiter::next(double wanted) {
  const StepBand band = allowed_steps(limits_, sent_, step_);
  const double target = std::clamp(wanted, limits_.q_min, limits_.q_max);
  // Beside a target that moves, what it is ahead is closed at a speed that can still be braked; the
  // last step, of one change at most, comes to rest on it.
  const double ahead = target_ - sent_;
  if (std::abs(ahead) <= limits_.change && band.contains(wanted - sent_)) {
    return move(wanted, target);
  }
  const double closing = std::copysign(braking_step(std::abs(ahead), limits_.change), ahead);
  return move(sent_ + std::clamp(target - target_ + closing, band.lo, band.hi), target);
}

double PositionLimiter::brake() {
  const StepBand band = allowed_steps(limits_, sent_, step_);
  const double to = sent_ + std::clamp(0.0, band.lo, band.hi);
  return move(to, to);
}

double PositionLimiter::move(double to, double target) {
  const double step = to - sent_, change = step - step_;
  jerky_ = limits_.jerky(change - change_);
  sent_ = to, target_ = target, step_ = step, change_ = change;
  return sent_;
}

}  // namespace tactus
