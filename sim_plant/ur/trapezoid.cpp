#include "sim_plant/ur/trapezoid.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {

Trapezoid Trapezoid::by_speed(double v, double a) {
  Trapezoid law;
  v = std::min(v, std::sqrt(a));  // a triangle where the way is too short for the speed
  law.a_ = a;
  law.ramp_s_ = v / a;
  law.flat_s_ = std::max(0.0, 1.0 / v - law.ramp_s_);
  return law;
}

Trapezoid Trapezoid::by_duration(double duration_s) {
  const double ramp_s = 0.25 * duration_s;
  const double v = 1.0 / (duration_s - ramp_s);
  return by_speed(v, v / ramp_s);
}

double Trapezoid::position(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s()), left = duration_s() - t;
  if (t < ramp_s_) return 0.5 * a_ * t * t;
  if (left < ramp_s_) return 1.0 - 0.5 * a_ * left * left;
  return 0.5 * a_ * ramp_s_ * ramp_s_ + a_ * ramp_s_ * (t - ramp_s_);
}

double Trapezoid::speed(double t_s) const {
  const double left = duration_s() - t_s;
  return a_ * std::clamp(std::min(t_s, left), 0.0, ramp_s_);
}

}  // namespace tactus::ur
