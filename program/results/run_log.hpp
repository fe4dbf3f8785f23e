// RunLog: writes log.csv, one line for every row of the recorder.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "kernel/pipeline/pipeline.hpp"
#include "kernel/pipeline/recorder.hpp"
#include "program/results/result_file.hpp"

namespace tactus {

/// Returns "block.port_component", the column of one recorded number of an output.
Text<2 * kMaxNameLength + 16> column_name(const PortEntry& port, int number);

/// Writes ",block.port_component" for every recorded component of an output.
void write_names(std::FILE* file, const PortEntry& port);

/// Lets the recorder record rows from the first cycle on. [init]
void start_recorder(Recorder& recorder, Pipeline& pipeline);

class RunRecording;

class RunLog {
 public:
  /// Opens `path` and writes the header row. False: prints the reason to stderr.
  bool open(const char* path, const Recording& recording);
  /// Has every row written to a recording, too, or to it alone if no file is opened.
  void record(RunRecording& recording) { recording_ = &recording; }
  RunRecording* recording() const { return recording_; }
  /// Writes no more rows than these; later ones are counted.
  void limit(std::int64_t rows) { most_ = rows; }
  /// Rows that were left out.
  std::int64_t left_out() const { return left_out_; }
  /// Writes all rows that the recorder holds, and to a recording the events since the last call.
  void drain(Recorder& recorder);
  /// Closes the file. False if a row could not be written: prints the reason to stderr, and how
  /// many rows the file holds of those that were recorded.
  bool close();

 private:
  static constexpr std::size_t kMaxWidth = 1 + kMaxSignals * 8;
  void write_row(const double* row);

  ResultFile file_;
  RunRecording* recording_ = nullptr;  // null: none
  std::size_t width_ = 0;
  std::int64_t rows_ = 0, left_out_ = 0;
  std::int64_t most_ = std::numeric_limits<std::int64_t>::max();
  std::array<double, kMaxWidth> row_{};
};

}  // namespace tactus
