// Timing: execution times of every stage of the cycle, every block and every row. Any thread may
// read while the cycle writes.
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

class Timing {
 public:
  /// A free-running count of ns for execution times, given by the board; null: times are not
  /// measured.
  using Stopwatch = std::uint64_t (*)();

  explicit Timing(Stopwatch stopwatch) : stopwatch_(stopwatch) {}

  /// Removes all times. [init]
  void clear() {
    for (Histogram& times : stages_) times.clear();
    for (Histogram& times : blocks_) times.clear();
    for (Histogram& times : rows_) times.clear();
    for (Published<std::uint32_t>& count : row_overruns_) count = 0;
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
  void lap(Stage stage) { end(stages_[index(stage)]); }
  void lap_block(int block) { end(blocks_[static_cast<std::size_t>(block)]); }

  /// Adds and returns the interval from `begin` to the last reading, ns. [cyclic]
  std::uint64_t close(Stage stage, std::uint64_t begin) {
    if (keeps()) stages_[index(stage)].add(mark_ns_ - begin);
    return mark_ns_ - begin;
  }
  /// Ends a row that began at `begin`; longer than its budget counts as an overrun of the row.
  /// [cyclic]
  void end_row(int row, const Row& what, std::uint64_t begin) {
    mark();
    if (!keeps()) return;
    const auto i = static_cast<std::size_t>(row);
    rows_[i].add(mark_ns_ - begin);
    if (mark_ns_ - begin > std::uint64_t{1000} * static_cast<std::uint64_t>(what.budget_us))
      ++row_overruns_[i];
  }

  bool measures() const { return stopwatch_ != nullptr; }
  const Histogram& stage(Stage stage) const { return stages_[index(stage)]; }
  const Histogram& block(int i) const { return blocks_[static_cast<std::size_t>(i)]; }
  const Histogram& row(int i) const { return rows_[static_cast<std::size_t>(i)]; }
  /// Cycles in which a row took longer than its budget. [any]
  std::uint32_t row_overruns(int i) const { return row_overruns_[static_cast<std::size_t>(i)]; }

 private:
  bool keeps() const { return kept_ && measures(); }
  static std::size_t index(Stage stage) { return static_cast<std::size_t>(stage); }
  void end(Histogram& times) {
    const std::uint64_t begin_ns = mark_ns_;
    mark();
    if (keeps()) times.add(mark_ns_ - begin_ns);
  }

  Stopwatch stopwatch_;
  std::uint64_t mark_ns_ = 0;
  bool kept_ = false;
  std::array<Histogram, kNames<Stage>.size()> stages_;
  std::array<Histogram, kMaxBlocks> blocks_;
  std::array<Histogram, kMaxRows> rows_;
  std::array<Published<std::uint32_t>, kMaxRows> row_overruns_;
};

}  // namespace tactus
