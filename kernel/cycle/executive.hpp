// Executive: the cycle. It reads the robot, steps the pipeline, guards the command and writes it;
// then it runs the other rows that are due. Reading and writing go on in every rung. Every fault is
// a cause of the degrade ladder (kernel/cycle/ladder.hpp), and every change of rung is in the event
// log. A board runs it like this:
//
//   executive.start();                            // opens the wire
//   executive.arm();                              // requests the drives
//   while (wait for the clock, run) {
//     const Status status = executive.cycle(now);
//     if (status == Status::kArming) executive.arm();
//   }
//   executive.halt();
//   while (executive.busy()) executive.cycle(now);
//   executive.stop();                             // closes the wire
#pragma once

#include <cstdint>

#include "kernel/core/hal.hpp"
#include "kernel/cycle/clock_watch.hpp"
#include "kernel/cycle/event_log.hpp"
#include "kernel/cycle/ladder.hpp"
#include "kernel/cycle/limiting_watch.hpp"
#include "kernel/cycle/rest_watch.hpp"
#include "kernel/guard/guard.hpp"
#include "kernel/pipeline/pipeline.hpp"
#include "kernel/pipeline/rate_watch.hpp"
#include "kernel/pipeline/timing.hpp"

namespace tactus {

class Executive {
 public:
  struct Telemetry {
    Published<std::uint32_t> cycles;
    Published<std::uint32_t> slips;     ///< periods without a cycle
    Published<std::uint32_t> overruns;  ///< cycles that took longer than the period
  };

  /// Without `timing` the board has no stopwatch: nothing is timed, and there are no overruns.
  Executive(Hal& hal, Pipeline& pipeline, const Timing& timing = {})
      : hal_(hal), pipeline_(pipeline), timing_(timing) {}

  /// Adds a row after those of the pipeline. Returns kTooLarge, kBadValue or kOverBudget as
  /// ScheduleVerdict says. [init]
  [[gnu::cold]] Status add(const Row& row);

  /// Declares that the stopwatch is not the clock that triggers the cycles: overruns are counted
  /// but are no cause of the ladder. [init]
  void in_virtual_time() { judges_overruns_ = false; }

  /// Opens the wire; the drives stay disabled. Clears telemetry and times, but not the event log,
  /// which keeps what happened before. Fails as Hal::connect(). [init]
  [[gnu::cold]] Status start();

  /// Runs one cycle: read, step, guard, write, rows. Bounded; never blocks, allocates or throws.
  /// Returns kOk on the rungs nominal and skip_optional, kArming while drives are armed, below them
  /// the Status that led there, and after start() kNotStarted, or why it was refused. [cyclic]
  Status cycle(const CycleTime& now);

  /// Goes to nominal; every old target is void. From disabled it requests the drives; from then on,
  /// while it returns kArming, call it after every cycle. The first reference is then the measured
  /// state. From a hold, every command continues as it is. Returns kArming until drives and arm are
  /// ready, kNotAtRest on stop, on a hold that moves and while drives are still being disabled, and
  /// otherwise why it refuses; that is also in the event log. [between two cycles]
  [[gnu::cold]] Status arm();

  /// Brakes on the path, then disables the drives; cycle() returns kHalted, or a fault latched
  /// before. [between two cycles]
  void halt() { walk(Cause::kHalt, Status::kHalted); }
  /// Disables the drives at once and closes the wire. Returns what Hal::disconnect() does. [between
  /// two cycles]
  Status stop();

  Rung rung() const { return static_cast<Rung>(static_cast<std::uint8_t>(rung_)); }
  /// True while the arm is being brought to rest, or its drives are being disabled: cycles must go
  /// on.
  bool busy() const { return (brakes(rung()) && !rest_.at_rest()) || disabling_ > 0; }
  /// True if the arm has been at rest for `[executive] rest_ms`.
  bool at_rest() const { return rest_.still(); }
  /// Time at which the next cycle is due, ns.
  std::int64_t next_ns() const { return now_.stamp_ns + period_ns_; }
  /// The execution times, or null without a stopwatch.
  const CycleTimes* times() const { return timing_.times(); }
  const Telemetry& telemetry() const { return telemetry_; }
  const EventLog& events() const { return events_; }
  const Guard& guard() const { return guard_; }
  Status latched() const { return latched_; }

 private:
  /// The finding of a cause, for the event log.
  struct Finding {
    double value = 0.0;
    int joint = -1;
    std::uint32_t code = 0;
  };

  void check_clock(const CycleTime& now);
  void read();
  void watch_drives();
  void log_drives();
  void step();
  RobotCommand guarded();
  void write(const RobotCommand& command);
  void run_rows();
  void await_rest(int longest_ms);
  void watch_rest();
  void watch_overruns(std::uint64_t took_ns);
  void watch_times();
  void give_up_arming();

  [[gnu::cold]] Status take_over();
  [[gnu::cold]] Status resume();
  Status refuse(Status why, const Finding& found);
  Status refuse(Status why) { return refuse(why, Finding()); }
  Finding tripped() const;
  [[gnu::cold]] void watch_anew();
  bool ok_or_walk(Cause cause, Status status, const Finding& found);
  bool ok_or_walk(Cause cause, Status status) { return ok_or_walk(cause, status, Finding()); }
  void walk(Cause cause, Status status, const Finding& found);
  void walk(Cause cause, Status status) { walk(cause, status, Finding()); }
  void log(Cause cause, Status status, const Finding& found, Rung from, Rung to);
  std::int64_t cycles_of(int ms) const;

  Hal& hal_;
  Pipeline& pipeline_;
  Guard guard_;
  RobotState measured_;                              // the newest finite state
  Status wire_ = Status::kNotStarted;                // of the last exchange
  DriveRequest requested_ = DriveRequest::kDisable;  // in the last cycle
  Published<std::uint8_t> rung_ = static_cast<std::uint8_t>(Rung::kDisabled);
  bool chain_ = true;                 // the chain can be evaluated
  BrakeWay way_ = BrakeWay::kOnPath;  // of the present brake
  bool skips_ = false;                // optional rows, after overruns until clean, on any rung
  Status latched_ = Status::kNotStarted;
  std::uint8_t warned_ = 0;  // bit i: the warning of drive i is in the log since arming
  static_assert(kDof <= 8);
  std::uint32_t seen_ = 0;  // bit i: cause i is in the log since the last change of rung
  EventLog events_;

  std::int64_t period_ns_ = 0;
  CycleTime now_;
  std::int64_t commanded_ = 0;  // cycles in which the drives followed: the schedule's time
  std::int64_t arming_ = 0, disabling_ = 0;  // cycles left; 0: not under way
  bool judges_overruns_ = true;
  ClockWatch clock_;
  RateWatch overruns_;
  LimitingWatch limiting_;
  RestWatch rest_;
  Telemetry telemetry_;
  Timing timing_;
};

}  // namespace tactus
