// Comparison of values with limits, the same in every space.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/peaks.hpp"
#include "kernel/reference/space/polynomial.hpp"

namespace tactus {

/// Numbers in a file are rounded to about ten digits; a value that reaches its limit exactly must
/// not be refused for that.
inline constexpr double kLimitRounding = 1e-9;
/// Largest velocity that still counts as rest, rad/s or m/s.
inline constexpr double kRestRounding = 1e-6;

/// True if the value is above the limit by more than rounding, or NaN. [any]
inline bool exceeds(double value, double limit) {
  return !(value <= limit + kLimitRounding);
}

/// How far beyond a range a point may be to be held at its end, rad or m; farther out it is
/// refused.
inline constexpr double kMostSaturated = 0.1;

/// Moves a position that is beyond a range, and by at most kMostSaturated, to the end of the range,
/// at rest or on its way inwards: kSaturated. [cyclic]
inline Verdict saturate(double& position, double& velocity, double lowest, double highest,
                        int axis) {
  const double given = position, held = std::clamp(given, lowest, highest);
  if (!exceeds(std::abs(given - held), 0.0) || exceeds(std::abs(given - held), kMostSaturated))
    return {};
  position = held;
  velocity = held < given ? std::min(velocity, 0.0) : std::max(velocity, 0.0);
  return {Status::kSaturated, -1, axis, given, held};
}

/// Judges a magnitude against its limit. [any]
inline Verdict at_most(double value, double limit, Status status, int axis) {
  return exceeds(value, limit) ? Verdict{status, -1, axis, value, limit} : Verdict{};
}

/// Judges `peaks` against `limits` and returns the violation of the first channel that has one. The
/// axis of channel c is size * c. [any]
template <int n>
Verdict judge(const MotionPeaks<n>& peaks, const MotionPeaks<n>& limits, int size) {
  for (std::size_t c = 0; c < peaks.v.size(); ++c) {
    const int axis = size * static_cast<int>(c);
    if (exceeds(peaks.v[c], limits.v[c]))
      return {Status::kVelocityLimit, -1, axis, peaks.v[c], limits.v[c]};
    if (exceeds(peaks.a[c], limits.a[c]))
      return {Status::kAccelerationLimit, -1, axis, peaks.a[c], limits.a[c]};
    if (exceeds(peaks.j[c], limits.j[c]))
      return {Status::kJerkLimit, -1, axis, peaks.j[c], limits.j[c]};
  }
  return {};
}

}  // namespace tactus
