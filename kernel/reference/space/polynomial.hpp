// Polynomials of a segment: up to fifth order, through the values given at both ends, with their
// bounds and exact extrema.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "kernel/core/vectors.hpp"
#include "kernel/reference/space/interpolation.hpp"

namespace tactus {

/// c[0] + c[1] t + ... + c[5] t^5 with numbers or vectors as coefficients.
template <class Value>
struct PolynomialOf {
  static constexpr int kOrder = 5;
  static constexpr std::size_t kSize = kOrder + 1;

  std::array<Value, kSize> c = zeros();

  /// Returns the value at t. [any]
  Value at(double t) const {
    Value value = c[kOrder];
    for (std::size_t i = kOrder; i-- > 0;) value = value * t + c[i];
    return value;
  }
  /// Returns the derivative with respect to t. [any]
  PolynomialOf derivative() const {
    PolynomialOf d;
    for (std::size_t i = 1; i < kSize; ++i) d.c[i - 1] = static_cast<double>(i) * c[i];
    return d;
  }
  /// Returns the same polynomial with t counted from `begin`, by Horner's rule with the remainders
  /// kept. [any]
  PolynomialOf from(double begin) const { return {counted_from(begin)}; }

 private:
  std::array<Value, kSize> counted_from(double begin) const {
    std::array<Value, kSize> moved;
    for (int axis = 0; axis < size(c[0]); ++axis) {
      std::array<double, kSize> one;
#pragma GCC unroll 6
      for (std::size_t i = 0; i < kSize; ++i) one[i] = number(c[i], axis);
#pragma GCC unroll 5
      for (std::size_t i = 0; i < kOrder; ++i) {
#pragma GCC unroll 5
        for (std::size_t k = kOrder; k > i; --k) one[k - 1] += begin * one[k];
      }
#pragma GCC unroll 6
      for (std::size_t i = 0; i < kSize; ++i) number(moved[i], axis) = one[i];
    }
    return moved;
  }
  static constexpr int size(double) {
    return 1;
  }
  static double& number(double& value, int) {
    return value;
  }
  static double number(const double& value, int) {
    return value;
  }
  template <class Vector>
  static constexpr int size(const Vector&) {
    return Vector::SizeAtCompileTime;
  }
  template <class Vector>
  static double& number(Vector& value, int axis) {
    return value[axis];
  }
  template <class Vector>
  static double number(const Vector& value, int axis) {
    return value[axis];
  }
  static std::array<Value, kSize> zeros() {
    std::array<Value, kSize> all;
    if constexpr (std::is_arithmetic_v<Value>)
      all.fill(0.0);
    else
      all.fill(Value::Zero());
    return all;
  }
};
using Polynomial = PolynomialOf<double>;
using VectorPolynomial = PolynomialOf<Vector3>;

/// Returns one axis of a polynomial of vectors. [any]
template <class Value>
Polynomial axis_of(const PolynomialOf<Value>& path, int i) {
  Polynomial axis;
  for (std::size_t k = 0; k < axis.c.size(); ++k) axis.c[k] = path.c[k][i];
  return axis;
}

/// Position and its first two derivatives at one end of a segment.
template <class Value>
struct BoundaryOf {
  Value p{}, v{}, a{};
};
using Boundary = BoundaryOf<double>;

/// Returns the line from p to p in T > 0 seconds. [any]
template <class Value>
PolynomialOf<Value> linear(const BoundaryOf<Value>& from, const BoundaryOf<Value>& to, double T) {
  PolynomialOf<Value> line;
  line.c[0] = from.p;
  line.c[1] = (to.p - from.p) / T;
  return line;
}

/// Returns the Hermite cubic with p and v at both ends, T > 0 in seconds. [any]
template <class Value>
PolynomialOf<Value> cubic(const BoundaryOf<Value>& from, const BoundaryOf<Value>& to, double T) {
  PolynomialOf<Value> path;
  const Value d = to.p - from.p;
  path.c[0] = from.p;
  path.c[1] = from.v;
  path.c[2] = (3.0 * d - (2.0 * from.v + to.v) * T) / (T * T);
  path.c[3] = (-2.0 * d + (from.v + to.v) * T) / (T * T * T);
  return path;
}

/// Returns the Hermite quintic with p, v and a at both ends, T > 0 in seconds. [any]
template <class Value>
PolynomialOf<Value> quintic(const BoundaryOf<Value>& from, const BoundaryOf<Value>& to, double T) {
  const double T2 = T * T, T3 = T2 * T;
  const Value d = to.p - from.p;
  return {{from.p, from.v, 0.5 * from.a,
           (20.0 * d - (8.0 * to.v + 12.0 * from.v) * T - (3.0 * from.a - to.a) * T2) / (2.0 * T3),
           (-30.0 * d + (14.0 * to.v + 16.0 * from.v) * T + (3.0 * from.a - 2.0 * to.a) * T2) /
               (2.0 * T2 * T2),
           (12.0 * d - 6.0 * (to.v + from.v) * T - (from.a - to.a) * T2) / (2.0 * T2 * T3)}};
}

/// Returns the polynomial of the given order: kLinear, kCubic or kQuintic. [any]
template <class Value>
PolynomialOf<Value> join(Interpolation order, const BoundaryOf<Value>& from,
                         const BoundaryOf<Value>& to, double T) {
  return order == Interpolation::kLinear  ? linear(from, to, T)
         : order == Interpolation::kCubic ? cubic(from, to, T)
                                          : quintic(from, to, T);
}

struct Extremes {
  double min, max;
};

/// Returns quick outer bounds on [0, T]: the least and the greatest Bernstein coefficient. [any]
Extremes hull(const Polynomial& polynomial, double T);

/// Returns the smallest and largest value on [0, T], exact to rounding: the stationary points are
/// bracketed by those of the next derivative, down to a parabola, and found by a fixed number of
/// bisections. NaN coefficients give NaN. [any]
Extremes extremes(const Polynomial& polynomial, double T);

}  // namespace tactus
