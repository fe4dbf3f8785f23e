// PathUse: how much of the limits a path takes when it is run as planned, and so how fast its time
// law may change.
#pragma once

#include <algorithm>

#include "kernel/reference/time_law.hpp"

namespace tactus {

/// Largest ratios along a path p(s), over all axes: of its derivatives to the limits v, a and j. 1
/// is a limit reached.
struct PathUse {
  double velocity = 0.0;           ///< |p'| / v
  double acceleration = 0.0;       ///< |p''| / a
  double jerk = 0.0;               ///< |p'''| / j
  double velocity_by_a = 0.0;      ///< |p'| / a, s
  double velocity_by_j = 0.0;      ///< |p'| / j, s^2
  double acceleration_by_j = 0.0;  ///< |p''| / j, s

  /// The larger of two in every ratio: the use of a path of two parts. [any]
  static PathUse largest(const PathUse& a, const PathUse& b) {
    return {std::max(a.velocity, b.velocity),
            std::max(a.acceleration, b.acceleration),
            std::max(a.jerk, b.jerk),
            std::max(a.velocity_by_a, b.velocity_by_a),
            std::max(a.velocity_by_j, b.velocity_by_j),
            std::max(a.acceleration_by_j, b.acceleration_by_j)};
  }

  /// Bounds of the rate r that keep the motion within limits for every r in [0, 1], because
  ///
  ///   |p'' r^2 + p' dr/dt| / a                       <= acceleration + velocity_by_a slope
  ///   |p''' r^3 + 3 p'' r dr/dt + p' d2r/dt2| / j    <= jerk + 3 acceleration_by_j slope +
  ///   velocity_by_j curvature
  ///
  /// and the right-hand sides are at most `share` of what the path itself leaves of each limit,
  /// half of the jerk for either term. A path that leaves nothing gets bounds so small that it can
  /// hardly be stopped; admission does not let it pass. [cyclic]
  RateBounds rate_bounds(double share) const {
    constexpr double kFastest =
        100.0;  // 1/s; a rate need not change faster than in ten milliseconds
    const double a = share * std::max(1.0 - acceleration, kLeast);
    const double j = 0.5 * share * std::max(1.0 - jerk, kLeast);
    const double slope = std::min(a / std::max(velocity_by_a, a / kFastest),
                                  j / std::max(3.0 * acceleration_by_j, j / kFastest));
    return {slope, j / std::max(velocity_by_j, j / (kFastest * kFastest))};
  }

 private:
  static constexpr double kLeast = 1e-3;
};

}  // namespace tactus
