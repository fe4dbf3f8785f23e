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

/// Returns the time on the ramp, from t_r on, at which section `section` ends.
double end_s(double t_s, int section) {
  return t_s * (1.0 - std::sqrt(1.0 - static_cast<double>(section) / kBrakes));
}

}  // namespace

JointBox stopping_box(const Braking& braking, const JointVector& q, const JointVector& dq,
                      int section) {
  const double t_r = braking.reaction_s, t_s = stopping_time(braking, dq);
  const double end = end_s(t_s, section), begin = section > 0 ? end_s(t_s, section - 1) : 0.0;
  JointBox box;
  for (int j = 0; j < kDof; ++j) {
    const double a = braking.acceleration[j], b = braking.deceleration[j];
    const Highest up = {dq[j], a, b, t_r, t_s}, down = {-dq[j], a, b, t_r, t_s};
    const double high = section > 0 ? up.at(begin) : 0.0, next_high = up.at(end);
    const double low = section > 0 ? -down.at(begin) : 0.0, next_low = -down.at(end);
    // Written so that NaN is kept.
    const double top = high > next_high ? high : next_high;
    const double bottom = low < next_low ? low : next_low;
    box.middle[j] = q[j] + 0.5 * (top + bottom);
    box.half[j] = 0.5 * (top - bottom);
  }
  return box;
}

// A joint gets farthest in the direction in which it moves, on the ramp that is common to all.
JointVector stopping_range(const Braking& braking, const JointVector& dq) {
  const double t_r = braking.reaction_s, t_s = stopping_time(braking, dq);
  JointVector range;
  for (int j = 0; j < kDof; ++j) {
    const double speed = std::abs(dq[j]), faster = speed + braking.acceleration[j] * t_r;
    range[j] = 0.5 * ((speed + faster) * t_r + faster * t_s);
  }
  return range;
}

}  // namespace tactus
