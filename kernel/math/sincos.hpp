// Sine and cosine of one angle, with the same bits on every machine: no library function, no table,
// no branch. Needs IEEE double arithmetic in round-to-nearest and -ffp-contract=off.
//
// x = n pi/2 + r with |r| <= pi/4; r is kept as the sum of two doubles (Cody and Waite, Software
// Manual for the Elementary Functions, 1980, with pi/2 in three pieces). On the small interval sine
// and cosine are polynomials in r^2; the quadrant n mod 4 then exchanges them and sets the signs.
#pragma once

#include <cstdint>
#include <cstring>

namespace tactus {

struct SinCos {
  double sin, cos;
};

/// Largest angle, rad. Beyond it the three pieces of pi/2 do not suffice; no joint angle is so
/// large.
inline constexpr double kSinCosMax_rad = 1e5;

inline std::uint64_t bits_of(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

inline double double_of(std::uint64_t bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// Returns sin(r + r_low) for |r| <= pi/4. Minimax coefficients (Remez exchange for the relative
/// error of x - x^3 P(x^2)), error 2^-57.9 before rounding; they are close to 1/3!, 1/5!, ...
constexpr double sin_on_octant(double r, double r_low) {
  const double z = r * r, r3 = z * r;
  const double p =
      0x1.111111110f7d0p-7 +
      z * (-0x1.a01a019bfdf04p-13 +
           z * (0x1.71de3567d4985p-19 + z * (-0x1.ae5e5a929b678p-26 + z * 0x1.5d8fd1ff6aa92p-33)));
  return r - ((z * (0.5 * r_low - r3 * p) - r_low) + r3 * 0x1.5555555555548p-3);
}

/// Returns cos(r + r_low) for |r| <= pi/4. Minimax coefficients (Remez exchange for the relative
/// error of 1 - x^2/2 + x^4 P(x^2)), error 2^-63.9 before rounding; they are close to 1/4!, 1/6!,
/// ...
constexpr double cos_on_octant(double r, double r_low) {
  const double z = r * r, half_z = 0.5 * z;
  const double p = 0x1.555555555554bp-5 +
                   z * (-0x1.6c16c16c14f91p-10 +
                        z * (0x1.a01a019c844f2p-16 +
                             z * (-0x1.27e4f7eac49cep-22 +
                                  z * (0x1.1ee9d7b4cfb96p-29 + z * -0x1.8fa499fe6e7bcp-37))));
  const double one_minus = 1.0 - half_z;
  const double lost = (1.0 - one_minus) - half_z;  // rounding error of the line above
  return one_minus + (lost + (z * z * p - r * r_low));
}

/// Returns sine and cosine of x [rad], within 0.85 units in the last place (largest of 1e7
/// measured: 0.80) for |x| <= kSinCosMax_rad. Fails closed: both are NaN if x is not finite or
/// larger. [any]
inline SinCos sincos(double x) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPi1 = 0x1.921fb54440000p+0;   // 36 bits each: n times them is exact,
  constexpr double kHalfPi2 = 0x1.68c234c4c0000p-39;  // n < 2^16
  constexpr double kHalfPi3 = 0x1.98a2e03707345p-77;
  constexpr double kRounder = 0x1.8p52;  // adding it rounds to an integer, which the last bits hold

  const double shifted = x * kTwoOverPi + kRounder;
  const double n = shifted - kRounder;              // multiples of pi/2 in x
  const std::uint64_t quadrant = bits_of(shifted);  // only its last two bits count

  const double a = x - n * kHalfPi1;  // exact
  const double w = n * kHalfPi2;      // exact
  const double b = a - w;
  const double lost = (a - b) - w;  // rounding error of b, exact
  const double rest = n * kHalfPi3 - lost;
  const double r = b - rest;
  const double r_low = (b - r) - rest;

  // The bits of larger magnitudes, of infinity and of NaN are larger integers; all ones is a NaN.
  const std::uint64_t magnitude = bits_of(x) & ~(std::uint64_t{1} << 63);
  const std::uint64_t refused = 0 - ((bits_of(kSinCosMax_rad) - magnitude) >> 63);

  const std::uint64_t s = bits_of(sin_on_octant(r, r_low));
  const std::uint64_t c = bits_of(cos_on_octant(r, r_low));
  const std::uint64_t exchange = (s ^ c) & (0 - (quadrant & 1));
  const std::uint64_t sin_sign = (quadrant & 2) << 62;
  const std::uint64_t cos_sign = ((quadrant + 1) & 2) << 62;
  return {double_of((s ^ exchange ^ sin_sign) | refused),
          double_of((c ^ exchange ^ cos_sign) | refused)};
}

}  // namespace tactus
