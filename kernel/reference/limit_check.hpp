// What it means to exceed a limit, the same for every space.
#pragma once

#include "kernel/reference/peaks.hpp"
#include "kernel/reference/polynomial.hpp"
#include "kernel/reference/verdict.hpp"

namespace tactus {

/// Numbers in a file are rounded to some ten digits; a limit reached exactly must not be refused
/// for that.
inline constexpr double kLimitRounding = 1e-9;
/// Largest velocity or acceleration that still counts as standing, in SI units.
inline constexpr double kRest = 1e-6;

/// True for NaN. [any]
inline bool exceeds(double value, double limit) {
  return !(value <= limit + kLimitRounding);
}

/// Judges a magnitude against its limit. [any]
inline Verdict at_most(double value, double limit, Status status, int axis) {
  return exceeds(value, limit) ? Verdict{status, -1, axis, value, limit} : Verdict{};
}

/// The first channel of `peaks` beyond `limits`, if there is one; channels are `size` axes apart.
/// [any]
template <int n>
Verdict judge(const MotionPeaks<n>& peaks, const MotionPeaks<n>& limits, int size) {
  Verdict verdict;
  for (std::size_t c = 0; verdict.ok() && c < peaks.v.size(); ++c) {
    const int axis = size * static_cast<int>(c);
    verdict = at_most(peaks.v[c], limits.v[c], Status::kVelocityLimit, axis);
    if (verdict.ok()) verdict = at_most(peaks.a[c], limits.a[c], Status::kAccelerationLimit, axis);
    if (verdict.ok()) verdict = at_most(peaks.j[c], limits.j[c], Status::kJerkLimit, axis);
  }
  return verdict;
}

}  // namespace tactus
