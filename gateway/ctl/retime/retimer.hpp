// Turns a path without times into a trajectory that passes it in the least time within bounds.
//
// Velocity and acceleration: the method of TOPP-RA (reachability.hpp), per section from rest to
// rest. Jerk: the position along the path over time is smoothed (time_law.hpp), over the width for
// which the motion becomes shortest. Each section is then stretched by the largest violation of a
// bound that its own output, polynomials between waypoints, still has: the result keeps every bound
// between waypoints too, whatever grid and smoothing have left.
#pragma once

#include <vector>

#include "gateway/ctl/retime/corner_path.hpp"

namespace tactus::ctl {

struct RetimeSettings {
  bool tip = false;  ///< the path is one of the tip, not of joints
  MotionBounds bounds;
  Corners corners;
  bool jerk = true;  ///< keep the bound of jerk; the trajectory then has accelerations
  int steps = 1000;  ///< least number of grid intervals of a section
};

/// Returns the trajectory, from time 0; empty if all waypoints are the same or the path cannot be
/// passed. [any]
std::vector<TimedPoint> retime(const std::vector<Numbers>& waypoints,
                               const RetimeSettings& settings);

}  // namespace tactus::ctl
