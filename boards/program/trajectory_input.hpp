// The trajectory of a run: found, read, judged and sent, with every refusal printed in the same
// form.
#pragma once

#include "boards/program/files.hpp"
#include "boards/program/session.hpp"

namespace tactus {

/// What became of the trajectory before the first cycle.
struct TrajectoryInput {
  Path path;  ///< empty: the run has none
  Trajectory<JointSpace>* trajectory = nullptr;
  std::uint32_t id = 0;
};

/// Reads and judges the trajectory of the command line or, without one, the pipeline's own; nothing
/// is sent yet. False: refused, with the reason on the error stream.
bool read_input(const Session& session, const Options& options, TrajectoryInput& input);

/// Sends what was read, if anything, to a generator that has started. False: refused, as above.
bool send_input(Session& session, TrajectoryInput& input);

/// Prints why a trajectory was refused.
void print_verdict(const TrajectoryInput& input, const Verdict& verdict);

}  // namespace tactus
