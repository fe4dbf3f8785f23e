// The trajectory of a run: found, read, judged and sent, with every refusal printed in the same
// form.
#pragma once

#include "boards/program/files.hpp"
#include "boards/program/session.hpp"

namespace tactus {

/// What became of the trajectory before the first cycle.
struct TrajectoryInput {
  Path path;  ///< empty: the run has none
  const Trajectory<JointSpace>* trajectory = nullptr;
  std::uint32_t id = 0;
};

/// Reads and sends the trajectory of the command line or, without one, the pipeline's own. False:
/// refused, with the reason on the error stream.
bool send_trajectory(Session& session, const Options& options, TrajectoryInput& input);

/// Prints why a trajectory was refused.
void print_verdict(const TrajectoryInput& input, const Verdict& verdict);

}  // namespace tactus
