// Recorder: copies chosen outputs every few cycles into a ring of fixed size, which is read outside
// the cycle. A full ring drops the new row and counts it; recording never waits.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "kernel/core/ring_positions.hpp"
#include "kernel/pipeline/port_table.hpp"

namespace tactus {

inline constexpr int kMaxSignals = 32;
inline constexpr int kMaxTracking = 4;

/// A reference and the measurement that should follow it, of the same quantity.
struct Tracking {
  const PortEntry* reference = nullptr;
  const PortEntry* measured = nullptr;
};

/// The outputs to record, as the pipeline file names them.
struct Recording {
  std::array<const PortEntry*, kMaxSignals> signals{};
  int signal_count = 0;
  std::array<Tracking, kMaxTracking> tracking{};
  int tracking_count = 0;

  /// Numbers in one row, the time included. [any]
  std::size_t width() const;
};

/// Copies the numbers of one output to `to`, in the order of its quantity's components; returns
/// their number. [cyclic]
int flatten(const PortEntry& port, double* to);

class Recorder {
 public:
  /// The ring uses `size` numbers at `storage`, owned by the board. [init]
  Recorder(double* storage, std::size_t size) : storage_(storage), size_(size) {}

  /// [init]
  void start(const Recording& recording);
  /// Appends one row: the time and every signal. [cyclic]
  void record(double time_s);
  /// Removes the oldest row; false if there is none. `row` holds Recording::width() numbers.
  /// [any, one reader]
  bool take(double* row);

  std::uint32_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  double* slot(std::uint32_t row) const { return storage_ + row * width_; }

  double* storage_;
  std::size_t size_;
  Recording recording_;
  std::size_t width_ = 1;
  RingPositions<> positions_;
  std::atomic<std::uint32_t> dropped_{0};
};

}  // namespace tactus
