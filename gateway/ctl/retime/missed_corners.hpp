// The corners that a trajectory along a section misses. Its waypoints are on the path, the
// polynomials between them are not: where two of them are far apart beside the blend of a corner,
// the trajectory cuts across it, or swings out.
#pragma once

#include <vector>

#include "gateway/ctl/retime/section_motion.hpp"

namespace tactus::ctl {

/// Returns the waypoints with a rounded corner that is at no time within its tolerance in all
/// channels that have one. [any]
std::vector<std::size_t> missed_corners(const PathSection& section,
                                        const std::vector<TimedPoint>& points,
                                        const RetimeSettings& settings);

}  // namespace tactus::ctl
