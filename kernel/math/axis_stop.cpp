#include "kernel/math/axis_direct.hpp"
#include "kernel/math/axis_return.hpp"

namespace tactus {
namespace {

void include(AxisRange& range, double p) {
  range.lowest = std::min(range.lowest, p);
  range.highest = std::max(range.highest, p);
}

/// Includes the turning point, v + a t + jerk t^2 / 2 = 0, if it is within `duration`. Only a phase
/// whose jerk opposes its acceleration has one; otherwise the velocity keeps its sign.
void include_turn(AxisRange& range, const AxisState& s, double jerk, double duration) {
  const double square = s.a * s.a - 2.0 * jerk * s.v;
  if (!(s.v * s.a < 0.0 && jerk * s.a < 0.0 && square >= 0.0)) return;
  const double t = 2.0 * std::abs(s.v) / (std::abs(s.a) + std::sqrt(square));
  if (t <= duration) include(range, moved(s, t, jerk).p);
}

}  // namespace

AxisPlan plan_stop(const AxisState& from, const AxisLimits& limits) {
  AxisPlan plan;
  if (!usable(from, 0.0, 0.0, limits)) return plan;
  plan.start(from, from.p, 0.0);
  const AxisState s = append_acceleration_return(plan, from, limits);
  plan.end_lead();
  const DirectChange direct = direct_change(s, 0.0, limits);
  append(plan, direct.change, direct.jerk);
  plan.end_at(s.p + direct.change.distance, 0.0);
  make_finite(plan);
  return plan;
}

AxisRange stop_range(const AxisState& from, const AxisLimits& limits) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!usable(from, 0.0, 0.0, limits)) return {kNaN, kNaN};
  const double j = limits.j;
  AxisRange range{from.p, from.p};
  AxisState s = from;
  const double excess = s.a > limits.a_up    ? s.a - limits.a_up
                        : s.a < -limits.a_dn ? s.a + limits.a_dn
                                             : 0.0;
  if (excess != 0.0) {
    const double t = std::abs(excess) / j, jerk = excess > 0.0 ? -j : j;
    include_turn(range, s, jerk, t);
    s = moved(s, t, jerk);
    s.a = from.a - excess;
    include(range, s.p);
  }
  const DirectChange direct = direct_change(s, 0.0, limits);
  include_turn(range, s, direct.jerk, direct.change.on);
  include(range, s.p + direct.change.distance);
  return range;
}

}  // namespace tactus
