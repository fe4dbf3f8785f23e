// Admission: is this trajectory one the robot can follow? Runs outside the cycle. Limits are
// checked at the extrema of every polynomial, not at samples; what they mean is the business of the
// space.
#pragma once

#include "kernel/reference/messages.hpp"

namespace tactus {

/// A trajectory may have at most this many segments in one cycle, so that finding the present one
/// is bounded.
inline constexpr int kMaxSegmentsPerCycle = 16;

/// Judges a whole trajectory but for the way from the robot to its first waypoint: count, times,
/// finite numbers, limits of every waypoint and segment, rest at the end. The first violation is
/// the verdict. Chooses the velocities of a monotone one, and notes in the trajectory what it takes
/// of the limits. [any, not cyclic: proportional to its length]
template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings);

/// One more waypoint of an open trajectory and the segment that ends there. `before` is where the
/// segment before ended and becomes where this one does; `use` grows by what it takes. [any]
template <class Space>
Verdict admit_waypoint(const Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, typename Space::Point& before,
                       typename Space::Use& use);

/// The last waypoint of a trajectory: whoever arrives there must stand. [any]
template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, const typename Space::Point& before);

}  // namespace tactus
