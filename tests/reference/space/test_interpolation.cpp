// Interpolation between waypoints by the fields that are given, at any period.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kCubic = kVelocityField;
constexpr Fields kQuintic = kVelocityField | kAccelerationField;

// Proves RG-2.

void positions_alone_are_joined_by_straight_lines(void**) {
  static ReferenceBench bench;
  assert_true(bench.go(0.5, 1.0, 0) != 0);
  ASSERT_OK(bench.run(501));  // the first of these puts out t = 0
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.25, 1e-12);
  ASSERT_NEAR(bench.out().dq[0], 0.5, 1e-12);
  ASSERT_NEAR(bench.out().ddq[0], 0.0, 0.0);
}

void positions_and_velocities_are_joined_by_cubics(void**) {
  static ReferenceBench bench;
  assert_true(bench.go(0.5, 1.0, kCubic) != 0);
  ASSERT_OK(bench.run(251));
  // d (3 s^2 - 2 s^3) at s = 1/4: 0.15625 d, with velocity 6 d s (1 - s) and acceleration 6 d (1 -
  // 2 s).
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.15625 * 0.5, 1e-12);
  ASSERT_NEAR(bench.out().dq[0], 1.125 * 0.5, 1e-12);
  ASSERT_NEAR(bench.out().ddq[0], 3.0 * 0.5, 1e-12);
}

void accelerations_too_are_joined_by_quintics(void**) {
  static ReferenceBench bench;
  assert_true(bench.go(0.5, 1.0, kQuintic) != 0);
  ASSERT_OK(bench.run(251));
  // d (10 s^3 - 15 s^4 + 6 s^5) at s = 1/4.
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.103515625 * 0.5, 1e-12);
  ASSERT_NEAR(bench.out().dq[0], 1.0546875 * 0.5, 1e-12);
  ASSERT_NEAR(bench.out().ddq[0], 5.625 * 0.5, 1e-12);
}

// Proves RG-8.

void the_reference_does_not_depend_on_the_period(void**) {
  static ReferenceBench coarse, fine;
  assert_true(coarse.go(0.5, 1.0, kQuintic) != 0 && fine.go(0.5, 1.0, kQuintic) != 0);
  ASSERT_OK(coarse.step());
  ASSERT_OK(fine.step());
  fine.period_s = 0.5e-3;
  for (int k = 0; k < 1200; ++k) {
    ASSERT_OK(coarse.step());
    ASSERT_OK(fine.step());
    ASSERT_OK(fine.step());
    ASSERT_NEAR(coarse.out().q[0], fine.out().q[0], 1e-12);
    ASSERT_NEAR(coarse.out().dq[0], fine.out().dq[0], 1e-11);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(positions_alone_are_joined_by_straight_lines),
      cmocka_unit_test(positions_and_velocities_are_joined_by_cubics),
      cmocka_unit_test(accelerations_too_are_joined_by_quintics),
      cmocka_unit_test(the_reference_does_not_depend_on_the_period),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
