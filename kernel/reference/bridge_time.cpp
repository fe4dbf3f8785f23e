#include "kernel/reference/bridge_time.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

// Peaks of the quintic that takes a unit of position, velocity or acceleration to zero in one
// second, by the extrema of its Hermite basis: h_p = 1 - 10 t^3 + 15 t^4 - 6 t^5, h_v = t - 6 t^3 +
// 8 t^4 - 3 t^5, h_a = (t^2 - 3 t^3 + 3 t^4 - t^5) / 2.
constexpr double kPeakVelocityOfPosition = 1.875;       // |h_p'| at t = 1/2
constexpr double kPeakAccelerationOfPosition = 5.7736;  // |h_p''| = 10 / sqrt(3)
constexpr double kPeakAccelerationOfVelocity = 3.9412;  // |h_v''| at t = 0.2427
// The swing to the other side, beyond which a velocity or acceleration is no larger than at t = 0.
constexpr double kSwingOfVelocity = 0.512;      // |h_v'| at t = 3/5
constexpr double kSwingOfAcceleration = 0.374;  // |h_a''| at t = 0.3551
// Jerk: with accelerations as bounded here, |60 dp / T^3| + |36 dv / T^2| + |9 da / T| <= 28 a_max
// / T, which is to be half of the limit.
constexpr double kJerkTime = 56.0;

/// What a bound leaves to the peaks if the motion begins with `start` and swings to the other side.
/// Wherever it does not swing, the start leaves at least as much, because its share falls from one
/// faster than the peaks rise.
double left(double bound, double start, double swing) {
  return bound - swing * std::min(start, bound);
}

}  // namespace

double bridge_time_s(const BridgeStart& start, double v, double a) {
  const double for_peaks = left(a, start.a, kSwingOfAcceleration);
  // for_peaks T^2 = kPeakAccelerationOfVelocity v T + kPeakAccelerationOfPosition p
  const double half = 0.5 * kPeakAccelerationOfVelocity * start.v;
  const double for_acceleration =
      (half + std::sqrt(half * half + for_peaks * kPeakAccelerationOfPosition * start.p)) /
      for_peaks;
  const double for_velocity =
      kPeakVelocityOfPosition * start.p / left(v, start.v, kSwingOfVelocity);
  return std::max(for_acceleration, for_velocity);
}

double bridge_jerk_time_s(double a_max, double j_max) {
  return kJerkTime * a_max / j_max;
}

}  // namespace tactus
