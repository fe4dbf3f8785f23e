// Trace: everything that goes out of a run, value after value in one order, as a hash over all of
// it and, for chosen cycles, value by value. A value is hashed as its eight bytes, so that a
// negative zero and the bits of a NaN count too, and neither the size of an integer nor the order
// of its bytes depends on the machine.
#pragma once

#include <cstdint>

#include "kernel/core/types.hpp"
#include "kernel/pipeline/port_table.hpp"

namespace tactus {

/// The cycles to print, from 0: every `step`-th of first..last with the hash up to its end, or with
/// its values if `step` is 0.
struct TraceWindow {
  std::uint32_t first = 0, last = 0xffffffff, step = 0;
};

/// Sixteen digits.
Text<16> hexadecimal(std::uint64_t bits);

class Trace {
 public:
  using Print = void (*)(const char* line);

  /// Prints lines with `print`: "CYCLE HASH", or "CYCLE NAME INDEX BITS" with BITS in hexadecimal.
  Trace(const TraceWindow& window, Print print) : window_(window), print_(print) {}

  void add(const char* name, double value);
  void add(const char* name, std::uint64_t value);
  void add(const char* name, const double* values, int count);
  template <int count>
  void add(const char* name, const Eigen::Matrix<double, count, 1>& vector) {
    add(name, vector.data(), count);
  }
  void add(const char* name, const Pose& pose);
  /// Adds an output of the pipeline, called block.port.
  void add(const PortEntry& port);
  /// Ends a cycle; what is added next belongs to the following one.
  void end_cycle();

  std::uint64_t hash() const { return hash_; }
  std::uint32_t cycles() const { return cycles_; }

 private:
  bool in_window() const { return cycles_ >= window_.first && cycles_ <= window_.last; }
  bool prints_values() const { return window_.step == 0 && in_window(); }
  void add_bits(const char* name, int index, std::uint64_t bits);

  TraceWindow window_;
  Print print_;
  std::uint64_t hash_ = 0xcbf29ce484222325U;  // of nothing
  std::uint32_t cycles_ = 0;
};

}  // namespace tactus
