// Trajectory files: CSV with one header row that names quantity and unit. Columns in any order, '#'
// begins a comment line, empty lines are skipped.
//
//   time_s, q1_rad ... q7_rad [, dq1_rad_s ...] [, ddq1_rad_s2 ...] [, tau1_Nm ...]
//
// Joint names of the robot may stand for the numbers (q_fer_joint1_rad). A group is given for all
// joints or left out.
#pragma once

#include "kernel/load_error.hpp"
#include "kernel/reference/trajectory.hpp"

namespace tactus {

/// Where and why a trajectory file was refused; lines and columns count from 1, 0 = not in
/// particular.
struct CsvError {
  int line = 0, column = 0;
  Name header;  ///< name of the column
  Message reason;

  /// "line:column: header: reason" without the parts that are empty.
  PlacedMessage message() const;
};

/// Fills `trajectory` from the file at `path`. False: refused, the trajectory is not to be used.
/// A cell that is empty, no number, NaN or infinite is refused, and so are more waypoints than the
/// store holds.
bool read_trajectory(const char* path, Trajectory<JointSpace>& trajectory, CsvError& error);

}  // namespace tactus
