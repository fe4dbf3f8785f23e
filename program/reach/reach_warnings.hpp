// The words of `tactus check` about a path of the tip that the arm cannot follow.
#pragma once

#include "program/session/session.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus {

/// Goes along a trajectory of poses with the arm from `q`, rad, and prints to stderr what it finds:
/// a line for each stretch of the path. False: some of it no joints reach; the rest is a warning.
/// Takes about a second at most, whatever the trajectory.
bool judge_reach(const Session& session, const TrajectoryInput& input, const JointVector& q);

}  // namespace tactus
