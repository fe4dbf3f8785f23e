#include "kernel/guard/stopping.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

/// How far one joint gets above where it is: U at t_r, and after that by phi of `further`.
struct Above {
  double at_reaction, further;
};

Above above(double v, double a, double t_r, double t_s) {
  return {v * t_r + 0.5 * a * t_r * t_r, 0.5 * t_s * std::max(0.0, v + a * t_r)};
}

double stopping_time(const Braking& braking, const JointVector& dq) {
  double t_s = 0.0;
  for (int j = 0; j < kDof; ++j) {
    const double v = std::abs(dq[j]) + braking.acceleration[j] * braking.reaction_s;
    t_s = std::max(t_s, v / braking.deceleration[j]);
  }
  return t_s;
}

}  // namespace

StoppingBoxes stopping_boxes(const Braking& braking, const JointVector& q, const JointVector& dq) {
  const double t_r = braking.reaction_s, t_s = stopping_time(braking, dq);
  StoppingBoxes boxes;
  for (int j = 0; j < kDof; ++j) {
    const Above up = above(dq[j], braking.acceleration[j], t_r, t_s);
    const Above down = above(-dq[j], braking.acceleration[j], t_r, t_s);
    double highest = 0.0, lowest = 0.0;  // at the beginning of the section
    for (int k = 0; k <= kSections; ++k) {
      const double phi = static_cast<double>(k) / kSections;
      const double high = up.at_reaction + phi * up.further;
      const double low = -(down.at_reaction + phi * down.further);
      const double top = std::max(highest, high), bottom = std::min(lowest, low);
      JointBox& box = boxes[static_cast<std::size_t>(k)];
      box.middle[j] = q[j] + 0.5 * (top + bottom);
      box.half[j] = 0.5 * (top - bottom);
      highest = high, lowest = low;
    }
  }
  return boxes;
}

}  // namespace tactus
