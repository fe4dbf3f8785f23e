// Shared by the tests of axis_motion.hpp: seeded limits, states and targets, and a judge of plans
// that integrates their phases independently, in long double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kernel/math/axis_motion.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

struct AxisRandom {
  std::mt19937_64 bits{20260711};
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(bits); }
  double decades(double a, double b) { return std::pow(10.0, between(a, b)); }
  bool one_in(int n) { return bits() % static_cast<unsigned>(n) == 0; }
  double sign() { return one_in(2) ? 1.0 : -1.0; }
};

inline double run_out(const AxisState& s, double j) {
  return s.v + 0.5 * s.a * std::abs(s.a) / j;
}

/// Limits over several decades, in half of all cases equal in both directions. The acceleration is
/// at most a hundred times the largest that a ramp between the velocity limits reaches: beyond
/// that, rounding errors of a^2 / j matter.
inline AxisLimits random_limits(AxisRandom& random) {
  const double v = random.decades(-2, 1), j = random.decades(0, 4);
  const double a = std::min(random.decades(-1, 2), 100.0 * std::sqrt(v * j));
  if (random.one_in(2)) return {-v, v, a, a, j};
  return {-v, v * random.decades(0, 1), a, a * random.decades(-1, 0), j};
}

/// A state anywhere inside the limits, on one or two of them, or at rest. The velocity left when
/// the acceleration has run out is inside, too.
inline AxisState random_inside(AxisRandom& random, const AxisLimits& l) {
  for (int i = 0; i < 1000; ++i) {
    AxisState s{random.between(-1, 1), random.between(l.v_lo, l.v_hi),
                random.between(-l.a_dn, l.a_up)};
    if (random.one_in(8)) s.a = random.one_in(2) ? l.a_up : -l.a_dn;
    if (random.one_in(8)) s.a = 0.0;
    if (random.one_in(8)) s.v = random.one_in(2) ? l.v_hi : l.v_lo;
    if (random.one_in(8)) s.v = 0.0;
    if (random.one_in(8)) s.v = (s.a > 0.0 ? l.v_hi : l.v_lo) - 0.5 * s.a * std::abs(s.a) / l.j;
    const double rest = run_out(s, l.j);
    if (std::max(s.v, rest) <= l.v_hi && std::min(s.v, rest) >= l.v_lo) return s;
  }
  return {};
}

/// A state beyond the limits of velocity, acceleration or both, by up to `factor`.
inline AxisState random_outside(AxisRandom& random, const AxisLimits& l, double factor) {
  const double reach = 2.0 * std::sqrt(l.j * (l.v_hi - l.v_lo));
  return {random.between(-1, 1), factor * random.between(l.v_lo, l.v_hi),
          factor * random.between(-std::min(reach, l.a_dn), std::min(reach, l.a_up))};
}

struct AxisTarget {
  double p, v;
};

/// A target near, far, at or next to the axis, or exactly where the direct stop ends; in half of
/// all cases at rest, otherwise with a velocity inside or on a limit.
inline AxisTarget random_target(AxisRandom& random, const AxisState& s, const AxisLimits& l) {
  const double way = l.v_hi * (l.v_hi / l.a_dn + l.a_dn / l.j);
  double p = s.p + random.sign() * way * random.decades(-4, 1.5);
  if (random.one_in(10)) p = s.p;
  if (random.one_in(10)) p = s.p + random.sign() * way * 1e-15;
  if (random.one_in(10)) p = plan_stop(s, l).at(1e9).p;
  const double v = random.one_in(2)    ? 0.0
                   : random.one_in(10) ? (random.one_in(2) ? l.v_lo : l.v_hi)
                                       : random.between(l.v_lo, l.v_hi);
  return {p, v};
}

/// A state in long double, integrated independently of the code under test.
struct LongState {
  long double p, v, a;
  LongState after(long double t, long double j) const {
    return {p + t * v + t * t * a / 2 + t * t * t * j / 6, v + t * a + t * t * j / 2, a + t * j};
  }
};

/// Extremes of position, velocity and acceleration, the end state, and whether every phase is
/// longer than zero and has jerk 0 or +-j.
struct Judged {
  double p_lo, p_hi, v_lo, v_hi, a_lo, a_hi, end_p, end_v, end_a, path;
  bool lawful = true;
};

/// The times at which the acceleration and, twice, the velocity cross zero under constant jerk; NaN
/// if they do not.
inline std::array<long double, 3> turns(const LongState& s, long double j) {
  const long double root = std::sqrt(s.a * s.a - 2 * j * s.v);
  if (j == 0) return {NAN, -s.v / s.a, NAN};
  return {-s.a / j, (-s.a - root) / j, (-s.a + root) / j};
}

inline Judged judge(const AxisPlan& plan, const AxisState& from, double j) {
  LongState s{from.p, from.v, from.a};
  Judged judged{from.p, from.p, from.v, from.v, from.a, from.a, 0, 0, 0, 0};
  const auto see = [&judged](const LongState& at) {
    judged.p_lo = std::min(judged.p_lo, static_cast<double>(at.p));
    judged.p_hi = std::max(judged.p_hi, static_cast<double>(at.p));
    judged.v_lo = std::min(judged.v_lo, static_cast<double>(at.v));
    judged.v_hi = std::max(judged.v_hi, static_cast<double>(at.v));
    judged.a_lo = std::min(judged.a_lo, static_cast<double>(at.a));
    judged.a_hi = std::max(judged.a_hi, static_cast<double>(at.a));
  };
  for (int i = 0; i < plan.phases(); ++i) {
    const auto& phase = plan.phase(i);
    judged.lawful &= phase.duration > 0.0 && (phase.jerk == 0.0 || std::abs(phase.jerk) == j);
    for (const long double t : turns(s, phase.jerk))
      if (t > 0 && t < phase.duration) see(s.after(t, phase.jerk));
    const LongState next = s.after(phase.duration, phase.jerk);
    judged.path +=
        std::max(std::abs(static_cast<double>(s.v)), std::abs(static_cast<double>(next.v))) *
        phase.duration;
    s = next;
    see(s);
  }
  judged.end_p = static_cast<double>(s.p);
  judged.end_v = static_cast<double>(s.v);
  judged.end_a = static_cast<double>(s.a);
  return judged;
}

/// The FER's joints; see tests/oracles/otg/README.md.
constexpr std::array<AxisLimits, 7> kFerAxes{{{-2.175, 2.175, 15.0, 15.0, 7500.0},
                                              {-2.175, 2.175, 7.5, 7.5, 3750.0},
                                              {-2.175, 2.175, 10.0, 10.0, 5000.0},
                                              {-2.175, 2.175, 12.5, 12.5, 6250.0},
                                              {-2.61, 2.61, 15.0, 15.0, 7500.0},
                                              {-2.61, 2.61, 20.0, 20.0, 10000.0},
                                              {-2.61, 2.61, 20.0, 20.0, 10000.0}}};

/// The excess of the range [lo, hi] over [least, most], as a fraction of the latter.
inline double excess(double lo, double hi, double least, double most) {
  return std::max((hi - most) / (most - least), (least - lo) / (most - least));
}

/// Asserts that the jerk is full or zero in every phase, that velocity and acceleration keep `kept`
/// (the jerk is the law's), and that the target is met, all up to rounding; a^2 / j is up to 1e4
/// times a velocity limit.
inline void assert_lawful(const AxisPlan& plan, const AxisState& from, const AxisTarget& target,
                          const AxisLimits& law, const AxisLimits& kept) {
  const Judged judged = judge(plan, from, law.j);
  assert_true(judged.lawful);
  assert_true(excess(judged.v_lo, judged.v_hi, kept.v_lo, kept.v_hi) <= 1e-9);
  assert_true(excess(judged.a_lo, judged.a_hi, -kept.a_dn, kept.a_up) <= 1e-9);
  ASSERT_NEAR(judged.end_p, target.p, 1e-9 * judged.path + 1e-14 * std::abs(from.p));
  ASSERT_NEAR(judged.end_v, target.v, 1e-9 * (kept.v_hi - kept.v_lo));
  ASSERT_NEAR(judged.end_a, 0.0, 1e-9 * (kept.a_up + kept.a_dn));
}

}  // namespace tactus
