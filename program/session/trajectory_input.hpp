// Finds, reads, judges and sends the trajectory of a run, and prints every refusal in the same
// form.
#pragma once

#include <variant>

#include "program/session/files.hpp"
#include "program/session/session.hpp"

namespace tactus {

/// The trajectory of a run, in the space whose references the pipeline takes.
struct TrajectoryInput {
  FilePath path;    ///< empty: the run has no trajectory
  FilePath source;  ///< where its text can be read more than once: see seekable()
  std::variant<std::monostate, Trajectory<JointSpace>*, Trajectory<TaskSpace>*> trajectory;
  std::uint32_t id = 0;
  double start_s = 0.0;  ///< start time
  Pose motion_frame;     ///< frame of the poses, in the base frame, when they were sent

  bool given() const { return trajectory.index() != 0; }
  int count() const;                  ///< number of waypoints
  double time_s(int waypoint) const;  ///< of a waypoint, since the start of the trajectory
  double stretch() const;             ///< time added to stay within limits, as a fraction
  double end_s() const { return given() ? time_s(count() - 1) : 0.0; }
  bool takes_poses() const { return trajectory.index() == 2; }
  /// When it ends, slowed down as admission says, if the robot keeps up; s of the run.
  double planned_end_s() const { return start_s + end_s() * (1.0 + stretch()); }
};

/// Reads and judges the trajectory of the command line, or else the pipeline's own, without sending
/// it. False: refused; prints the reason to stderr.
bool read_input(const Session& session, const Options& options, TrajectoryInput& input);

/// Sends the trajectory, if there is one, to a generator that has started. False: refused; prints
/// the reason to stderr.
bool send_input(Session& session, TrajectoryInput& input);

/// Takes the next report of the generator that got the trajectory. False: there is none.
bool poll_report(Session& session, const TrajectoryInput& input, Report& report);

/// Prints to stderr why a trajectory was refused.
void print_verdict(const TrajectoryInput& input, const Verdict& verdict);

}  // namespace tactus
