// Angle of a point of the plane, with the same bits on every machine: no library function, no
// table, no loop. Needs IEEE double arithmetic in round-to-nearest and -ffp-contract=off.
//
// The point is folded into the octant 0 <= y <= x and, if it is above the ray at pi/8, turned by
// -pi/4 (its tangent is then (y - x) / (y + x)). The arctangent of the remaining t, |t| <=
// tan(pi/8), is an odd polynomial; the multiple of pi/4 and the sign undo the folding. The quotient
// and the multiple of pi/4 are sums of two doubles, so that only the last addition rounds. The
// exact sums and products are Knuth's and Dekker's (Muller et al., Handbook of Floating-Point
// Arithmetic, 2nd edition, sections 4.3 and 4.4).
#pragma once

#include <cstdint>

#include "kernel/math/sincos.hpp"  // bits_of, double_of

namespace tactus {

/// A number as the sum of two doubles, the second at most half a unit in the last place of the
/// first.
struct DoublePair {
  double value, low;
};

/// Returns a + b, exactly, for |a| >= |b|. [any]
inline DoublePair exact_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns a b, exactly, if nothing over- or underflows. [any]
inline DoublePair exact_product(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double a_shifted = kSplitter * a, b_shifted = kSplitter * b;
  const double a1 = a_shifted - (a_shifted - a), a2 = a - a1;  // the upper and lower 26 bits
  const double b1 = b_shifted - (b_shifted - b), b2 = b - b1;
  const double product = a * b;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// Returns (a.value + a.low) / (b.value + b.low), to about 2^-104. [any]
inline DoublePair quotient(const DoublePair& a, const DoublePair& b) {
  const double t = a.value / b.value;
  const DoublePair product = exact_product(t, b.value);
  const double rest = ((a.value - product.value) - product.low) + (a.low - t * b.low);
  return {t, rest / b.value};
}

/// Returns t - arctangent of t for |t| <= tan(pi/8), with t.low to first order. Minimax
/// coefficients (Remez exchange for the relative error of t - t^3 P(t^2)), error 2^-58.3 before
/// rounding; they are close to 1/3, -1/5, 1/7, ... Even and odd powers of t^2 are summed
/// separately: two short chains instead of a long one.
inline double t_minus_arctangent(const DoublePair& t) {
  const double z = t.value * t.value, zz = z * z;
  const double even = 0x1.5555555555554p-2 +
                      zz * (0x1.249249247568bp-3 +
                            zz * (0x1.745d14b9435c4p-4 +
                                  zz * (0x1.110c724174538p-4 +
                                        zz * (0x1.ab7d4b22340b5p-5 + zz * 0x1.12367dbac403dp-5))));
  const double odd = -0x1.999999999964bp-3 +
                     zz * (-0x1.c71c71b7474acp-4 +
                           zz * (-0x1.3b136e237d72ep-4 +
                                 zz * (-0x1.e171f66963d6dp-5 +
                                       zz * (-0x1.70ec95d506954p-5 + zz * -0x1.f1e5210349900p-7))));
  return z * (t.value * (even + z * odd) + t.low);
}

/// Returns the angle of the point (x, y) from the positive x axis, in [-pi, pi] [rad], with the
/// signs that the C library's atan2 gives for zeros, including zero over zero. The error is within
/// 0.75 units in the last place (largest of 1e7 measured: 0.69, and 0.745 for results close to the
/// smallest normal number). Fails closed: NaN if y or x is not finite. [any]
inline double arctangent(double y, double x) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  constexpr double kTangentOfEighth = 0x1.a827999fcef32p-2;
  constexpr double kQuarterPi = 0x1.921fb54442d18p-1;  // 50 bits: up to four times it is exact
  constexpr double kQuarterPiLow = 0x1.1a62633145c07p-55;

  const std::uint64_t y_bits = bits_of(y), x_bits = bits_of(x);
  const std::uint64_t y_size = y_bits & ~kSign, x_size = x_bits & ~kSign;
  const bool steep = y_size > x_size, behind = (x_bits & kSign) != 0;
  // As bits, NaN is larger than infinity, and both are larger than any number: either of them as
  // `larger` makes the quotient's rest NaN, and so the result.
  const double larger = double_of(steep ? y_size : x_size);
  const double smaller = double_of(steep ? x_size : y_size);

  // Scaled away from the ends of the exponent range, so that the quotient's product loses no part.
  const double scale = larger < 0x1p600 ? 0x1p200 : 0x1p-200;
  const double a = larger == 0.0 ? 1.0 : larger * scale;
  const double b = smaller * scale;
  const bool turned = b > kTangentOfEighth * a;
  const DoublePair difference = exact_sum(-a, b), sum = exact_sum(a, b);
  const DoublePair t =
      quotient(turned ? difference : DoublePair{b, 0.0}, turned ? sum : DoublePair{a, 0.0});

  double multiple = turned ? 1.0 : 0.0;  // of pi/4
  multiple = steep ? 2.0 - multiple : multiple;
  multiple = behind ? 4.0 - multiple : multiple;
  const double sign = steep != behind ? -1.0 : 1.0;
  const DoublePair angle = exact_sum(multiple * kQuarterPi, sign * t.value);
  const double low = multiple * kQuarterPiLow + sign * (t.low - t_minus_arctangent(t));

  return double_of(bits_of(angle.value + (angle.low + low)) | (y_bits & kSign));
}

}  // namespace tactus
