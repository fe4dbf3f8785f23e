// Tests motions of one axis from random states, inside and outside the limits, to random targets:
// limits on the way, the end, and the treatment of invalid numbers.
#include <limits>

#include "tests/math/axis_cases.hpp"

namespace tactus {
namespace {

constexpr int kCases = 40000;

/// The limits that a motion from outside must keep: extended to the state's own values and to the
/// velocity at which its acceleration runs out.
AxisLimits no_further_out(const AxisState& s, const AxisLimits& l) {
  const double rest = run_out(s, l.j);
  return {std::min({l.v_lo, s.v, rest}), std::max({l.v_hi, s.v, rest}), std::max(l.a_dn, -s.a),
          std::max(l.a_up, s.a), l.j};
}

/// Draws limits, a state and a target, and passes them to `check`.
template <class Check>
void over_cases(double factor, Check check) {
  AxisRandom random;
  for (int i = 0; i < kCases; ++i) {
    const AxisLimits limits = random_limits(random);
    const AxisState from =
        factor > 1.0 ? random_outside(random, limits, factor) : random_inside(random, limits);
    const AxisTarget target = random_target(random, from, limits);
    check(random, from, target, limits);
  }
}

// Proves MOT-2.

void limits_are_kept_and_the_end_is_met(void**) {
  over_cases(1.0, [](AxisRandom&, const AxisState& from, const AxisTarget& target,
                     const AxisLimits& limits) {
    const AxisPlan plan = plan_to(from, target.p, target.v, limits);
    assert_lawful(plan, from, target, limits, limits);
    const AxisState end = plan.at(plan.duration() + 2.0);
    assert_true(end.v == target.v && end.a == 0.0);
    ASSERT_NEAR(end.p, target.p + 2.0 * target.v,
                1e-12 * (std::abs(target.p) + std::abs(target.v)));
    assert_true(plan.at(plan.duration()).p == target.p);
  });
}

void stretched_motions_keep_limits_and_take_the_time_given(void**) {
  int blocked = 0, at_rest = 0;
  over_cases(1.0, [&](AxisRandom& random, const AxisState& from, const AxisTarget& target,
                      const AxisLimits& limits) {
    AxisPlan plan = plan_to(from, target.p, target.v, limits);
    const double optimum = plan.duration();
    const double duration = optimum * random.between(1.0, random.one_in(2) ? 1.1 : 4.0) + 1e-6;
    const bool stretched = stretch(plan, from, target.p, target.v, limits, duration);
    ASSERT_NEAR(plan.duration(), stretched ? duration : optimum, 1e-12 * duration);
    assert_lawful(plan, from, target, limits, limits);
    at_rest += target.v == 0.0;
    blocked += target.v == 0.0 && !stretched;
  });
  assert_true(blocked * 200 < at_rest);  // 3 of 1000 are
}

void nothing_is_left_of_an_acceleration_that_runs_out_at_the_velocity_limit(void**) {
  AxisRandom random;
  for (int i = 0; i < kCases; ++i) {
    const AxisLimits limits = random_limits(random);
    const double a =
        std::min(limits.a_up, std::sqrt(limits.j * limits.v_hi)) * random.decades(-4, 0);
    const AxisState from{0.0, limits.v_hi - 0.5 * a * a / limits.j, a};
    const AxisTarget target{limits.v_hi * random.decades(2, 5),
                            random.one_in(2) ? 0.0 : limits.v_hi};
    assert_lawful(plan_to(from, target.p, target.v, limits), from, target, limits, limits);
  }
}

void position_velocity_and_acceleration_are_derivatives_of_each_other(void**) {
  over_cases(1.0, [](AxisRandom& random, const AxisState& from, const AxisTarget& target,
                     const AxisLimits& limits) {
    const AxisPlan plan = plan_to(from, target.p, target.v, limits);
    const double h = plan.duration() * random.decades(-4, -1), j = limits.j;
    const double t = random.between(h, plan.duration() + h);
    const AxisState before = plan.at(t - h), now = plan.at(t), after = plan.at(t + h);
    // With |jerk| <= j the differences are off by at most this much; the rest is rounding.
    const double reach = std::max({std::abs(before.v), std::abs(after.v), j * h * h});
    const double rounding = 1e-11 * (std::abs(now.p) + reach * plan.duration());
    ASSERT_NEAR(after.p - before.p, 2.0 * h * now.v, j * h * h * h / 3.0 + rounding);
    const double v_rounding = 1e-9 * (limits.v_hi - limits.v_lo);
    ASSERT_NEAR(after.v - before.v, 2.0 * h * now.a, j * h * h + v_rounding);
    ASSERT_NEAR(after.a, now.a, j * h + 1e-9 * (limits.a_up + limits.a_dn));
  });
}

void scales_of_length_and_time_change_nothing(void**) {
  over_cases(1.0, [](AxisRandom& random, const AxisState& from, const AxisTarget& target,
                     const AxisLimits& limits) {
    // Powers of two: the scaled motion is identical to the last bit, except for the trial's cube
    // root.
    const double length = std::exp2(std::round(random.between(-40, 40)));
    const double time = std::exp2(std::round(random.between(-20, 20)));
    const double v = length / time, a = v / time, j = a / time;
    const AxisState state{length * from.p, v * from.v, a * from.a};
    const AxisTarget end{length * target.p, v * target.v};
    const AxisLimits wide{v * limits.v_lo, v * limits.v_hi, a * limits.a_dn, a * limits.a_up,
                          j * limits.j};
    const AxisPlan plan = plan_to(state, end.p, end.v, wide);
    assert_lawful(plan, state, end, wide, wide);
    const double tolerance = 4.0 * std::cbrt(6e-16 * std::abs(from.p) / limits.j);
    const double expected = plan_to(from, target.p, target.v, limits).duration();
    if (target.v == 0.0) ASSERT_NEAR(plan.duration() / time, expected, 1e-9 * expected + tolerance);
  });
}

// Proves MOT-3.

void from_outside_nothing_goes_further_out_and_the_end_is_met(void**) {
  for (double factor : {1.01, 3.0, 10.0})
    over_cases(factor, [](AxisRandom& random, const AxisState& from, const AxisTarget& target,
                          const AxisLimits& limits) {
      AxisPlan plan = plan_to(from, target.p, target.v, limits);
      const AxisLimits out = no_further_out(from, limits);
      assert_lawful(plan, from, target, limits, out);
      const double duration = plan.duration() * random.between(1.0, 2.0);
      if (!stretch(plan, from, target.p, target.v, limits, duration)) return;
      ASSERT_NEAR(plan.duration(), duration, 1e-12 * duration);
      assert_lawful(plan, from, target, limits, out);
    });
}

/// The time until a velocity above its limit is back at it, braked with full jerk down to the
/// acceleration limit, by integration in small steps.
double time_above(AxisState s, const AxisLimits& l) {
  const double step = 1e-4 * ((std::abs(s.a) + l.a_dn) / l.j + (s.v - l.v_hi) / l.a_dn);
  double t = 0.0;
  for (int i = 0; i < 400000 && (s.v > l.v_hi || s.a > 0.0); ++i, t += step) {
    const double a = std::max(-l.a_dn, s.a - l.j * step);
    s = {0.0, s.v + 0.5 * step * (s.a + a), a};
  }
  return t;
}

void a_velocity_outside_comes_back_the_shortest_way(void**) {
  AxisRandom random;
  for (int i = 0; i < 300; ++i) {
    AxisLimits limits = random_limits(random);
    const double reach = std::sqrt(limits.j * (limits.v_hi - limits.v_lo));
    limits.a_dn = std::min(limits.a_dn, reach);  // otherwise it may not use its full braking
    limits.a_up = std::min(limits.a_up, 3.0 * limits.a_dn);
    const AxisState from{0.0, limits.v_hi * random.between(1.01, 3.0),
                         random.between(-limits.a_dn, limits.a_up)};
    const double expected = time_above(from, limits);
    const AxisPlan plan = plan_to(from, random.between(-100, 100), 0.0, limits);
    const AxisPlan stop = plan_stop(from, limits);
    for (const AxisPlan& each : {plan, stop}) {
      const AxisState back = each.at(1.001 * expected);
      assert_true(back.v <= limits.v_hi * (1.0 + 1e-9));
    }
  }
}

// Proves MOT-6.

void the_direct_stop_is_the_shortest_way_to_rest_and_passes_its_range(void**) {
  for (double factor : {1.0, 3.0})
    over_cases(factor, [&](AxisRandom& random, const AxisState& from, const AxisTarget& target,
                           const AxisLimits& limits) {
      const AxisPlan stop = plan_stop(from, limits);
      const AxisState end = stop.at(stop.duration());
      assert_lawful(stop, from, {end.p, 0.0}, limits, no_further_out(from, limits));
      const double any = plan_to(from, target.p, 0.0, limits).duration();
      assert_true(stop.duration() <= any * (1.0 + 1e-9));
      const AxisRange range = stop_range(from, limits);
      const double rounding = 1e-9 * (range.highest - range.lowest) + 1e-12;
      double lowest = from.p, highest = from.p;
      for (int i = 0; i <= 200; ++i) {
        const double p = stop.at(stop.duration() * i / 200.0).p;
        lowest = std::min(lowest, p);
        highest = std::max(highest, p);
      }
      // A turning point between two samples differs from them by at most the way at the velocity
      // there.
      const double between =
          1e-4 * (range.highest - range.lowest) +
          (factor > 1.0 ? 10.0 : 1.0) * limits.j * std::pow(stop.duration() / 200.0, 3.0) +
          std::max(limits.a_up, limits.a_dn) * factor * std::pow(stop.duration() / 200.0, 2.0);
      assert_true(lowest >= range.lowest - rounding && highest <= range.highest + rounding);
      assert_true(lowest <= range.lowest + between && highest >= range.highest - between);
      (void)random;
    });
}

// Proves MOT-7.

void what_is_not_finite_or_no_limit_gives_a_plan_that_is_not_a_number(void**) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  for (double bad : kBad) {
    for (int i = 0; i < 12; ++i) {
      double n[12] = {0.1, 0.2, 0.3, 0.5, 0.1, -1.0, 1.0, 2.0, 2.0, 50.0, -1.0, 1.0};
      n[i] = bad;
      const AxisState from{n[0], n[1], n[2]};
      const AxisLimits limits{n[5], n[6], n[7], n[8], n[9]};
      AxisPlan plan = plan_to(from, n[3], n[4], limits);
      if (i < 10) {
        assert_true(std::isnan(plan.duration()) && std::isnan(plan.at(0.1).p));
        assert_false(stretch(plan, from, n[3], n[4], limits, 5.0));
      }
      const AxisPlan inside = plan_inside(from, n[3], limits, n[10], n[11]);
      if (i != 4) assert_true(std::isnan(inside.duration()) && std::isnan(inside.at(0.1).v));
      const AxisPlan stop = plan_stop(from, limits);
      if (i >= 3 && (i < 5 || i >= 10)) continue;
      assert_true(std::isnan(stop.duration()));
      const AxisRange range = stop_range(from, limits);
      assert_true(std::isnan(range.lowest) && std::isnan(range.highest));
    }
    AxisPlan good = plan_to({}, 1.0, 0.0, {-1.0, 1.0, 1.0, 1.0, 1.0});
    assert_false(stretch(good, {}, 1.0, 0.0, {-1.0, 1.0, 1.0, 1.0, 1.0}, std::abs(bad)));
    assert_true(good.duration() < 10.0);
  }
  const AxisLimits tiny{-1e-300, 1e-300, 1e-300, 1e-300, 1e-300};
  assert_true(std::isnan(plan_to({}, 1e300, 0.0, tiny).duration()));
  assert_true(std::isnan(plan_inside({}, 1e300, tiny, -1e300, 1e300).at(1.0).p));
  assert_true(std::isnan(plan_stop({0.0, 1e300, 0.0}, tiny).duration()));
  for (int i = 0; i < 5; ++i) {
    double n[5] = {-1.0, 1.0, 2.0, 2.0, 50.0};
    n[i] = 0.0;
    assert_true(std::isnan(plan_to({}, 1.0, 0.0, {n[0], n[1], n[2], n[3], n[4]}).duration()));
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(limits_are_kept_and_the_end_is_met),
      cmocka_unit_test(stretched_motions_keep_limits_and_take_the_time_given),
      cmocka_unit_test(nothing_is_left_of_an_acceleration_that_runs_out_at_the_velocity_limit),
      cmocka_unit_test(position_velocity_and_acceleration_are_derivatives_of_each_other),
      cmocka_unit_test(scales_of_length_and_time_change_nothing),
      cmocka_unit_test(from_outside_nothing_goes_further_out_and_the_end_is_met),
      cmocka_unit_test(a_velocity_outside_comes_back_the_shortest_way),
      cmocka_unit_test(the_direct_stop_is_the_shortest_way_to_rest_and_passes_its_range),
      cmocka_unit_test(what_is_not_finite_or_no_limit_gives_a_plan_that_is_not_a_number),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
