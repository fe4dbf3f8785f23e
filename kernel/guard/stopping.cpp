#include "kernel/guard/stopping.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

double stopping_time(const Braking& braking, const JointVector& dq) {
  double t_s = 0.0;
  for (int j = 0; j < kDof; ++j) {
    const double v = std::abs(dq[j]) + braking.acceleration[j] * braking.reaction_s;
    t_s = std::max(t_s, v / braking.deceleration[j]);
  }
  return t_s;
}

/// U(t) - q of one joint that moves at dq, accelerates with a and brakes with b.
struct Highest {
  double dq, a, b, t_r, t_s;

  double at_reaction() const { return dq * t_r + 0.5 * a * t_r * t_r; }
  /// The value s after t_r, 0 <= s <= t_s.
  double at(double s) const {
    const double v = dq + a * t_r;
    if (v < 0.0) {
      const double braked = std::min(s, -v / b);
      return at_reaction() + v * braked + 0.5 * b * braked * braked;
    }
    return at_reaction() + v * (s > 0.0 ? s - 0.5 * s * s / t_s : 0.0);
  }
};

}  // namespace

StoppingBoxes stopping_boxes(const Braking& braking, const JointVector& q, const JointVector& dq) {
  const double t_r = braking.reaction_s, t_s = stopping_time(braking, dq);
  StoppingBoxes boxes;
  for (int j = 0; j < kDof; ++j) {
    const double a = braking.acceleration[j], b = braking.deceleration[j];
    const Highest up = {dq[j], a, b, t_r, t_s}, down = {-dq[j], a, b, t_r, t_s};
    double high = 0.0, low = 0.0;  // at the beginning of the section
    for (int k = 0; k <= kSections; ++k) {
      const double s = t_s * (1.0 - std::sqrt(1.0 - static_cast<double>(k) / kSections));
      const double next_high = up.at(s), next_low = -down.at(s);
      // Written so that NaN is kept.
      const double top = high > next_high ? high : next_high;
      const double bottom = low < next_low ? low : next_low;
      JointBox& box = boxes[static_cast<std::size_t>(k)];
      box.middle[j] = q[j] + 0.5 * (top + bottom);
      box.half[j] = 0.5 * (top - bottom);
      high = next_high;
      low = next_low;
    }
  }
  return boxes;
}

}  // namespace tactus
