// PathProgress: the progress of a trajectory.
#pragma once

namespace tactus {

/// In the times of its waypoints, whatever its rate; both 0 without a trajectory. Boards without
/// streams do not report it.
struct PathProgress {
  double path_s = 0.0;
  double path_end_s = 0.0;  ///< time of the last waypoint received
};

}  // namespace tactus
