// RunLog: log.csv, one row for every row the recorder took, and waypoints.csv for a sparse
// trajectory.
#pragma once

#include <array>
#include <cstdio>

#include "kernel/recorder.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/trajectory.hpp"

namespace tactus {

class RunLog {
 public:
  /// Opens `path` and writes the header row; false with a message on the error stream.
  bool open(const char* path, const Recording& recording);
  /// Writes everything the recorder holds.
  void drain(Recorder& recorder);
  /// False if anything could not be written.
  bool close();

 private:
  static constexpr std::size_t kMaxWidth = 1 + kMaxSignals * 8;
  void write_row(const double* row);

  std::FILE* file_ = nullptr;
  std::size_t width_ = 0;
  std::array<double, kMaxWidth> row_{};
};

/// The waypoints of a trajectory short enough to be looked at; longer ones are left out.
/// The columns are called after `reference`, the output that follows them.
bool write_waypoints(const char* path, const Trajectory<JointSpace>& trajectory,
                     const PortEntry& reference);

}  // namespace tactus
