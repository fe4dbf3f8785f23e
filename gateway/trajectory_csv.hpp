// Trajectory files: CSV with one header row that names quantity and unit. Columns in any order, '#'
// begins a comment line, empty lines are skipped. Of the joints, whose names may stand for their
// numbers (q_fer_joint1_rad):
//
//   time_s, q1_rad ... q7_rad [, dq1_rad_s ...] [, ddq1_rad_s2 ...] [, tau1_Nm ...]
//
// and of the tool tip in the base frame, the wrench being what the environment exerts on the tool:
//
//   time_s, x_m, y_m, z_m, qw, qx, qy, qz
//   [, vx_m_s, vy_m_s, vz_m_s, wx_rad_s, wy_rad_s, wz_rad_s]
//   [, ax_m_s2, ay_m_s2, az_m_s2, alphax_rad_s2, alphay_rad_s2, alphaz_rad_s2]
//   [, fx_N, fy_N, fz_N, mx_Nm, my_Nm, mz_Nm]
//
// A group in brackets is given whole or left out.
#pragma once

#include "kernel/load_error.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"
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
/// store holds. With `partial` a file may leave out joints, the same in every group; they hold.
template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error);

}  // namespace tactus
