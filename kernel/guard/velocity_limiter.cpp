#include "kernel/guard/velocity_limiter.hpp"

#include <algorithm>

namespace tactus {

void VelocityLimiter::start(const StepLimits& limits, double period_s, double dq) {
  *this = {};
  limits_ = limits;
  period_s_ = period_s;
  step_ = dq * period_s;
}

bool VelocityLimiter::follows(double wanted, double q) const {
  return allowed_steps(limits_, q, step_).contains(wanted * period_s_);
}

double VelocityLimiter::next(double wanted, double q) {
  const StepBand band = allowed_steps(limits_, q, step_);
  const double asked = wanted * period_s_;
  const double step = std::clamp(asked, band.lo, band.hi), change = step - step_;
  jerky_ = limits_.jerky(change - change_);
  step_ = step;
  change_ = change;
  return step == asked ? wanted : step / period_s_;
}

}  // namespace tactus
