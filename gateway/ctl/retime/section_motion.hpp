// The fastest motion along a section of a path, from rest to rest, within bounds.
//
// Velocity and acceleration: the method of TOPP-RA (reachability.hpp). Jerk: the position along the
// path over time is smoothed (time_law.hpp), over the width for which the motion becomes shortest.
// The motion is then stretched by the largest violation of a bound that its output, polynomials
// between waypoints, still has: it keeps every bound between waypoints too, whatever grid and
// smoothing have left.
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

/// Motions through a section, from time 0; empty if there is none.
struct SectionMotions {
  std::vector<TimedPoint> near;      ///< the fastest that passes every corner within tolerance
  std::vector<TimedPoint> shortest;  ///< the fastest, which may miss corners
};

/// [any]
SectionMotions fastest_motions(const PathSection& section, const RetimeSettings& settings);

}  // namespace tactus::ctl
