#include <limits>

#include "kernel/math/axis_motion.hpp"

namespace tactus {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

AxisState moved(const AxisState& from, double t, double jerk) {
  return {from.p + t * (from.v + t * (0.5 * from.a + t * jerk / 6.0)),
          from.v + t * (from.a + 0.5 * t * jerk), from.a + t * jerk};
}

AxisPlan::AxisPlan() : AxisPlan({kNaN, kNaN, kNaN}, kNaN, kNaN) {
  duration_ = kNaN;
}

AxisPlan::AxisPlan(const AxisState& from, double p, double v) : from_(from), p_(p), v_(v) {}

void AxisPlan::append(double duration, double jerk) {
  if (duration <= 0.0) return;
  duration_ += duration;
  if (phases_ < kPhases)
    phase_[static_cast<std::size_t>(phases_++)] = {duration, jerk};
  else
    duration_ = kNaN;  // no motion of ours has more
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
  return {p_, v_, 0.0};  // what the sum of the durations was rounded by
}

AxisState AxisPlan::after_lead() const {
  AxisState state = from_;
  for (int i = 0; i < kPhases; ++i)
    if (i < lead_) state = moved(state, phase(i).duration, phase(i).jerk);
  return state;
}

}  // namespace tactus
