// What it means to exceed a limit, the same for every space.
#pragma once

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

/// Judges the range of one polynomial on [0, T] against lo and hi, both of which it may touch.
/// [any]
inline Verdict bounded(const Polynomial& polynomial, double T, double lo, double hi, Status status,
                       int axis) {
  const Extremes outer = hull(polynomial, T);
  if (outer.max <= hi && outer.min >= lo) return {};
  const Extremes found = extremes(polynomial, T);
  if (exceeds(found.max, hi)) return {status, -1, axis, found.max, hi};
  if (exceeds(-found.min, -lo)) return {status, -1, axis, found.min, lo};
  return {};
}

}  // namespace tactus
