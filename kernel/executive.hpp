// Executive: the cycle. Reads the robot, steps the pipeline, guards the command, writes it; then
// the rows that are due. The first Status that is not kOk stops the robot and is latched until the
// next start.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/guard/guard.hpp"
#include "kernel/hal.hpp"
#include "kernel/histogram.hpp"
#include "kernel/pipeline.hpp"

namespace tactus {

/// When a cycle began, by the clock that triggers it, which is never negative. The kernel reads no
/// clock of its own.
struct CycleTime {
  std::int64_t stamp_ns = 0;
};

enum class Stage : std::uint8_t { kRead, kStep, kGuard, kWrite, kRows, kCycle };
inline constexpr std::array<const char*, 6> kStageNames = {"read",  "step", "guard",
                                                           "write", "rows", "cycle"};

/// Something slower than the control loop: runs in every cycle whose number is offset modulo
/// divisor.
struct Row {
  const char* name = "";
  int divisor = 1, offset = 0;
  void (*run)(void* context, double time_s) = nullptr;
  void* context = nullptr;
};

class Executive {
 public:
  /// A free-running count of ns for execution times, given by the board; null: times are not
  /// measured.
  using Stopwatch = std::uint64_t (*)();

  struct Telemetry {
    std::int64_t cycles = 0;
    std::int64_t slips = 0;     ///< periods in which no cycle began
    std::int64_t overruns = 0;  ///< cycles that took longer than the period
  };

  Executive(Hal& hal, Pipeline& pipeline, Stopwatch stopwatch)
      : hal_(hal), pipeline_(pipeline), stopwatch_(stopwatch) {}

  /// Adds a row; kTooLarge if there is no place, kBadValue unless 0 <= offset < divisor and there
  /// is something to run. [init]
  Status add(const Row& row);

  /// Attaches to the robot and starts guard and blocks from the state it holds: nothing moves.
  /// Telemetry and times begin anew. [init]
  Status start();

  /// One cycle: read, step, guard, write, rows. Bounded; never blocks, allocates or throws.
  /// Returns the latched Status, kNotStarted before start(). [cyclic]
  Status cycle(const CycleTime& now);

  /// Stops the robot; cycles return kNotStarted until the next start. [any]
  void stop();

  const Histogram& times(Stage stage) const { return times_[static_cast<std::size_t>(stage)]; }
  const Telemetry& telemetry() const { return telemetry_; }
  const Guard& guard() const { return guard_; }
  Status latched() const { return latched_; }

 private:
  static constexpr std::size_t kMaxRows = 8;

  Status run(const CycleTime& now);
  Status check_clock(const CycleTime& now);
  void run_rows();
  void lap(Stage stage);

  Hal& hal_;
  Pipeline& pipeline_;
  Stopwatch stopwatch_;
  Guard guard_;
  RobotState measured_;
  Status latched_ = Status::kNotStarted;
  std::int64_t period_ns_ = 0, stamp_ns_ = 0;
  int early_ = 0;  // cycles in a row that began less than half a period after the last
  std::array<Row, kMaxRows> rows_;
  std::size_t row_count_ = 0;
  Telemetry telemetry_;
  std::uint64_t lap_ns_ = 0;
  std::array<Histogram, kStageNames.size()> times_;
};

}  // namespace tactus
