// Reader of trajectory files: CSV with one header row that names quantity and unit. The columns may
// be in any order, '#' begins a comment line, empty lines are skipped. The columns of the joints,
// with numbers or names (q_fer_joint1_rad):
//
//   time_s, q1_rad ... q7_rad [, dq1_rad_s ...] [, ddq1_rad_s2 ...] [, tau1_Nm ...]
//
// and of the tool tip in the base frame, with the wrench that the environment exerts on the tool:
//
//   time_s, x_m, y_m, z_m, qw, qx, qy, qz
//   [, vx_m_s, vy_m_s, vz_m_s, wx_rad_s, wy_rad_s, wz_rad_s]
//   [, ax_m_s2, ay_m_s2, az_m_s2, alphax_rad_s2, alphay_rad_s2, alphaz_rad_s2]
//   [, fx_N, fy_N, fz_N, mx_Nm, my_Nm, mz_Nm]
//
// A group in brackets is given completely or left out.
#pragma once

#include "kernel/core/load_error.hpp"
#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

/// Place and reason of a refusal. Lines and columns count from 1; 0: none in particular.
struct CsvError {
  int line = 0, column = 0;
  Name header;  ///< header of the column
  Message reason;

  /// Returns "line:column: header: reason" without the parts that are empty.
  PlacedMessage message() const;
};

/// Fills `trajectory` from the file at `path`. Returns false if the file is refused; the trajectory
/// must not be used then. Refuses cells that are empty, no number, NaN or infinite, and more
/// waypoints than fit into the store. With `partial` a file may leave out joints, the same in every
/// group; they are held.
template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error);

}  // namespace tactus
