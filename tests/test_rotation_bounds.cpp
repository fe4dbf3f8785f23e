// The bounds of a rotation segment: nothing that dense sampling shows is beyond them, and they are
// hardly above it.
#include <algorithm>
#include <cmath>

#include "kernel/reference/rotation_segment.hpp"
#include "tests/rotation_cases.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr double kRate = 3.0;  ///< of the ends, in radians per duration about each axis

/// The largest at many times; the jerk is the difference quotient of alpha.
RotationSegment::Bounds sampled(const RotationSegment& segment) {
  constexpr int kSamples = 1000;
  const double T = segment.duration();
  RotationSegment::Bounds most = {0.0, 0.0, 0.0};
  for (int k = 0; k <= kSamples; ++k) {
    const RotationBoundary now = segment.at(T * k / kSamples);
    most.w = std::max(most.w, now.w.norm());
    most.alpha = std::max(most.alpha, now.alpha.norm());
  }
  const double h = 0.01 / std::max({most.w, std::sqrt(most.alpha), 20.0 / T});
  for (int k = 0; k <= kSamples; ++k) {
    const double t = 4.0 * h + (T - 8.0 * h) * k / kSamples;
    const auto alpha = [&](double dt) { return segment.at(t + dt).alpha; };
    most.jerk = std::max(most.jerk, first_derivative(alpha, h).norm());
  }
  return most;
}

// Proves RG-6, RG-10.

void no_velocity_acceleration_or_jerk_is_beyond_the_bounds(void**) {
  for (const double rate : {0.0, kRate, 30.0, 300.0}) {
    over_segments(rate, [rate](const RotationSegment& segment) {
      const RotationSegment::Bounds most = segment.bounds(), seen = sampled(segment);
      const double rounding = 1e-13 * (1.0 + rate) / segment.duration();
      assert_true(seen.w <= most.w + rounding);
      const double faster = 10.0 * (1.0 + rate) / segment.duration();
      assert_true(seen.alpha <= most.alpha + faster * rounding);
      assert_true(seen.jerk <= most.jerk + 100.0 * faster * faster * rounding);
    });
  }
}

/// Largest factor between the bounds and what is sampled.
RotationSegment::Bounds looseness(double rate) {
  RotationSegment::Bounds worst = {1.0, 1.0, 1.0};
  over_segments(rate, [&worst](const RotationSegment& segment) {
    const RotationSegment::Bounds most = segment.bounds(), seen = sampled(segment);
    const double T = segment.duration();
    if (seen.w * T > 1e-6) worst.w = std::max(worst.w, most.w / seen.w);
    if (seen.alpha * T * T > 1e-6) worst.alpha = std::max(worst.alpha, most.alpha / seen.alpha);
    if (seen.jerk * T * T * T > 1e-6) worst.jerk = std::max(worst.jerk, most.jerk / seen.jerk);
  });
  print_message("rate %g: bounds at most %.3f (w) %.3f (alpha) %.3f (jerk) times what occurs\n",
                rate, worst.w, worst.alpha, worst.jerk);
  return worst;
}

void the_bounds_are_close(void**) {
  const RotationSegment::Bounds rest = looseness(0.0), moving = looseness(kRate);
  assert_true(rest.w < 1.02 && rest.alpha < 1.02 && rest.jerk < 1.05);
  assert_true(moving.w < 1.02 && moving.alpha < 1.05 && moving.jerk < 1.15);
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
