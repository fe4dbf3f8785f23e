// Admission: is this trajectory one the robot can follow? Runs outside the cycle. Limits are
// checked at the extrema of every polynomial, not at samples; what they mean is the business of the
// space.
#pragma once

#include "kernel/reference/messages.hpp"

namespace tactus {

/// A trajectory may have at most this many segments in one cycle, so that finding the present one
/// is bounded.
inline constexpr int kMaxSegmentsPerCycle = 16;

/// How far a trajectory has been judged: where its last segment ended, what it takes, and where it
/// must be slowed down most.
template <class Space>
struct Admitted {
  typename Space::Point end;
  typename Space::Levels steps{};
  typename Space::Use use;
  double room = 1.0;  ///< least square of the rate that limits ask for
  Verdict worst;      ///< the limit that asks for it
};

/// Judges a whole trajectory but for the way from the robot to its first waypoint: count, times,
/// finite numbers, limits of every waypoint and segment, rest at the end. The first violation is
/// the verdict. What takes more than a limit of velocity, acceleration or jerk is slowed down, if
/// that makes the whole no longer than the settings allow and it need not be exact; else the worst
/// is the verdict. Chooses the velocities of a monotone one, and notes in the trajectory what it
/// takes of the limits. [any, not cyclic: proportional to its length]
template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings);

/// What comes before the first segment. A first waypoint at zero is left from rest; the way to a
/// later one is judged when it begins. [any]
template <class Space>
Admitted<Space> nothing_yet(const Trajectory<Space>& trajectory,
                            const AdmissionSettings<Space>& settings);

/// One more waypoint of an open trajectory and the segment that ends there. [any]
template <class Space>
Verdict admit_waypoint(const Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, Admitted<Space>& so_far);

/// The last waypoint of a trajectory: whoever arrives there must stand. [any]
template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, Admitted<Space> so_far);

/// The part of an open trajectory behind waypoint `first`, up to `last`, of which `part` must be
/// slowed down most; the rooms behind `first` are zero afterwards. [any, not cyclic]
template <class Space>
Verdict admit_part(const Trajectory<Space>& trajectory, int first, int last,
                   const AdmissionSettings<Space>& settings, const Admitted<Space>& part);

}  // namespace tactus
