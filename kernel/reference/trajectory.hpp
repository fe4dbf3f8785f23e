// Trajectories as they lie in memory: a fixed store of timed waypoints that passes from the client
// to the generator and back by messages, so that only one of them holds it at any time.
#pragma once

#include <cstdint>

#include "kernel/describe.hpp"
#include "kernel/reference/interpolation.hpp"
#include "kernel/reference/tolerance.hpp"

namespace tactus {

template <class Space>
struct Waypoint {
  double time_s = 0.0;  ///< from the start of the trajectory
  typename Space::Point point;
};

/// When a goal is followed, and when it is reached. In a goal, a value > 0 holds for it, 0 keeps
/// the generator's default, and a negative one switches the check off; as a default, 0 is off.
template <class Space>
struct Tolerances {
  typename Space::Band path;      ///< largest error on the way
  typename Space::Band goal;      ///< largest error at the end
  double stopped_velocity = 0.0;  ///< largest velocity at the end
  double dwell_s = 0.0;           ///< how long the end must be kept
  double goal_time_s = 0.0;       ///< how long after the last waypoint the end may be reached

  /// Those of a goal, completed by the defaults. [cyclic]
  static Tolerances merged(const Tolerances& goal, const Tolerances& defaults) {
    return {Space::Band::merged(goal.path, defaults.path),
            Space::Band::merged(goal.goal, defaults.goal),
            merge_tolerance(goal.stopped_velocity, defaults.stopped_velocity),
            merge_tolerance(goal.dwell_s, defaults.dwell_s),
            merge_tolerance(goal.goal_time_s, defaults.goal_time_s)};
  }
};

/// A start time that is always now.
inline constexpr double kStartAtOnce = -kInfinity;

template <class Space>
struct Trajectory {
  Waypoint<Space>* waypoints = nullptr;  ///< storage, owned by the board
  int capacity = 0;
  int count = 0;      ///< waypoints so far; an open trajectory has had more than fit at a time
  bool open = false;  ///< more waypoints follow, over those that the motion has passed
  Fields fields = 0;  ///< given at every waypoint
  Interpolation interpolation = Interpolation::kByFields;
  typename Space::Terms terms;    ///< which joints, or which frames, the waypoints are given in
  double start_s = kStartAtOnce;  ///< when it begins, by the generator's time
  Tolerances<Space> tolerances;
  typename Space::Use use;  ///< noted by admission

  const Waypoint<Space>& at(int index) const { return waypoints[index % capacity]; }
  double end_s() const { return at(count - 1).time_s; }
  /// A waypoint as a reference, when its terms are `latched`. [any]
  typename Space::Point point(int index, const typename Space::Latched& latched) const {
    return Space::placed(at(index).point, latched);
  }
  /// The segment that ends at waypoint `index` >= 1. [any]
  typename Space::Segment segment(int index, const typename Space::Latched& latched) const {
    return {point(index - 1, latched), point(index, latched),
            at(index).time_s - at(index - 1).time_s, interpolation, fields};
  }
};

}  // namespace tactus
