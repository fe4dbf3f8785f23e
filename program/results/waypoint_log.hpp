// waypoints.csv: the waypoints of a trajectory of at most 200; a longer one is not written.
#pragma once

#include "program/session/trajectory_input.hpp"

namespace tactus {

/// Writes the waypoints as joint positions, or as poses in the base frame, in columns named after
/// `reference`, the output that follows them; nothing if that has another quantity. False if the
/// file cannot be written: prints the reason to stderr.
bool write_waypoints(const char* path, const TrajectoryInput& input, const PortEntry& reference);

}  // namespace tactus
