// The bounds of a rotation segment: no dense sample exceeds them, and they are close to the
// samples.
#include <algorithm>
#include <cmath>

#include "kernel/reference/space/rotation_segment.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kRate = 3.0;  ///< of the ends, in radians per duration about each axis

/// Returns the largest values at many times; the jerk is the difference quotient of alpha.
VectorBounds sampled(const RotationSegment& segment) {
  constexpr int kSamples = 1000;
  const double T = segment.duration();
  VectorBounds most = {0.0, 0.0, 0.0};
  for (int k = 0; k <= kSamples; ++k) {
    const RotationBoundary now = segment.at(T * k / kSamples);
    most.v = std::max(most.v, now.w.norm());
    most.a = std::max(most.a, now.alpha.norm());
  }
  const double h = 0.01 / std::max({most.v, std::sqrt(most.a), 20.0 / T});
  for (int k = 0; k <= kSamples; ++k) {
    const double t = 4.0 * h + (T - 8.0 * h) * k / kSamples;
    const auto alpha = [&](double dt) { return segment.at(t + dt).alpha; };
    most.j = std::max(most.j, first_derivative(alpha, h).norm());
  }
  return most;
}

// Proves RG-6, RG-10.

void no_velocity_acceleration_or_jerk_is_beyond_the_bounds(void**) {
  for (const double rate : {0.0, kRate, 30.0, 300.0}) {
    over_segments(rate, [rate](const RotationSegment& segment) {
      const VectorBounds seen = sampled(segment);
      const double rounding = 1e-13 * (1.0 + rate) / segment.duration();
      const double faster = 10.0 * (1.0 + rate) / segment.duration();
      for (const Care care : {Care::kQuick, Care::kClose, Care::kFine}) {
        const VectorBounds most = segment.bounds(care);
        assert_true(seen.v <= most.v + rounding);
        assert_true(seen.a <= most.a + faster * rounding);
        assert_true(seen.j <= most.j + 100.0 * faster * faster * rounding);
      }
    });
  }
}

/// Returns the largest ratios of bounds to samples.
VectorBounds looseness(double rate, Care care) {
  VectorBounds worst = {1.0, 1.0, 1.0};
  over_segments(rate, [&worst, care](const RotationSegment& segment) {
    const VectorBounds most = segment.bounds(care), seen = sampled(segment);
    const double T = segment.duration();
    if (seen.v * T > 1e-6) worst.v = std::max(worst.v, most.v / seen.v);
    if (seen.a * T * T > 1e-6) worst.a = std::max(worst.a, most.a / seen.a);
    if (seen.j * T * T * T > 1e-6) worst.j = std::max(worst.j, most.j / seen.j);
  });
  print_message("rate %g: bounds at most %.3f (w) %.3f (alpha) %.3f (jerk) times what occurs\n",
                rate, worst.v, worst.a, worst.j);
  return worst;
}

void the_bounds_are_close(void**) {
  const VectorBounds rest = looseness(0.0, Care::kFine), moving = looseness(kRate, Care::kFine);
  assert_true(rest.v < 1.02 && rest.a < 1.02 && rest.j < 1.05);
  assert_true(moving.v < 1.02 && moving.a < 1.05 && moving.j < 1.15);
  const VectorBounds at_rest = looseness(0.0, Care::kClose),
                     in_motion = looseness(kRate, Care::kClose);
  assert_true(at_rest.v < 1.02 && at_rest.a < 1.05 && at_rest.j < 1.12);
  assert_true(in_motion.v < 1.05 && in_motion.a < 1.2 && in_motion.j < 1.4);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_velocity_acceleration_or_jerk_is_beyond_the_bounds),
      cmocka_unit_test(the_bounds_are_close),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
