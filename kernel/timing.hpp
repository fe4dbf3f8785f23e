// Timing: how long every stage of the cycle, every block and every row took. Any thread reads while
// the cycle writes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/histogram.hpp"
#include "kernel/schedule.hpp"

namespace tactus {

enum class Stage : std::uint8_t { kRead, kStep, kGuard, kWrite, kRows, kCycle };
inline constexpr std::array<const char*, 6> kStageNames = {"read",  "step", "guard",
                                                           "write", "rows", "cycle"};
inline constexpr int kMaxBlocks = 12;

class Timing {
 public:
  /// A free-running count of ns for execution times, given by the board; null: times are not
  /// measured.
  using Stopwatch = std::uint64_t (*)();

  explicit Timing(Stopwatch stopwatch) : stopwatch_(stopwatch) {}

  /// Forgets everything. [init]
  void clear() {
    for (Histogram& times : stages_) times.clear();
    for (Histogram& times : blocks_) times.clear();
    for (Histogram& times : rows_) times.clear();
    for (Shown<std::uint32_t>& count : row_overruns_) count = 0;
  }

  /// Reads the stopwatch: what follows begins now. [cyclic]
  void mark() {
    if (measures()) mark_ns_ = stopwatch_();
  }
  /// The stopwatch when it was read last.
  std::uint64_t marked() const { return mark_ns_; }

  /// What began with the last mark ends now, and the next begins. [cyclic]
  void lap(Stage stage) { end(stages_[index(stage)]); }
  void lap_block(int block) { end(blocks_[static_cast<std::size_t>(block)]); }

  /// What began at `begin` ended with the last mark; ns. [cyclic]
  std::uint64_t close(Stage stage, std::uint64_t begin) {
    if (measures()) stages_[index(stage)].add(mark_ns_ - begin);
    return mark_ns_ - begin;
  }
  /// A row ends now that began at `begin`; longer than its budget is an overrun of its own.
  /// [cyclic]
  void end_row(int row, const Row& what, std::uint64_t begin) {
    if (!measures()) return;
    mark();
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
  static std::size_t index(Stage stage) { return static_cast<std::size_t>(stage); }
  void end(Histogram& times) {
    if (!measures()) return;
    const std::uint64_t begin_ns = mark_ns_;
    mark();
    times.add(mark_ns_ - begin_ns);
  }

  Stopwatch stopwatch_;
  std::uint64_t mark_ns_ = 0;
  std::array<Histogram, kStageNames.size()> stages_;
  std::array<Histogram, kMaxBlocks> blocks_;
  std::array<Histogram, kMaxRows> rows_;
  std::array<Shown<std::uint32_t>, kMaxRows> row_overruns_;
};

}  // namespace tactus
