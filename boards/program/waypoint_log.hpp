// waypoints.csv: the waypoints of a trajectory short enough to be looked at; longer ones are left
// out.
#pragma once

#include "boards/program/trajectory_input.hpp"

namespace tactus {

/// The columns are called after `reference`, the output that follows them, of joint positions or of
/// poses in the base frame. False if the file cannot be written.
bool write_waypoints(const char* path, const TrajectoryInput& input, const PortEntry& reference);

}  // namespace tactus
