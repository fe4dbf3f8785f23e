// CycleTimes: execution times of every stage of the cycle, every block and every row, in memory
// that a board with a stopwatch owns. Timing: the stopwatch that fills them. Any thread may read
// the times while the cycle writes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/core/histogram.hpp"
#include "kernel/core/names.hpp"
#include "kernel/pipeline/schedule.hpp"

namespace tactus {

enum class Stage : std::uint8_t { kRead, kStep, kGuard, kWrite, kRows, kCycle };

constexpr const char* name(Stage stage) {
  switch (stage) {
    case Stage::kRead: return "read";
    case Stage::kStep: return "step";
    case Stage::kGuard: return "guard";
    case Stage::kWrite: return "write";
    case Stage::kRows: return "rows";
    case Stage::kCycle: return "cycle";
  }
  return nullptr;
}

inline constexpr int kMaxBlocks = 12;

class CycleTimes {
 public:
  /// Removes all times. [init]
  void clear() {
    for (Histogram& times : stages_) times.clear();
    for (Histogram& times : blocks_) times.clear();
    for (Histogram& times : rows_) times.clear();
    for (Published<std::uint32_t>& count : row_overruns_) count = 0;
  }

  const Histogram& stage(Stage stage) const { return stages_[static_cast<std::size_t>(stage)]; }
  const Histogram& block(int i) const { return blocks_[static_cast<std::size_t>(i)]; }
  const Histogram& row(int i) const { return rows_[static_cast<std::size_t>(i)]; }
  /// Cycles in which a row took longer than its budget. [any]
  std::uint32_t row_overruns(int i) const { return row_overruns_[static_cast<std::size_t>(i)]; }

 private:
  friend class Timing;

  std::array<Histogram, kNames<Stage>.size()> stages_;
  std::array<Histogram, kMaxBlocks> blocks_;
  std::array<Histogram, kMaxRows> rows_;
  std::array<Published<std::uint32_t>, kMaxRows> row_overruns_;
};

class Timing {
 public:
  /// A free-running count of ns for execution times, given by the board.
  using Stopwatch = std::uint64_t (*)();

  /// CycleTimes are not measured.
  Timing() = default;
  Timing(Stopwatch stopwatch, CycleTimes& times) : stopwatch_(stopwatch), times_(&times) {}

  /// Removes all times. [init]
  void clear() {
    if (measures()) times_->clear();
  }

  /// Begins a cycle, whose times are kept or not. [cyclic]
  void begin(bool kept) {
    kept_ = kept;
    mark();
  }
  /// Reads the stopwatch and begins an interval. [cyclic]
  void mark() {
    if (measures()) mark_ns_ = stopwatch_();
  }
  /// Value of the stopwatch at the last reading, ns.
  std::uint64_t marked() const { return mark_ns_; }

  /// Ends the interval since the last reading and begins the next. [cyclic]
  void lap(Stage stage) {
    if (measures()) end(times_->stages_[static_cast<std::size_t>(stage)]);
  }
  void lap_block(int block) {
    if (measures()) end(times_->blocks_[static_cast<std::size_t>(block)]);
  }

  /// Adds and returns the interval from `begin` to the last reading, ns. [cyclic]
  std::uint64_t close(Stage stage, std::uint64_t begin) {
    if (keeps()) times_->stages_[static_cast<std::size_t>(stage)].add(mark_ns_ - begin);
    return mark_ns_ - begin;
  }
  /// Ends a row that began at `begin`; longer than its budget counts as an overrun of the row.
  /// [cyclic]
  void end_row(int row, const Row& what, std::uint64_t begin) {
    mark();
    if (!keeps()) return;
    const auto i = static_cast<std::size_t>(row);
    times_->rows_[i].add(mark_ns_ - begin);
    if (mark_ns_ - begin > std::uint64_t{1000} * static_cast<std::uint64_t>(what.budget_us))
      ++times_->row_overruns_[i];
  }

  bool measures() const { return stopwatch_ != nullptr; }
  /// The times, or null if they are not measured.
  const CycleTimes* times() const { return times_; }

 private:
  bool keeps() const { return kept_ && measures(); }
  void end(Histogram& times) {
    const std::uint64_t begin_ns = mark_ns_;
    mark();
    if (keeps()) times.add(mark_ns_ - begin_ns);
  }

  Stopwatch stopwatch_ = nullptr;
  CycleTimes* times_ = nullptr;
  std::uint64_t mark_ns_ = 0;
  bool kept_ = false;
};

}  // namespace tactus
