#include "kernel/math/axis_motion.hpp"

#include "kernel/math/axis_ascent.hpp"
#include "kernel/math/axis_direct.hpp"
#include "kernel/math/axis_return.hpp"

namespace tactus {
namespace {

/// Relative to the distances added: two units of rounding for each of about fifty operations.
constexpr double kMotionTolerance = 2e-14;

}  // namespace

Ascent ascent_of(const AxisState& s, double p, double v, const AxisLimits& limits, double missing) {
  const bool up = !(missing < 0.0);
  const double side = up ? 1.0 : -1.0;
  Ascent ascent;
  ascent.limits = up ? limits : mirrored(limits);
  ascent.side = side;
  ascent.v = side * s.v;
  ascent.a = side * s.a;
  ascent.v1 = rest_velocity(ascent.v, ascent.a, limits.j);
  ascent.vf = side * v;
  ascent.distance = side * (p - s.p);
  ascent.missing = side * missing;
  ascent.tolerance = rounding_of_way(s.p, p);
  return ascent;
}

void append_motion(AxisPlan& plan, const AxisState& from, double p, double v,
                   const AxisLimits& limits) {
  const AxisState inside = is_inside(from, limits) ? from : append_return(plan, from, limits);
  plan.end_lead();
  const double distance = p - inside.p;
  const DirectChange direct = direct_change(inside, v, limits);
  const double tolerance =
      kMotionTolerance * (std::abs(distance) + std::abs(direct.change.distance)) +
      rounding_of_way(inside.p, p);
  const double missing = distance - direct.change.distance;
  if (std::abs(missing) <= tolerance) {
    append(plan, direct.change, direct.jerk);
    return;
  }
  Ascent ascent = ascent_of(inside, p, v, limits, missing);
  ascent.tolerance = tolerance;
  const bool brakes = ascent.a < 0.0 && !ascent.rises_to_end();
  const double late = brakes ? late_turn(ascent) : -1.0;
  if (late >= 0.0)
    append_while_braking(plan, ascent, late);
  else
    append_over_velocity(plan, ascent);
}

AxisPlan plan_to(const AxisState& from, double p, double v, const AxisLimits& limits) {
  AxisPlan plan;
  if (!usable(from, p, v, limits)) return plan;
  const double vf = std::clamp(v, limits.v_lo, limits.v_hi);
  plan.start(from, p, vf);
  append_motion(plan, from, p, vf, limits);
  make_finite(plan);
  return plan;
}

}  // namespace tactus
