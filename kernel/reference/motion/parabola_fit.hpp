// The parabola that fits four points best.
#pragma once

#include <array>
#include <cstddef>

namespace tactus {

inline constexpr int kFitted = 4;

/// Weights of points, whose sum is the parabola's value and derivatives at the first point.
struct ParabolaFit {
  std::array<double, kFitted> x, dx, ddx;
};

/// Returns the weights of points at the times t, s, of which no two are equal, for the least sum of
/// squares: by polynomials that are orthogonal over the times, 1, u = t - mean(t) and
/// w = u^2 - (sum u^3 / sum u^2) u - mean(u^2). [any]
ParabolaFit fit_parabola(const std::array<double, kFitted>& t);

}  // namespace tactus
