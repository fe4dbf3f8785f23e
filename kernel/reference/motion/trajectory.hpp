// Trajectory: timed waypoints in a fixed store, which passes from the client to the generator and
// back by messages, so that only one of them holds it at any time.
#pragma once

#include <cstdint>

#include "kernel/core/describe.hpp"
#include "kernel/core/published.hpp"
#include "kernel/reference/space/interpolation.hpp"
#include "kernel/reference/space/tolerance.hpp"

namespace tactus {

template <class Space>
struct Waypoint {
  double time_s = 0.0;  ///< from the start of the trajectory
  typename Space::Point point;
  /// Room (admission_room.hpp) at this waypoint and in the middle of the way to it; the client may
  /// raise it while the motion runs.
  Published<float> room = 1.0F, halfway = 1.0F;
};

/// Conditions under which a goal counts as followed and as reached. In a goal, a value > 0 applies,
/// 0 keeps the generator's default, and a negative value switches the check off; as a default, 0 is
/// off.
template <class Space>
struct Tolerances {
  typename Space::Band path;      ///< largest error on the way
  typename Space::Band goal;      ///< largest error at the end
  double stopped_velocity = 0.0;  ///< largest velocity at the end, rad/s or m/s
  double dwell_s = 0.0;           ///< time for which the end must be kept
  double goal_time_s = 0.0;       ///< time after the last waypoint in which the end must be reached

  /// Returns the tolerances of a goal, completed by the defaults. [cyclic]
  static Tolerances merged(const Tolerances& goal, const Tolerances& defaults) {
    return {Space::Band::merged(goal.path, defaults.path),
            Space::Band::merged(goal.goal, defaults.goal),
            merge_tolerance(goal.stopped_velocity, defaults.stopped_velocity),
            merge_tolerance(goal.dwell_s, defaults.dwell_s),
            merge_tolerance(goal.goal_time_s, defaults.goal_time_s)};
  }
};

/// A start time that means now.
inline constexpr double kStartAtOnce = -kInfinity;

/// Most waypoints that a store may hold, so that one of them is found in 15 halvings.
inline constexpr int kMostWaypoints = 1 << 15;

template <class Space>
struct Trajectory {
  Waypoint<Space>* waypoints = nullptr;  ///< storage, owned by the board
  int capacity = 0;                      ///< at most kMostWaypoints
  int count = 0;      ///< waypoints received; can exceed the capacity if the trajectory is open
  bool open = false;  ///< more waypoints follow, in the places of those that the motion has passed
  Fields fields = 0;  ///< given at every waypoint
  Interpolation interpolation = Interpolation::kByFields;
  typename Space::Header header;  ///< joints left out, or frames the waypoints are given in
  double start_s = kStartAtOnce;  ///< when it begins, by the generator's time
  Tolerances<Space> tolerances;
  /// Must be passed in exactly these times: refused where that exceeds a limit, not slowed down.
  bool exact = false;
  typename Space::Extent extent;  ///< set by admission
  double stretch = 0.0;           ///< set by admission: how much longer it takes, as a fraction

  const Waypoint<Space>& at(int index) const { return waypoints[index % capacity]; }
  double end_s() const { return at(count - 1).time_s; }
  /// Returns a waypoint as a placed reference, with zeros in the fields that are not given. [any]
  typename Space::Point point(int index, const typename Space::Placement& placement) const {
    const bool chosen = interpolation == Interpolation::kMonotone;
    const Fields given = static_cast<Fields>(fields | (chosen ? kVelocityField : 0));
    return Space::placed(Space::only(given, at(index).point), placement);
  }
  /// Returns the segment that ends at waypoint `index` >= 1. [any]
  typename Space::Segment segment(int index, const typename Space::Placement& placement) const {
    return {point(index - 1, placement), point(index, placement),
            at(index).time_s - at(index - 1).time_s, interpolation, fields};
  }
};

}  // namespace tactus
