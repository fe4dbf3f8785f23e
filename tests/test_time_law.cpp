// The time law: rates are reached within their bounds, exactly, and never overshoot.
#include "kernel/reference/time_law.hpp"
#include "tests/reference_bench.hpp"
#include "tests/testing.hpp"

namespace {

using namespace tactus;

constexpr RateBounds kBounds = {2.0, 20.0};

// Proves RG-11.

void at_rate_one_path_time_is_time(void**) {
  TimeLaw law;
  law.start(1.0);
  for (int k = 0; k < 1000; ++k) law.advance(1e-3);
  ASSERT_NEAR(law.s(), 1.0, 1e-12);
  assert_true(law.rate() == 1.0 && law.slope() == 0.0);
}

void a_stop_takes_the_time_of_a_bounded_double_integrator(void**) {
  TimeLaw law;
  law.start(1.0);
  law.plan(0.0, kBounds);
  // 1 = slope * (T - slope / curvature), hence T = 0.6 s; the way is half of it by symmetry.
  law.advance(0.3);
  ASSERT_NEAR(law.rate(), 0.5, 1e-12);
  ASSERT_NEAR(law.slope(), -2.0, 1e-12);
  law.advance(0.3 - 1e-9);
  assert_false(law.standing());
  law.advance(2e-9);
  assert_true(law.standing());
  ASSERT_NEAR(law.s(), 0.3, 1e-8);
}

void a_small_change_never_reaches_the_largest_slope(void**) {
  TimeLaw law;
  law.start(1.0);
  law.plan(0.95, kBounds);
  law.advance(0.05);  // half of 2 sqrt(0.05 / 20)
  ASSERT_NEAR(law.rate(), 0.975, 1e-12);
  ASSERT_NEAR(law.slope(), -1.0, 1e-12);
  law.advance(0.05);
  ASSERT_NEAR(law.rate(), 0.95, 1e-12);
}

void the_path_that_a_stop_still_takes_is_known_beforehand(void**) {
  TimeLaw law;
  law.start(1.0);
  law.plan(0.4, kBounds);
  law.advance(0.1);
  const double before = law.s(), way = law.stopping_s(kBounds);
  law.plan(0.0, kBounds);
  while (!law.standing()) law.advance(1e-3);
  ASSERT_NEAR(law.s() - before, way, 1e-12);
}

void whenever_the_target_changes_the_bounds_hold(void**) {
  Random random{11};
  TimeLaw law;
  law.start(1.0);
  constexpr double kDt = 1e-3;
  for (int k = 0; k < 1000000; ++k) {
    if (random.below(200) == 0) {
      const bool stop = random.below(3) == 0;
      law.plan(stop ? 0.0 : random.uniform(0.0, 1.0), kBounds);
    }
    const double s = law.s(), rate = law.rate(), slope = law.slope();
    law.advance(kDt);
    assert_true(law.rate() >= -1e-12 && law.rate() <= 1.0 + 1e-12 && law.s() >= s);
    assert_true(std::abs(law.slope()) <= kBounds.slope * (1.0 + 1e-12));
    ASSERT_NEAR(law.slope(), slope, kBounds.curvature * kDt * (1.0 + 1e-9));
    ASSERT_NEAR(law.rate(), rate + 0.5 * kDt * (slope + law.slope()),
                kBounds.curvature * kDt * kDt);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_rate_one_path_time_is_time),
      cmocka_unit_test(a_stop_takes_the_time_of_a_bounded_double_integrator),
      cmocka_unit_test(a_small_change_never_reaches_the_largest_slope),
      cmocka_unit_test(the_path_that_a_stop_still_takes_is_known_beforehand),
      cmocka_unit_test(whenever_the_target_changes_the_bounds_hold),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
