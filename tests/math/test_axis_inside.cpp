// Tests the position limits of one axis: motions to rest from states that can be kept inside and
// from states that cannot, planned once, and planned again every cycle while the target jumps.
#include "tests/math/axis_cases.hpp"

namespace tactus {
namespace {

/// The highest position of an ascent braked with jerk -j down to -a_dn, which is held until rest.
double highest_of_full_brake(const AxisState& s, const AxisLimits& l) {
  const long double ramp = (s.a + l.a_dn) / l.j;
  const LongState after = LongState{s.p, s.v, s.a}.after(ramp, -l.j);
  if (after.v > 0) return static_cast<double>(after.after(after.v / l.a_dn, 0).p);
  const long double t = (s.a + std::sqrt(s.a * s.a + 2.0L * l.j * s.v)) / l.j;
  return static_cast<double>(LongState{s.p, s.v, s.a}.after(t, -l.j).p);
}

/// Limits as random_limits gives them, except that every acceleration can run out between the
/// velocity limits.
AxisLimits modest_limits(AxisRandom& random) {
  AxisLimits limits = random_limits(random);
  const double reach = 0.99 * std::sqrt(2.0 * limits.j * std::min(-limits.v_lo, limits.v_hi));
  limits.a_up = std::min(limits.a_up, reach);
  limits.a_dn = std::min(limits.a_dn, reach);
  return limits;
}

struct Mirror {
  double side;
  AxisState operator()(const AxisState& s) const { return {side * s.p, side * s.v, side * s.a}; }
  AxisLimits operator()(const AxisLimits& l) const {
    return side > 0.0 ? l : AxisLimits{-l.v_hi, -l.v_lo, l.a_up, l.a_dn, l.j};
  }
};

double between_inside(AxisRandom& random, double lo, double hi) {
  return random.one_in(4) ? (random.one_in(2) ? lo : hi) : random.between(1.2 * lo, 1.2 * hi);
}

// Proves MOT-4.

void a_state_whose_direct_stop_stays_inside_stays_inside_at_no_loss(void**) {
  AxisRandom random;
  int tried = 0;
  for (int i = 0; i < 40000; ++i) {
    const AxisLimits limits = random_limits(random);
    const AxisState from = random_inside(random, limits);
    const AxisRange stop = stop_range(from, limits);
    const double way = random.one_in(3) ? 0.0 : random.decades(-6, 1);
    const double lo = stop.lowest - (random.one_in(3) ? 0.0 : way), hi = stop.highest + way;
    if (!(lo < hi)) continue;
    ++tried;
    const double p = random.between(lo - way, hi + way), end = std::clamp(p, lo, hi);
    const AxisPlan plan = plan_inside(from, p, limits, lo, hi);
    assert_lawful(plan, from, {end, 0.0}, limits, limits);
    const Judged judged = judge(plan, from, limits.j);
    assert_true(excess(judged.p_lo, judged.p_hi, lo, hi) <= 1e-9);
    assert_true(plan.duration() == plan_to(from, end, 0.0, limits).duration());
  }
  assert_true(tried > 30000);
}

void a_state_that_full_braking_keeps_inside_stays_inside(void**) {
  AxisRandom random;
  int tried = 0;
  for (int i = 0; i < 40000; ++i) {
    const AxisLimits limits = modest_limits(random);
    const AxisState from = random_inside(random, limits);
    const double stop = stop_range(from, limits).highest;
    if (!(from.v > 0.0 && run_out(from, limits.j) >= limits.v_lo)) continue;
    const double brake = highest_of_full_brake(from, limits);
    if (!(stop > brake + 1e-9)) continue;
    ++tried;
    const double hi = brake + random.between(1e-3, 1.0) * (stop - brake);
    const double lo = from.p - 100.0 * (1.0 + std::abs(limits.v_lo / limits.a_up * limits.v_lo));
    const double p = random.between(from.p - 1.0, hi + 1.0);
    const Mirror mirror{random.sign()};
    const AxisState seen = mirror(from);
    const AxisLimits seen_limits = mirror(limits);
    const double range[2] = {mirror.side * lo, mirror.side * hi};
    const double least = std::min(range[0], range[1]), most = std::max(range[0], range[1]);
    AxisPlan plan = plan_inside(seen, mirror.side * p, seen_limits, least, most);
    const double end = std::clamp(mirror.side * p, least, most);
    assert_lawful(plan, seen, {end, 0.0}, seen_limits, seen_limits);
    Judged judged = judge(plan, seen, limits.j);
    assert_true(judged.p_lo >= least - 1e-9 && judged.p_hi <= most + 1e-9);
    if (!stretch(plan, seen, end, 0.0, seen_limits, 1.5 * plan.duration())) continue;
    judged = judge(plan, seen, limits.j);
    assert_true(judged.p_lo >= least - 1e-9 && judged.p_hi <= most + 1e-9);
  }
  assert_true(tried > 1000);
}

void what_cannot_be_kept_is_exceeded_no_further_than_by_the_direct_stop(void**) {
  AxisRandom random;
  for (int i = 0; i < 40000; ++i) {
    const AxisLimits limits = modest_limits(random);
    const AxisState from = random_inside(random, limits);
    const AxisRange stop = stop_range(from, limits);
    const double width = random.decades(-4, 0);
    const double lo = from.p - width * random.between(-1.0, 1.0), hi = lo + width;
    const AxisPlan plan = plan_inside(from, random.between(lo, hi), limits, lo, hi);
    const Judged judged = judge(plan, from, limits.j);
    assert_true(plan.duration() >= 0.0);
    assert_true(judged.p_hi <= std::max(hi, stop.highest) + 1e-9);
    assert_true(judged.p_lo >= std::min(lo, stop.lowest) - 1e-9);
    assert_true(excess(judged.v_lo, judged.v_hi, limits.v_lo, limits.v_hi) <= 1e-9);
  }
}

/// Plans again every cycle. The target jumps every 1 to 50 cycles, sometimes onto the limits and
/// beyond; at the end it stays, and the axis must reach it.
void run_jumping_target(AxisRandom& random, const AxisLimits& l, double period, double range) {
  AxisState s;
  double target = 0.0;
  int until_jump = 0;
  for (int cycle = 0; cycle < 6000; ++cycle) {
    if (until_jump-- == 0) {
      target = between_inside(random, -range, range);
      until_jump = static_cast<int>(random.between(0.0, 50.0));
    }
    const AxisState next = plan_inside(s, target, l, -range, range).at(period);
    assert_true(std::abs(next.p) <= range + 1e-9);
    assert_true(excess(next.v, next.v, l.v_lo, l.v_hi) <= 1e-9);
    assert_true(excess(next.a, next.a, -l.a_dn, l.a_up) <= 1e-9);
    assert_true(std::abs(next.a - s.a) <= l.j * period * (1.0 + 1e-9));
    ASSERT_NEAR(next.p - s.p, 0.5 * period * (next.v + s.v), l.j * period * period * period / 6.0);
    s = next;
  }
  const double left = plan_inside(s, 0.3 * range, l, -range, range).duration();
  for (int cycle = 0; cycle * period <= left; ++cycle)
    s = plan_inside(s, 0.3 * range, l, -range, range).at(period);
  assert_true(s.p == 0.3 * range && s.v == 0.0 && s.a == 0.0);
}

void position_limits_hold_however_the_target_jumps(void**) {
  AxisRandom random;
  for (double period : {0.001, 0.002, 0.008}) {
    for (double range : {2.8, 0.1, 1e-3}) {
      run_jumping_target(random, {-2.175, 2.175, 7.5, 7.5, 3750.0}, period, range);
      run_jumping_target(random, {-2.1, 2.1, 15.0, 15.0, 200.0}, period, range);
      run_jumping_target(random, {-0.5, 2.0, 5.0, 20.0, 500.0}, period, range);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_state_whose_direct_stop_stays_inside_stays_inside_at_no_loss),
      cmocka_unit_test(a_state_that_full_braking_keeps_inside_stays_inside),
      cmocka_unit_test(what_cannot_be_kept_is_exceeded_no_further_than_by_the_direct_stop),
      cmocka_unit_test(position_limits_hold_however_the_target_jumps),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
