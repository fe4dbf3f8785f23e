// Finds, reads, judges and sends the trajectory of a run, and prints every refusal in the same
// form.
#pragma once

#include <variant>

#include "gateway/trajectory/trajectory_stream.hpp"
#include "program/session/files.hpp"
#include "program/session/session.hpp"

namespace tactus {

/// The trajectory of a run, in the space whose references the pipeline takes.
struct TrajectoryInput {
  FilePath path;  ///< empty: the run has no trajectory
  std::variant<std::monostate, Trajectory<JointSpace>*, Trajectory<TaskSpace>*> trajectory;
  /// The way of its file into that trajectory; of the same space.
  std::variant<std::monostate, TrajectoryStream<JointSpace>, TrajectoryStream<TaskSpace>> file;
  std::uint32_t id = 0;
  Verdict refused;       ///< of the refusal that was printed last; ok of a row that cannot be read
  Reason refusal;        ///< the same in words; empty: none was printed
  double start_s = 0.0;  ///< start time
  Pose motion_frame;     ///< frame of the poses, in the base frame, when they were sent

  bool given() const { return trajectory.index() != 0; }
  /// True if the file does not fit into the store and is streamed.
  bool longer() const;
  /// True if its last waypoint is known; false of a pipe that is still open.
  bool whole_known() const;
  std::int64_t count() const;         ///< number of waypoints known so far
  double time_s(int waypoint) const;  ///< of a waypoint, since the start of the trajectory
  double stretch() const;             ///< time added to stay within limits, as a fraction
  Smoothing smoothing() const;        ///< how its file is read
  SmoothingTolerance moved() const;   ///< how far positions were moved at most, to smooth them
  double end_s() const;               ///< time of the last waypoint known so far
  /// Time that it takes, with the time added to stay within limits.
  double duration_s() const { return end_s() + longer_s(); }
  double longer_s() const;
  /// Hash of the pipeline's text and the bytes read so far; `none` if there is no file.
  std::uint64_t hash(std::uint64_t none) const;
  bool takes_poses() const { return trajectory.index() == 2; }
  /// When it ends, slowed down by admission, if the robot keeps up; s of the run.
  double planned_end_s() const { return start_s + duration_s(); }
};

/// Reads and judges the trajectory of the command line, or else the pipeline's own, without sending
/// it: the whole file, or of a pipe the waypoints that fit into the store. Where the robot has
/// joints without end, it connects first and reads where the arm is. False: refused; prints the
/// reason to stderr.
bool read_input(const Session& session, const Options& options, TrajectoryInput& input);

/// Judges the rest of a pipe, which is not to be sent. False: refused; prints the reason to stderr.
bool judge_rest(const Session& session, TrajectoryInput& input);

/// Sends the trajectory, if there is one, to a generator that has started. False: refused; prints
/// the reason to stderr.
bool send_input(Session& session, TrajectoryInput& input);

/// Takes the next report of the generator that got the trajectory. False: there is none.
bool poll_report(Session& session, TrajectoryInput& input, Report& report);

/// Returns the result of a run whose file was refused on the way: the Status, or kRefused for a row
/// that cannot be read.
int refusal_code(const TrajectoryInput& input);

/// Sends the next part of a file that is longer than the store, as TrajectoryStream::feed(). Call
/// it in the thread that polls. A refusal prints its reason to stderr.
FeedResult feed_input(Session& session, TrajectoryInput& input, int wait_ms);

/// Prints a warning to stderr if a joint without end turns by more than half a turn where the file,
/// as far as it was read, could mean less.
void print_long_way(const TrajectoryInput& input);

/// Prints to stderr why a trajectory was refused, after the line of the waypoint if it is known,
/// and keeps it as the refusal of the input.
void print_verdict(TrajectoryInput& input, const Verdict& verdict, int line = 0);

}  // namespace tactus
