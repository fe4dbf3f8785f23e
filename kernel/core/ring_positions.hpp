// RingPositions: the next row of a ring that its one writer fills, and the next that its one reader
// takes out. Positions count rows over two rounds of the ring, then restart: equal positions mean
// empty, one round apart full.
#pragma once

#include <atomic>
#include <cstdint>

namespace tactus {

/// `Atomic` is std::atomic, except in the test that explores the memory orders.
template <template <class> class Atomic = std::atomic>
class RingPositions {
 public:
  /// Empties the ring and sets its number of rows; no other thread may use it during the call.
  /// [init]
  void start(std::uint32_t rows) {
    rows_ = rows;
    head_.store(0, std::memory_order_relaxed);
    tail_.store(0, std::memory_order_relaxed);
  }

  /// Sets the row to write; returns false if the ring is full. [cyclic, writer only]
  bool to_write(std::uint32_t& row) const {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    const std::uint32_t tail = tail_.load(std::memory_order_acquire);
    row = row_at(head);
    return (head >= tail ? head - tail : head + 2 * rows_ - tail) != rows_;
  }
  /// Publishes the row. [cyclic, writer only]
  void written() {
    head_.store(next(head_.load(std::memory_order_relaxed)), std::memory_order_release);
  }

  /// Sets the row to read; returns false if the ring is empty. [any, reader only]
  bool to_read(std::uint32_t& row) const {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    row = row_at(tail);
    return tail != head_.load(std::memory_order_acquire);
  }
  /// Frees the row. [any, reader only]
  void was_read() {
    tail_.store(next(tail_.load(std::memory_order_relaxed)), std::memory_order_release);
  }

 private:
  std::uint32_t next(std::uint32_t position) const {
    return position + 1 == 2 * rows_ ? 0 : position + 1;
  }
  std::uint32_t row_at(std::uint32_t position) const {
    return position < rows_ ? position : position - rows_;
  }

  std::uint32_t rows_ = 0;
  Atomic<std::uint32_t> head_{0};  // where the cycle writes
  Atomic<std::uint32_t> tail_{0};  // where the reader reads
};

}  // namespace tactus
