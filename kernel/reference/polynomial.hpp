// Polynomials of a segment: up to fifth order, through the values given at both ends, and their
// exact extrema.
#pragma once

#include <array>

namespace tactus {

/// c[0] + c[1] t + ... + c[5] t^5.
struct Polynomial {
  static constexpr int kOrder = 5;
  std::array<double, kOrder + 1> c{};

  /// Value at t. [any]
  double at(double t) const {
    double value = c[kOrder];
    for (int i = kOrder - 1; i >= 0; --i) value = value * t + c[static_cast<std::size_t>(i)];
    return value;
  }
  /// Derivative with respect to t. [any]
  Polynomial derivative() const {
    Polynomial d;
    for (int i = 1; i <= kOrder; ++i) {
      d.c[static_cast<std::size_t>(i - 1)] = i * c[static_cast<std::size_t>(i)];
    }
    return d;
  }
  /// The same counted from t = begin. [any]
  Polynomial from(double begin) const;
};

/// Position and its first two derivatives at one end of a segment.
struct Boundary {
  double p = 0.0, v = 0.0, a = 0.0;
};

/// From p to p in T > 0 seconds at constant velocity. [any]
Polynomial linear(const Boundary& from, const Boundary& to, double T);
/// Cubic Hermite: p and v at both ends. [any]
Polynomial cubic(const Boundary& from, const Boundary& to, double T);
/// Quintic Hermite: p, v and a at both ends. [any]
Polynomial quintic(const Boundary& from, const Boundary& to, double T);

struct Extremes {
  double min, max;
};

/// A quick bound from outside: the Bernstein coefficients, between which the polynomial stays on
/// [0, T]. [any]
Extremes hull(const Polynomial& polynomial, double T);

/// Smallest and largest value on [0, T]. Exact to rounding: the stationary points are bracketed by
/// those of the next derivative, down to a straight line, and found by a fixed number of
/// bisections. NaN coefficients give NaN. [any]
Extremes extremes(const Polynomial& polynomial, double T);

}  // namespace tactus
