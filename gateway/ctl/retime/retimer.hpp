// Turns a path without times into a trajectory that passes it in the least time within bounds.
//
// A section is stretched as a whole for its worst corner (section_motion.hpp), so that one corner
// with a small blend may cost more than a stop in it. The corners that the fastest motion misses
// or, if it misses none, those that need most of the stretch are therefore tried as stops, too, and
// in the sections between them the next ones, down to a stop in every waypoint; of each section,
// the shorter that misses no corner is kept.
#pragma once

#include <vector>

#include "gateway/ctl/retime/section_motion.hpp"

namespace tactus::ctl {

/// Returns the trajectory, from time 0, never longer than with a stop in every waypoint; empty if
/// all waypoints are the same or the path cannot be passed. [any]
std::vector<TimedPoint> retime(const std::vector<Numbers>& waypoints,
                               const RetimeSettings& settings);

}  // namespace tactus::ctl
