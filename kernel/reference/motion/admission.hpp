// Admission judges whether the robot can follow a trajectory. It runs outside the cycle. Limits are
// checked at the extrema of every polynomial, not at samples; the space says what they mean
// (space.hpp).
#pragma once

#include "kernel/core/verdict.hpp"
#include "kernel/reference/motion/admission_settings.hpp"
#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

/// Largest number of segments of a trajectory in one cycle; it bounds the search for the present
/// one.
inline constexpr int kMaxSegmentsPerCycle = 16;

/// The account of a trajectory judged up to some waypoint: the end of its last segment, its extent,
/// and the place where it must be slowed down most.
template <class Space>
struct Admitted {
  typename Space::Point end;
  typename Space::Levels steps{};
  typename Space::Extent extent;
  double room = 1.0;  ///< least room (admission_room.hpp) that a limit requires
  Verdict worst;      ///< that limit
};

/// Judges a whole trajectory except for the way from the robot to its first waypoint: count, times,
/// finite numbers, limits of every waypoint and segment, rest at the end. Returns the first
/// violation. Segments beyond a velocity, acceleration or jerk limit are slowed down, unless the
/// trajectory is exact or becomes longer than the settings allow; then returns the worst violation.
/// Chooses the velocities of a monotone trajectory, writes rooms, extent and stretch into the
/// trajectory, and into `whole` the account that admit_waypoint() continues if it grows. [any, not
/// cyclic: proportional to its length]
template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
              Admitted<Space>& whole);
template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings) {
  Admitted<Space> whole;
  return admit(trajectory, settings, whole);
}

/// Returns the account before the first segment. A first waypoint at time zero is left from rest;
/// the way to a later one is judged when the trajectory begins. [any]
template <class Space>
Admitted<Space> nothing_yet(const Trajectory<Space>& trajectory,
                            const AdmissionSettings<Space>& settings);

/// Judges the time of waypoint `index`: at least a sixteenth of the period after the one before it,
/// the first not before zero, none after
/// kLongestTrajectory_s. [any]
template <class Space>
Verdict admit_time(const Trajectory<Space>& trajectory, int index, double time_s, double period_s);

/// Judges one more waypoint of an open trajectory and the segment that ends there. [any]
template <class Space>
Verdict admit_waypoint(const Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, Admitted<Space>& so_far);

/// Judges the last waypoint of a trajectory, which must be at rest. [any]
template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, Admitted<Space> so_far);

/// Judges by which fraction, `longer`, the part of an open trajectory after waypoint `first`, up to
/// `last`, is slowed down; `part` is the account of it. Sets the rooms after `first` to zero. [any,
/// not cyclic]
template <class Space>
Verdict admit_part(const Trajectory<Space>& trajectory, int first, int last,
                   const AdmissionSettings<Space>& settings, const Admitted<Space>& part,
                   double& longer);

}  // namespace tactus
