// Trajectory: timed waypoints in a fixed store, which passes from the client to the generator and
// back by messages, so that only one of them holds it at any time.
//
// A store is an array of whole waypoints. Packed, it holds more of them, each with the numbers of
// the given fields only:
//
//   whole:                        time_s, position, velocity, acceleration, effort, rooms
//   packed, positions only:       time_s, position, rooms
//   packed, with velocities too:  time_s, position, velocity, rooms
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>

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

/// The rooms of a waypoint as they lie at the end of its place.
struct WaypointRooms {
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
  double goal_time_s = 0.0;  ///< time after the end of the reference in which it must be reached

  /// Returns the tolerances of a goal, completed by the defaults. [cyclic]
  static Tolerances merged(const Tolerances& goal, const Tolerances& defaults) {
    return {Space::Band::merged(goal.path, defaults.path),
            Space::Band::merged(goal.goal, defaults.goal),
            merge_tolerance(goal.stopped_velocity, defaults.stopped_velocity),
            merge_tolerance(goal.dwell_s, defaults.dwell_s),
            merge_tolerance(goal.goal_time_s, defaults.goal_time_s)};
  }
};

/// The time of the last waypoint, and the wait for a start, at most: a day. Dates are beyond.
inline constexpr double kLongestTrajectory_s = 86'400.0;

/// A start time that means now.
inline constexpr double kStartAtOnce = -kInfinity;

/// Most waypoints that a store may hold, so that one of them is found in 15 halvings.
inline constexpr int kMostWaypoints = 1 << 15;

template <class Space>
struct Trajectory {
  Waypoint<Space>* waypoints = nullptr;  ///< storage, owned by the board
  int capacity = 0;                      ///< waypoints that fit, at most kMostWaypoints
  int count = 0;      ///< waypoints received; can exceed the capacity if the trajectory is open
  bool open = false;  ///< more waypoints follow, in the places of those that the motion has passed
  Fields fields = 0;  ///< given at every waypoint
  Interpolation interpolation = Interpolation::kByFields;
  typename Space::Header header;  ///< joints left out, or frames the waypoints are given in
  double start_s = kStartAtOnce;  ///< when it begins, by the generator's time
  Tolerances<Space> tolerances;
  /// Must be passed in exactly these times: refused where that exceeds a limit, not slowed down.
  bool exact = false;
  /// May be joined after its start time, at the point where it would be: refused otherwise.
  bool joinable = true;
  typename Space::Extent extent;  ///< set by admission
  double stretch = 0.0;           ///< set by admission: how much longer it takes, as a fraction

  /// Forgets the last trajectory: no waypoints, whole ones from now on, every setting its default.
  /// [any, not shared]
  void clear() {
    Waypoint<Space>* const storage = waypoints;
    const int whole = whole_waypoints();
    *this = Trajectory();
    waypoints = storage;
    capacity = whole;
  }
  /// Packs an empty store: from now on its waypoints hold `packed` fields and no others, and
  /// `capacity` is how many of them fit. [any, not shared]
  void pack(Fields packed) {
    whole_ = std::max(whole_waypoints(), 0);
    stride_ = sizeof(Waypoint<Space>) - sizeof(typename Space::Point) +
              sizeof(double) * static_cast<std::size_t>(Space::numbers(packed));
    const std::size_t bytes = static_cast<std::size_t>(whole_) * sizeof(Waypoint<Space>);
    capacity = static_cast<int>(std::min<std::size_t>(bytes / stride_, kMostWaypoints));
  }
  /// False if the places of a packed store have no room for the fields that are given. [any]
  bool holds_fields() const {
    return Space::numbers(given()) <= static_cast<int>(kept() / sizeof(double));
  }

  /// Writes a waypoint, of which a packed store keeps the fields it holds. [any, not shared]
  void set(int index, const Waypoint<Space>& waypoint) const {
    time(index) = waypoint.time_s;
    const auto* const from = reinterpret_cast<const double*>(&waypoint.point);
    std::copy(from, from + kept() / sizeof(double), numbers(index));
    new (&rooms(index)) WaypointRooms{waypoint.room, waypoint.halfway};
  }
  /// Returns a waypoint, with zeros in the fields that a packed store does not hold. [any]
  Waypoint<Space> at(int index) const {
    Waypoint<Space> waypoint;
    waypoint.time_s = time_s(index);
    std::copy(numbers(index), numbers(index) + kept() / sizeof(double),
              reinterpret_cast<double*>(&waypoint.point));
    waypoint.room = rooms(index).room;
    waypoint.halfway = rooms(index).halfway;
    return waypoint;
  }
  double time_s(int index) const { return time(index); }
  double end_s() const { return time_s(count - 1); }
  /// The numbers of a waypoint's point, in the order of its members.
  double* numbers(int index) const { return &time(index) + 1; }
  WaypointRooms& rooms(int index) const {
    return *reinterpret_cast<WaypointRooms*>(place(index) + stride_ - sizeof(WaypointRooms));
  }
  /// The fields that are given or derived.
  Fields given() const {
    const bool chosen = interpolation == Interpolation::kMonotone;
    return static_cast<Fields>(fields | (chosen ? kVelocityField : 0));
  }
  /// Returns a waypoint as a placed reference, with zeros in the fields that are not given. [any]
  typename Space::Point point(int index, const typename Space::Placement& placement) const {
    return Space::placed(Space::only(given(), numbers(index)), placement);
  }
  /// Returns the segment that ends at waypoint `index` >= 1. [any]
  typename Space::Segment segment(int index, const typename Space::Placement& placement) const {
    return {point(index - 1, placement), point(index, placement), time_s(index) - time_s(index - 1),
            interpolation, fields};
  }

 private:
  static_assert(sizeof(Waypoint<Space>) ==
                    sizeof(double) + sizeof(typename Space::Point) + sizeof(WaypointRooms),
                "a waypoint lies as a place of all fields does");

  int whole_waypoints() const { return whole_ > 0 ? whole_ : capacity; }
  std::byte* place(int index) const {
    return reinterpret_cast<std::byte*>(waypoints) +
           static_cast<std::size_t>(index % capacity) * stride_;
  }
  double& time(int index) const { return *reinterpret_cast<double*>(place(index)); }
  /// Bytes of a point that a place keeps.
  std::size_t kept() const { return stride_ - sizeof(double) - sizeof(WaypointRooms); }

  int whole_ = 0;  // whole waypoints that a packed store would hold; 0: it is not packed
  std::size_t stride_ = sizeof(Waypoint<Space>);  // bytes from a waypoint to the next
};

}  // namespace tactus
