// RunLog: writes log.csv, one line for every row of the recorder.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/pipeline/recorder.hpp"
#include "program/results/result_file.hpp"

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
  /// Closes the file. False if a row could not be written: prints the reason to stderr, and how
  /// many rows the file holds of those that were recorded.
  bool close();

 private:
  static constexpr std::size_t kMaxWidth = 1 + kMaxSignals * 8;
  void write_row(const double* row);

  ResultFile file_;
  std::size_t width_ = 0;
  std::int64_t rows_ = 0;
  std::array<double, kMaxWidth> row_{};
};

}  // namespace tactus
