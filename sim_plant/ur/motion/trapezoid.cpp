#include "sim_plant/ur/motion/trapezoid.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {

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

}  // namespace tactus::ur
