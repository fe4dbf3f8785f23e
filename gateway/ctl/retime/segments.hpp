// The polynomials between two waypoints of a trajectory as the kernel joins them: quintics if
// accelerations are given, else cubics.
#pragma once

#include "gateway/ctl/retime/numbers.hpp"
#include "kernel/reference/space/rotation_segment.hpp"

namespace tactus::ctl {

/// Returns the segment of joint k. [any]
Polynomial joint_segment(const TimedPoint& from, const TimedPoint& to, Eigen::Index k,
                         Interpolation order);
/// Return the segments of the tip. [any]
VectorPolynomial translation_segment(const TimedPoint& from, const TimedPoint& to,
                                     Interpolation order);
RotationSegment rotation_segment(const TimedPoint& from, const TimedPoint& to, Interpolation order);

}  // namespace tactus::ctl
