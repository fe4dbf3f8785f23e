// The motion whose jerk changes sign before the acceleration is zero: jerk +j for t in [0, -a/j],
// then the fall to vf. With (v', a') the state at the turn, b the peak of the fall, t_on and t_hold
// its times,
//
//   D(t) = d_turn + d_fall,  dD/dt = 2 (v' + a' (t_on + t_hold) + (a'/b) (vf + b^2 / 2j))
//
// because the fall's distance F(v', a') decreases by v' per time on its first ramp, F_v a' - F_a j
// = -v', which gives dD/dt = v' + F_v a' + F_a j = 2 (v' + F_v a'); and because raising both its
// velocities by one adds its duration, F_v = T - dF/dw = T + vf/b - b/2j.
//
// D only grows or only shrinks, except for v > 0 > vf: there it may have a hump, grow beyond the
// target and shrink below it again, and, if v1 > 0, grow a second time towards the end. The target
// is met on the first rise.
#include "kernel/math/axis_ascent.hpp"
#include "kernel/math/velocity_change.hpp"

namespace tactus {
namespace {

constexpr int kNewtonSteps = 20, kScanned = 8, kHumpSteps = 10;

struct Turn {
  AxisState state;
  VelocityChange fall;
  double beyond;  // distance beyond the target
  double slope;
};

Turn turn_at(double t, const Ascent& ascent) {
  const double j = ascent.limits.j, vf = ascent.vf;
  const AxisState s = moved({0.0, ascent.v, ascent.a}, t, j);
  const VelocityChange f = fall(s.v, s.a, vf, ascent.limits.a_dn, j);
  const double share = f.peak > 0.0 ? s.a / f.peak : 0.0;
  return {s, f, s.p + f.distance - ascent.distance,
          2.0 * (s.v + s.a * (f.on + f.hold) + share * (vf + 0.5 * f.peak * f.peak / j))};
}

/// Searches between two times for the maximum of D. Returns a time at which D is beyond the target;
/// negative if the maximum is short of it.
double on_top(double low, double high, const Ascent& ascent) {
  for (int i = 0; i < kHumpSteps; ++i) {
    const double t = 0.5 * (low + high);
    const Turn turn = turn_at(t, ascent);
    if (turn.beyond >= 0.0) return t;
    (turn.slope > 0.0 ? low : high) = t;
  }
  return -1.0;
}

/// Returns a time on the first rise at which D is beyond the target; negative if there is none.
double on_hump(double last, const Ascent& ascent) {
  double before = 0.0;
  for (int i = 1; i <= kScanned; ++i) {
    const double t = last * i / kScanned;
    const Turn turn = turn_at(t, ascent);
    if (turn.beyond >= 0.0) return t;
    if (turn.slope < 0.0) {
      const double top = on_top(before, t, ascent);
      if (top >= 0.0) return top;
    }
    before = t;
  }
  return -1.0;
}

/// Returns the time at which D meets the target, by Newton's method between 0, where D is short of
/// it, and `high`, where D is not.
double meeting_turn(double high, const Ascent& ascent) {
  double low = 0.0;
  double t = high * ascent.missing / (ascent.missing + turn_at(high, ascent).beyond);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Turn turn = turn_at(t, ascent);
    if (std::abs(turn.beyond) <= ascent.tolerance) break;
    (turn.beyond > 0.0 ? high : low) = t;
    const double next = turn.slope > 0.0 ? t - turn.beyond / turn.slope : low;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

}  // namespace

double late_turn(Ascent& ascent) {
  const double end = -ascent.a / ascent.limits.j;
  const double beyond_end = turn_at(end, ascent).beyond;
  double last = beyond_end >= 0.0 ? end : -1.0;
  if (ascent.v > 0.0 && ascent.vf < 0.0) last = on_hump(end, ascent);
  if (last < 0.0) ascent.missing = -beyond_end;
  return last;
}

void append_while_braking(AxisPlan& plan, const Ascent& ascent, double late) {
  const double j = ascent.limits.j, t = meeting_turn(late, ascent);
  plan.append(t, ascent.side * j);
  append(plan, turn_at(t, ascent).fall, -ascent.side * j);
}

}  // namespace tactus
