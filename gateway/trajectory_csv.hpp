// Reads a trajectory file that must fit into its store; longer ones are streamed
// (trajectory_stream.hpp). The columns are those of trajectory_reader.hpp.
#pragma once

#include "gateway/trajectory_reader.hpp"

namespace tactus {

/// Fills `trajectory` from the file at `path`. Returns false if the file is refused; the trajectory
/// must not be used then. Refuses what TrajectoryReader refuses, and more waypoints than fit into
/// the store. With `partial` a file may leave out joints, the same in every group; they are held.
/// [init]
template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error);

}  // namespace tactus
