// Tests that the motions of axis_motion.hpp are the shortest: against durations that an independent
// library computed (tests/oracles/otg), and against themselves: no plan from a later state arrives
// earlier.
#include <cstdio>
#include <cstdlib>

#include "tests/math/axis_cases.hpp"

namespace tactus {
namespace {

/// Calls check(numbers) for each row except the first, and returns their number.
template <std::size_t columns, class Check>
int over_rows(const char* path, Check check) {
  std::FILE* file = std::fopen(path, "r");
  assert_non_null(file);
  char line[4096];
  int rows = 0;
  assert_non_null(std::fgets(line, sizeof line, file));
  while (std::fgets(line, sizeof line, file)) {
    std::array<double, columns> numbers;
    char* at = line;
    for (double& number : numbers) {
      number = std::strtod(at, &at);
      ++at;  // the comma
    }
    check(numbers);
    ++rows;
  }
  std::fclose(file);
  return rows;
}

// Proves MOT-1.

void one_axis_takes_as_long_as_the_shortest_motion(void**) {
  const int rows =
      over_rows<9>("tests/oracles/otg/one_axis.csv", [](const std::array<double, 9>& row) {
        const auto [v, a, j, p0, v0, a0, pf, vf, optimum] = row;
        const double duration = plan_to({p0, v0, a0}, pf, vf, {-v, v, a, a, j}).duration();
        assert_true(duration <= 1.001 * optimum);
        assert_true(duration >= 0.999 * optimum);
      });
  assert_int_equal(rows, 1000);
}

void seven_axes_arrive_together_after_the_shortest_motion_of_the_slowest(void**) {
  const int rows =
      over_rows<29>("tests/oracles/otg/fer_seven_axes.csv", [](const std::array<double, 29>& row) {
        const std::size_t axes = kFerAxes.size();
        std::array<AxisPlan, 7> plans;
        double longest = 0.0;
        for (std::size_t i = 0; i < axes; ++i) {
          plans[i] = plan_to({row[i], row[7 + i], row[14 + i]}, row[21 + i], 0.0, kFerAxes[i]);
          longest = std::max(longest, plans[i].duration());
        }
        assert_true(longest <= 1.01 * row[28]);
        assert_true(longest >= 0.999 * row[28]);
        for (std::size_t i = 0; i < axes; ++i) {
          const AxisState from{row[i], row[7 + i], row[14 + i]};
          assert_true(stretch(plans[i], from, row[21 + i], 0.0, kFerAxes[i], longest));
          ASSERT_NEAR(plans[i].duration(), longest, 1e-12 * longest);
          assert_lawful(plans[i], from, {row[21 + i], 0.0}, kFerAxes[i], kFerAxes[i]);
        }
      });
  assert_int_equal(rows, 500);
}

/// The change of an arrival time when a position is rounded by half a unit: a distance d = j
/// (t/2)^3 / 3 or less takes t.
double rounding_of_time(const AxisState& s, double j) {
  return 2.0 * std::cbrt(6e-16 * std::abs(s.p) / j);
}

/// A motion composed at random, as far as it is feasible.
struct Feasible {
  LongState state;
  long double duration = 0;

  void go(long double t, long double jerk) {
    state = state.after(t, jerk);
    duration += t;
  }
  /// Jerk, hold, jerk back to (w, 0).
  void change(long double w, const AxisLimits& l) {
    const long double j = l.j, rest = state.v + state.a * std::abs(state.a) / (2 * j);
    const long double side = w >= rest ? 1 : -1, most = side > 0 ? l.a_up : l.a_dn;
    const long double q = j * side * (w - state.v) + state.a * state.a / 2;
    const long double peak = std::min(most, std::sqrt(q));
    go((peak - side * state.a) / j, side * j);
    if (peak > 0) go((q - peak * peak) / (j * peak), 0);
    go(peak / j, -side * j);
  }
  bool inside(const AxisLimits& l) const {
    const long double rest = state.v + state.a * std::abs(state.a) / (2 * l.j);
    return std::max(state.v, rest) <= l.v_hi && std::min(state.v, rest) >= l.v_lo &&
           state.a <= l.a_up && state.a >= -l.a_dn;
  }
};

/// Half of the states brake, half of those at the limit. For these, jerk up and then down again may
/// be the shortest motion to a target that moves back.
void no_motion_put_together_at_random_is_shorter(void**) {
  AxisRandom random;
  int tried = 0;
  for (int i = 0; i < 100000; ++i) {
    const AxisLimits limits = random_limits(random);
    AxisState from = random_inside(random, limits);
    if (random.one_in(2)) from.a = -std::abs(from.v > 0.0 ? from.a : -from.a);
    if (random.one_in(4)) from.a = from.v > 0.0 ? -limits.a_dn : limits.a_up;
    Feasible motion{{from.p, from.v, from.a}};
    if (!motion.inside(limits)) continue;
    const double ramp = (limits.a_up + limits.a_dn) / limits.j;
    for (int phase = 0; phase < 3 && motion.inside(limits); ++phase)
      if (random.one_in(2))
        motion.go(ramp * random.decades(-3, 0), random.between(-1, 1) > 0 ? limits.j : -limits.j);
    if (!motion.inside(limits)) continue;
    const double v = random.one_in(2) ? 0.0 : random.between(limits.v_lo, limits.v_hi);
    motion.change(v, limits);
    const double p = static_cast<double>(motion.state.p);
    const double duration = static_cast<double>(motion.duration);
    const double tolerance = 1e-7 * duration + rounding_of_time({p, 0.0, 0.0}, limits.j) +
                             rounding_of_time(from, limits.j);
    assert_true(plan_to(from, p, v, limits).duration() <= duration + tolerance);
    ++tried;
  }
  assert_true(tried > 30000);
}

void planning_again_on_the_way_gains_nothing_and_loses_nothing(void**) {
  AxisRandom random;
  for (int i = 0; i < 40000; ++i) {
    const AxisLimits limits = random_limits(random);
    const AxisState from = random_inside(random, limits);
    const AxisTarget target = random_target(random, from, limits);
    const AxisPlan plan = plan_to(from, target.p, target.v, limits);
    const double t = random.between(0.0, 1.0) * plan.duration();
    const AxisPlan again = plan_to(plan.at(t), target.p, target.v, limits);
    const double tolerance = 1e-6 * plan.duration() + rounding_of_time(from, limits.j);
    const double gained = plan.duration() - t - again.duration();
    assert_true(gained <= tolerance);
    if (target.v == 0.0) assert_true(gained >= -10.0 * tolerance);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_axis_takes_as_long_as_the_shortest_motion),
      cmocka_unit_test(seven_axes_arrive_together_after_the_shortest_motion_of_the_slowest),
      cmocka_unit_test(no_motion_put_together_at_random_is_shorter),
      cmocka_unit_test(planning_again_on_the_way_gains_nothing_and_loses_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
