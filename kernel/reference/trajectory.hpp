// Trajectories as they lie in memory: a fixed store of timed waypoints that passes from the client
// to the generator and back by messages, so that only one of them holds it at any time.
#pragma once

#include <cstdint>

#include "kernel/reference/interpolation.hpp"
#include "kernel/reference/path_use.hpp"

namespace tactus {

template <class Space>
struct Waypoint {
  double time_s = 0.0;  ///< from the start of the trajectory
  typename Space::Point point;
};

template <class Space>
struct Trajectory {
  Waypoint<Space>* waypoints = nullptr;  ///< storage, owned by the board
  int capacity = 0;
  int count = 0;
  Fields fields = 0;  ///< given at every waypoint
  Interpolation interpolation = Interpolation::kByFields;
  PathUse use;  ///< noted by admission

  double end_s() const { return waypoints[count - 1].time_s; }
  /// The segment that ends at waypoint `index` >= 1. [any]
  typename Space::Segment segment(int index) const {
    const Waypoint<Space>& from = waypoints[index - 1];
    const Waypoint<Space>& to = waypoints[index];
    return {from.point, to.point, to.time_s - from.time_s, interpolation, fields};
  }
};

}  // namespace tactus
