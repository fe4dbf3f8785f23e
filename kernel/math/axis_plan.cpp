#include "kernel/math/axis_motion.hpp"

namespace tactus {

AxisState moved(const AxisState& from, double t, double jerk) {
  return {from.p + t * (from.v + t * (0.5 * from.a + t * jerk / 6.0)),
          from.v + t * (from.a + 0.5 * t * jerk), from.a + t * jerk};
}

AxisState AxisPlan::at(double t) const {
  if (t >= duration_) return {p_ + v_ * (t - duration_), v_, 0.0};
  AxisState state = from_;
  for (int i = 0; i < kPhases; ++i) {
    if (i >= phases_) break;
    const Phase& now = phase(i);
    if (t <= now.duration) return moved(state, t, now.jerk);
    state = moved(state, now.duration, now.jerk);
    t -= now.duration;
  }
  return {p_, v_, 0.0};  // t is within the rounding of duration_
}

AxisState AxisPlan::after_lead() const {
  AxisState state = from_;
  for (int i = 0; i < kPhases; ++i) {
    if (i >= lead_) break;
    state = moved(state, phase(i).duration, phase(i).jerk);
  }
  return state;
}

double AxisPlan::lead_duration() const {
  double sum = 0.0;
  for (int i = 0; i < kPhases; ++i) {
    if (i >= lead_) break;
    sum += phase(i).duration;
  }
  return sum;
}

void AxisPlan::cut_to_lead() {
  duration_ = lead_duration();
  phases_ = lead_;
}

}  // namespace tactus
