// RunLog: writes log.csv, one line for every row of the recorder.
#pragma once

#include <array>
#include <cstdio>

#include "kernel/pipeline/recorder.hpp"

namespace tactus {

/// Returns "block.port_component", the column of one recorded number of an output.
Text<2 * kMaxNameLength + 16> column_name(const PortEntry& port, int number);

/// Writes ",block.port_component" for every recorded component of an output.
void write_names(std::FILE* file, const PortEntry& port);

class RunLog {
 public:
  /// Opens `path` and writes the header row. False: prints the reason to stderr.
  bool open(const char* path, const Recording& recording);
  /// Writes all rows that the recorder holds.
  void drain(Recorder& recorder);
  /// Closes the file. False if anything could not be written.
  bool close();

 private:
  static constexpr std::size_t kMaxWidth = 1 + kMaxSignals * 8;
  void write_row(const double* row);

  std::FILE* file_ = nullptr;
  std::size_t width_ = 0;
  std::array<double, kMaxWidth> row_{};
};

}  // namespace tactus
