// The trajectory of a run: found, read, judged and sent, with every refusal printed in the same
// form.
#pragma once

#include "boards/program/files.hpp"
#include "boards/program/session.hpp"

namespace tactus {

/// The trajectory of a run, of the space whose references the pipeline takes.
struct TrajectoryInput {
  FilePath path;  ///< empty: the run has none
  std::variant<std::monostate, Trajectory<JointSpace>*, Trajectory<TaskSpace>*> trajectory;
  std::uint32_t id = 0;
  double start_s = 0.0;  ///< when it begins
  Pose motion_frame;     ///< of poses, in the base frame, as it stood when they were sent

  bool given() const { return trajectory.index() != 0; }
  int count() const;                  ///< waypoints
  double time_s(int waypoint) const;  ///< of a waypoint, from its beginning
  double stretch() const;             ///< by how much it is slowed down, as a fraction of its time
  double end_s() const { return given() ? time_s(count() - 1) : 0.0; }
};

/// Reads and judges the trajectory of the command line or, without one, the pipeline's own; nothing
/// is sent yet. False: refused, with the reason on the error stream.
bool read_input(const Session& session, const Options& options, TrajectoryInput& input);

/// Sends what was read, if anything, to a generator that has started. False: refused, as above.
bool send_input(Session& session, TrajectoryInput& input);

/// The next report of whoever got the trajectory.
bool poll_report(Session& session, const TrajectoryInput& input, Report& report);

/// Prints why a trajectory was refused.
void print_verdict(const TrajectoryInput& input, const Verdict& verdict);

}  // namespace tactus
