#include "kernel/guard/step_band.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

StepLimits StepLimits::of(const JointLimits& limits, int joint, double period_s) {
  const double dt = period_s;
  return {limits.q_min[joint], limits.q_max[joint], limits.dq_max[joint] * dt,
          limits.ddq_max[joint] * dt * dt, limits.dddq_max[joint] * dt * dt * dt};
}

bool StepLimits::jerky(double change_of_change) const {
  return !(std::abs(change_of_change) <= jerk + 2.0 * kChangeAllowance);
}

/// Solves distance = (n + 1) s - c n (n + 1) / 2 for s. The result is continuous where n changes,
/// so an n that is one off by rounding does no harm.
double braking_step(double distance, double change) {
  if (!(distance > 0.0)) return 0.0;
  constexpr double kMost = 1e9;  // more cycles than any braking takes, and n stays an integer
  const double cycles = 0.5 * (std::sqrt(1.0 + 8.0 * distance / change) - 1.0);
  const auto n = static_cast<double>(static_cast<std::int64_t>(std::min(cycles, kMost)));
  return distance / (n + 1.0) + 0.5 * change * n;
}

StepBand allowed_steps(const StepLimits& limits, double q, double last) {
  const double step = limits.step + kStepAllowance, change = limits.change + kChangeAllowance;
  const double above = limits.q_max - q + kPositionAllowance;
  const double below = q - limits.q_min + kPositionAllowance;
  const double up = std::min(step, braking_step(above, change));
  const double down = std::min(step, braking_step(below, change));
  // If the two bands do not meet, which in a sequence that started inside is due to rounding only,
  // the acceleration limit is kept and the braking is as hard as it allows.
  const double slowest = last - change, fastest = last + change;
  return {std::clamp(-down, slowest, fastest), std::clamp(up, slowest, fastest)};
}

}  // namespace tactus
