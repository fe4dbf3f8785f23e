// Executive: the cycle. Reads the robot, steps the pipeline, guards the command, writes it; then
// the rows that are due. What goes wrong walks the degrade ladder (kernel/ladder.hpp), and every
// change of rung is in the event log.
#pragma once

#include <cstdint>

#include "kernel/event_log.hpp"
#include "kernel/guard/guard.hpp"
#include "kernel/hal.hpp"
#include "kernel/ladder.hpp"
#include "kernel/limiting_watch.hpp"
#include "kernel/overrun_watch.hpp"
#include "kernel/pipeline.hpp"
#include "kernel/rest_watch.hpp"
#include "kernel/timing.hpp"

namespace tactus {

/// When a cycle began, by the clock that triggers it, which is never negative. The kernel reads no
/// clock of its own.
struct CycleTime {
  std::int64_t stamp_ns = 0;
};

class Executive {
 public:
  using Stopwatch = Timing::Stopwatch;

  struct Telemetry {
    Shown<std::uint32_t> cycles;
    Shown<std::uint32_t> slips;     ///< periods in which no cycle began
    Shown<std::uint32_t> overruns;  ///< cycles that took longer than the period
  };

  Executive(Hal& hal, Pipeline& pipeline, Stopwatch stopwatch)
      : hal_(hal), pipeline_(pipeline), timing_(stopwatch) {}

  /// Adds a row behind those of the pipeline; kTooLarge, kBadValue or kOverBudget as
  /// ScheduleVerdict says. [init]
  Status add(const Row& row);

  /// The stopwatch is not of the clock that triggers the cycles: overruns are counted, and no cause
  /// of the ladder. [init]
  void in_virtual_time() { judges_overruns_ = false; }

  /// Attaches to the robot and starts guard and blocks from the state it holds: nothing moves.
  /// Telemetry, times and events begin anew. Not kOk: the drives are disabled. [init]
  Status start();

  /// One cycle: read, step, guard, write, rows. Bounded; never blocks, allocates or throws. kOk on
  /// the rungs nominal and skip_optional, then the Status that led below them; kNotStarted before
  /// start(). While it brakes or holds, cycles must go on. [cyclic]
  Status cycle(const CycleTime& now);

  /// Back to nominal from hold or disabled, where the arm is: the first reference is what was
  /// measured, every old target is void. kNotAtRest while it brakes; what a start finds wrong
  /// otherwise, and the rung stays. [between two cycles]
  Status rearm();

  /// Brakes on the path, then disables the drives; cycles return kHalted. [between two cycles]
  void halt() { move(Cause::kHalt, Status::kHalted, 0.0); }
  /// Disables the drives at once; cycles return kNotStarted until the next start. [between two
  /// cycles]
  void stop();

  Rung rung() const { return static_cast<Rung>(static_cast<std::uint8_t>(rung_)); }
  /// The arm is being brought to rest: cycles must go on.
  bool braking() const { return brakes(rung()) && !rest_.at_rest(); }
  /// When the next cycle is due, ns.
  std::int64_t next_ns() const { return stamp_ns_ + period_ns_; }
  const Timing& timing() const { return timing_; }
  const Histogram& times(Stage stage) const { return timing_.stage(stage); }
  const Telemetry& telemetry() const { return telemetry_; }
  const EventLog& events() const { return events_; }
  const Guard& guard() const { return guard_; }
  Status latched() const { return latched_; }

 private:
  static Status run_control(void* executive, const RobotState& measured, double time_s);
  Status attach();
  void control();
  bool accept(const RobotState& state);
  bool decide(RobotCommand& command);
  bool enabled() const { return rung() != Rung::kDisabled; }
  bool passes(Cause cause, Status status, double value = 0.0);
  void move(Cause cause, Status status, double value);
  void check_clock(const CycleTime& now);
  void watch_anew();
  void watch_limiting();
  void watch_rest();
  void watch_overruns(std::uint64_t took_ns);
  void run_rows();

  Hal& hal_;
  Pipeline& pipeline_;
  Guard guard_;
  RobotState measured_;  // the newest that was finite
  Shown<std::uint8_t> rung_ = static_cast<std::uint8_t>(Rung::kDisabled);
  bool chain_ = true;                 // it can be evaluated
  BrakeWay way_ = BrakeWay::kOnPath;  // of the brake that is on
  bool skips_ = false;  // optional rows, since overruns and until they are over, on any rung
  Status latched_ = Status::kNotStarted;
  EventLog events_;

  std::int64_t period_ns_ = 0, stamp_ns_ = 0, cycles_ = 0;
  int early_ = 0;  // cycles in a row that began less than half a period after the last
  bool judges_overruns_ = true;
  OverrunWatch overruns_;
  LimitingWatch limiting_;
  RestWatch rest_;
  Telemetry telemetry_;
  Timing timing_;
};

}  // namespace tactus
