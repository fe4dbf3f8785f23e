// The motion that turns before the acceleration is zero: jerk +j for t in [0, -a/j], then the fall
// to vf. With (v', a') the state at the turn, b the peak of the fall, t_on and t_hold its times,
//
//   D(t) = d_turn + d_fall,  dD/dt = 2 (v' + a' (t_on + t_hold) + (a'/b) (vf + b^2 / 2j))
//
// for the fall's distance F(v', a') loses v' per time on its first ramp, F_v a' - F_a j = -v',
// which gives dD/dt = v' + F_v a' + F_a j = 2 (v' + F_v a'), and moving both its velocities by one
// moves it by its duration, F_v = T - dF/dw = T + vf/b - b/2j.
//
// Towards vf >= 0 D only grows. With v > 0 > vf it may have a hump: grow beyond the target and
// shrink below it again. The target is then met on the way up.
#include "kernel/math/axis_ascent.hpp"
#include "kernel/math/velocity_change.hpp"

namespace tactus {
namespace {

constexpr int kNewtonSteps = 20, kHumpSteps = 10;

struct Turn {
  AxisState state;
  VelocityChange fall;
  double beyond;  // the distance less the one wanted
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

/// A time at which D is beyond the target, on a hump; negative if none is found.
double on_hump(double last, const Ascent& ascent) {
  double low = 0.0, high = last;
  if (!(turn_at(0.0, ascent).slope > 0.0)) return -1.0;
  for (int i = 0; i < kHumpSteps; ++i) {
    const double t = 0.5 * (low + high);
    const Turn turn = turn_at(t, ascent);
    if (turn.beyond >= 0.0) return t;
    (turn.slope > 0.0 ? low : high) = t;
  }
  return -1.0;
}

/// D(0) is short of the target, D(high) is not: Newton's method within the bracket.
double meeting_turn(double high, double first, const Ascent& ascent) {
  double low = 0.0, t = first;
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

bool append_while_braking(AxisPlan& plan, Ascent& ascent) {
  const double j = ascent.limits.j;
  double last = -ascent.a / j;
  double beyond = turn_at(last, ascent).beyond;
  if (beyond < 0.0) {
    const double hump = ascent.v > 0.0 && ascent.vf < 0.0 ? on_hump(last, ascent) : -1.0;
    if (hump < 0.0) {
      ascent.missing = -beyond;
      return false;
    }
    last = hump;
    beyond = turn_at(last, ascent).beyond;
  }
  const double linear = last * ascent.missing / (ascent.missing + beyond);
  const double t = meeting_turn(last, linear, ascent);
  plan.append(t, ascent.side * j);
  append(plan, turn_at(t, ascent).fall, -ascent.side * j);
  return true;
}

}  // namespace tactus
