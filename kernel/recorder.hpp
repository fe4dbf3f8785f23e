// Recorder: chosen outputs, copied every few cycles into a ring of fixed size that is read from
// outside the cycle. A full ring drops the new row and counts it; recording never waits.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "kernel/port_table.hpp"

namespace tactus {

inline constexpr int kMaxSignals = 32;
inline constexpr int kMaxTracking = 4;

/// A reference and the measurement that should follow it, of the same quantity.
struct Tracking {
  const PortEntry* reference = nullptr;
  const PortEntry* measured = nullptr;
};

/// What to record, as the pipeline file names it.
struct Recording {
  std::array<const PortEntry*, kMaxSignals> signals{};
  int signal_count = 0;
  std::array<Tracking, kMaxTracking> tracking{};
  int tracking_count = 0;

  /// Numbers in one row, the time included. [any]
  std::size_t width() const;
};

/// Copies the numbers of one output to `to`, in the order of its quantity's components; returns how
/// many. [cyclic]
int flatten(const PortEntry& port, double* to);

class Recorder {
 public:
  /// The ring uses `size` numbers at `storage`, owned by the board. [init]
  Recorder(double* storage, std::size_t size) : storage_(storage), size_(size) {}

  /// [init]
  void start(const Recording& recording);
  /// Appends one row: the time and every signal. [cyclic]
  void record(double time_s);
  /// Takes the oldest row out; false if there is none. `row` holds Recording::width() numbers.
  /// [any, one reader]
  bool take(double* row);

  std::uint32_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::uint32_t next(std::uint32_t position) const {
    return position + 1 == 2 * rows_ ? 0 : position + 1;
  }
  double* slot(std::uint32_t position) const {
    return storage_ + (position < rows_ ? position : position - rows_) * width_;
  }

  double* storage_;
  std::size_t size_;
  Recording recording_;
  std::size_t width_ = 1;
  std::uint32_t rows_ = 0;  // the ring holds this many
  // Positions count rows over two rounds of the ring, then begin again: equal means empty, one
  // round apart full.
  std::atomic<std::uint32_t> head_{0};  // where the cycle writes
  std::atomic<std::uint32_t> tail_{0};  // where the reader reads
  std::atomic<std::uint32_t> dropped_{0};
};

}  // namespace tactus
