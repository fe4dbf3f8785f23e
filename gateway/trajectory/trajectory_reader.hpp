// TrajectoryReader: the waypoints of a trajectory file, one after the other, whatever its length:
// CSV with one header row that names quantity and unit. The columns may be in any order, '#' begins
// a comment line, empty lines are skipped. The columns of the joints, with numbers or names
// (q_fer_joint1_rad):
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
// A group in brackets is given completely or left out. The log of a run is such a file too, by the
// outputs of the reference generator in it: jrg.q_d_1, jrg.dq_d_1, trg.x_d_x, trg.v_d_vx, ...
#pragma once

#include "gateway/joint_turns.hpp"
#include "gateway/trajectory/line_reader.hpp"
#include "gateway/trajectory/smoothing/digits.hpp"
#include "gateway/trajectory/trajectory_columns.hpp"

namespace tactus {

/// Place and reason of a refusal. Lines and columns count from 1; 0: none in particular.
struct CsvError {
  int line = 0, column = 0;
  Name header;  ///< header of the column
  Message reason;

  /// Returns "line:column: header: reason" without the parts that are empty.
  PlacedMessage message() const;
};

enum class RowResult : std::uint8_t {
  kWaypoint,
  kEnd,      // there are no more waypoints
  kRefused,  // the error has the reason
  kNotYet,   // a pipe had no whole row within the time to wait
};

template <class Space>
class TrajectoryReader {
 public:
  /// Opens a file; the hash of its bytes continues `hash`. With `partial` a file may leave out
  /// joints, the same in every group; they are held. False: refused. [init]
  bool open(const char* path, bool partial, std::uint64_t hash, CsvError& error);
  /// Returns to the first waypoint; only of a regular file. False: refused. [init]
  bool rewind(CsvError& error);
  /// Takes the next waypoint, in SI units. Refuses cells that are empty, no number, NaN or
  /// infinite, and a file without header or waypoints. Waits for a pipe at most `wait_ms`;
  /// negative: until it has a row or is closed. [any, not cyclic]
  RowResult next(Waypoint<Space>& waypoint, CsvError& error, int wait_ms = -1);

  /// Sets how the angles of joints without end are taken, from the next open() or rewind() on.
  /// [init]
  void take_angles(Wrap wrap, const JointVector& reference) { turns_.begin(wrap, reference); }
  /// Findings about their turns since open() or rewind().
  const JointTurns& turns() const { return turns_; }

  /// Fields that are given; known once a waypoint was taken.
  Fields fields() const { return columns_.fields(); }
  /// Writes the joints that are left out, and that a log has no frames, into the header; once a
  /// waypoint was taken.
  void note_terms(typename Space::Header& header) const { columns_.note_terms(header); }
  /// Returns half of a unit in the last digit of each number of a waypoint, in SI units, by the
  /// digits of all rows that were taken since the file was opened. [any]
  Waypoint<Space> half_units(const Waypoint<Space>& waypoint) const;
  const LineReader& lines() const { return lines_; }

 private:
  RowResult end(CsvError& error) const;

  LineReader lines_;
  Columns<Space> columns_{false};
  JointTurns turns_;
  std::array<Digits, Columns<Space>::kMost> digits_;
  bool partial_ = false;
  char separator_ = ',';
  std::int64_t rows_ = 0;
};

/// Fills `trajectory` from the file at `path`. Returns false if the file is refused; the trajectory
/// must not be used then. Refuses what TrajectoryReader refuses, and more waypoints than fit into
/// the store. With `partial` a file may leave out joints, the same in every group; they are held.
/// [init]
template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error);

}  // namespace tactus
