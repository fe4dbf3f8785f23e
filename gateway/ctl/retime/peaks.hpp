// The largest velocity, acceleration and jerk of a trajectory, from the polynomials between its
// waypoints as whoever executes it joins them: quintics if accelerations are given, else cubics.
#pragma once

#include <vector>

#include "gateway/ctl/retime/joints.hpp"

namespace tactus::ctl {

/// Largest magnitudes of any joint, as fractions of its bounds.
struct Peaks {
  double v = 0.0, a = 0.0, j = 0.0;

  /// Factor by which the times must grow to keep all bounds: v, a and j fall with its first, second
  /// and third power. At least `least`. [any]
  double stretch(double least) const;
};

/// Finds the extrema of all segments. The jerk of cubics, which steps, is left out. [any]
Peaks peaks(const std::vector<TimedPoint>& points, const MotionBounds& bounds, bool quintic);

}  // namespace tactus::ctl
