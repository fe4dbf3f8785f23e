// Admission: is this reference one the robot can follow? Runs outside the cycle, except for the one
// segment that begins where the robot happens to be. Limits are checked at the extrema of every
// polynomial, not at samples.
#pragma once

#include "kernel/joint_limits.hpp"
#include "kernel/reference/messages.hpp"

namespace tactus {

/// A trajectory may have at most this many segments in one cycle, so that finding the present one
/// is bounded.
inline constexpr int kMaxSegmentsPerCycle = 16;

/// Judges a whole trajectory but for the way from the robot to its first waypoint: count, times,
/// finite numbers, limits of every segment, rest at the end. The first violation is the verdict.
/// [any, not cyclic: proportional to its length]
Verdict admit(const Trajectory<JointSpace>& trajectory, const AdmissionSettings& settings);

/// Judges one online point: finite and within position, velocity and effort limits. [cyclic]
Verdict admit(const JointSpace::Point& point, const JointLimits& limits);

/// Judges one segment at its extrema; the verdict names `waypoint`. [cyclic, a few microseconds]
Verdict admit(const JointSpace::Segment& segment, int waypoint, const JointLimits& limits);

/// Distance of two positions against a tolerance per joint, rad. [cyclic]
Verdict within(const JointSpace::Point& a, const JointSpace::Point& b,
               const JointVector& tolerance);

}  // namespace tactus
