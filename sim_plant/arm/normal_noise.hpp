// White noise of the sensors.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace tactus {

struct NormalPair {
  double first, second;
};

/// Draws two independent numbers of the standard normal distribution (Box and Muller 1958).
/// std::normal_distribution is not used, because its numbers depend on the library. [any]
inline NormalPair draw_normal(std::mt19937_64& random) {
  constexpr double kTwoPi = 6.28318530717958647693;
  constexpr double kUlp = 0x1p-53;
  const double u = static_cast<double>((random() >> 11) + 1) * kUlp;  // in (0, 1]
  const double v = static_cast<double>(random() >> 11) * kUlp;        // in [0, 1)
  const double radius = std::sqrt(-2.0 * std::log(u));
  return {radius * std::cos(kTwoPi * v), radius * std::sin(kTwoPi * v)};
}

}  // namespace tactus
