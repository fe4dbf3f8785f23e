// Exponential function, with the same bits on every machine: no library function, no table, no
// loop. Needs IEEE double arithmetic in round-to-nearest and -ffp-contract=off.
//
// x = n ln 2 + r with |r| <= ln(2)/2; r is kept as the sum of two doubles (Cody and Waite, Software
// Manual for the Elementary Functions, 1980, with ln 2 in two pieces). On the small interval the
// function is a polynomial; n goes to the exponent.
#pragma once

#include <limits>

#include "kernel/math/sincos.hpp"  // bits_of, double_of

namespace tactus {

/// Below the first e^x counts as zero, above the second as infinity; between them it is normal.
inline constexpr double kExponentialMin = -708.0, kExponentialMax = 709.0;

/// Returns e^(r + r_low) - 1 for |r| <= ln(2)/2. Near-minimax coefficients (relative error of r +
/// r^2/2 + r^3 P(r), levelled at Chebyshev points), error 2^-58.9 before rounding; they are close
/// to 1/3!, 1/4!, 1/5!, ...
inline double exponential_minus_one(double r, double r_low) {
  double p = 0x1.20fcad730df14p-29;
  p = 0x1.af4c5b13e680fp-26 + r * p;
  p = 0x1.27e40bd1175ebp-22 + r * p;
  p = 0x1.71de02da088b4p-19 + r * p;
  p = 0x1.a01a01f182213p-16 + r * p;
  p = 0x1.a01a01abba13fp-13 + r * p;
  p = 0x1.6c16c16c0bba7p-10 + r * p;
  p = 0x1.1111111110123p-7 + r * p;
  p = 0x1.5555555555564p-5 + r * p;
  p = 0x1.5555555555557p-3 + r * p;
  return r + (r_low + r * r * (0.5 + r * p));
}

/// Returns e^x within 0.9 units in the last place (largest of 1e7 measured: 0.86) for
/// kExponentialMin <= x <= kExponentialMax; zero below, infinity above, NaN for NaN. [any]
inline double exponential(double x) {
  constexpr double kOneOverLn2 = 0x1.71547652b82fep+0;
  constexpr double kLn2 = 0x1.62e42fefa3800p-1;  // 42 bits: n times it is exact, |n| < 2^11
  constexpr double kLn2Low = 0x1.ef35793c76730p-45;
  constexpr double kRounder = 0x1.8p52;  // adding it rounds to an integer, which the last bits hold
  constexpr std::uint64_t kExponentBias = 1023;

  if (!(x >= kExponentialMin)) return x < kExponentialMin ? 0.0 : x;
  if (x > kExponentialMax) return std::numeric_limits<double>::infinity();
  const double shifted = x * kOneOverLn2 + kRounder;
  const double n = shifted - kRounder;
  const double a = x - n * kLn2;  // exact
  const double w = n * kLn2Low;
  const double r = a - w;
  const double r_low = (a - r) - w;
  const double scale = double_of((bits_of(shifted) + kExponentBias) << 52);  // 2^n
  return scale * (1.0 + exponential_minus_one(r, r_low));
}

/// Returns (1 - e^-x) / x for x >= 0, the mean of e^-t over 0 <= t <= x; one at zero. Within 3
/// units in the last place (largest of 1e7 measured: 2.49). [any]
inline double mean_decay(double x) {
  constexpr double kHalfLn2 = 0x1.62e42fefa39efp-2;
  if (x == 0.0) return 1.0;
  return x <= kHalfLn2 ? exponential_minus_one(-x, 0.0) / -x : (1.0 - exponential(-x)) / x;
}

}  // namespace tactus
