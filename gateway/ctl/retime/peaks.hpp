// The largest velocity, acceleration and jerk of a trajectory, from the polynomials between its
// waypoints as the kernel joins them: quintics if accelerations are given, else cubics.
#pragma once

#include <vector>

#include "gateway/ctl/retime/numbers.hpp"

namespace tactus::ctl {

/// Largest values of any channel, as fractions of its bounds.
struct Peaks {
  double v = 0.0, a = 0.0, j = 0.0;

  /// Factor by which the times must grow, or may shrink, to keep all bounds just so: v, a and j
  /// fall with its first, second and third power. [any]
  double stretch() const;
};

/// Finds the extrema of all segments: of joints exactly, of the tip as its admission does, never
/// too low (kernel/reference/space/vector_bounds.hpp). A jerk is that inside of segments, as
/// admission has it: the accelerations of cubics may step at a waypoint. [any]
Peaks peaks(const std::vector<TimedPoint>& points, bool tip, const MotionBounds& bounds,
            bool quintic);

}  // namespace tactus::ctl
