// RunLoop: the cycles of a run, in lock-step with the plant's virtual time, by the wall clock or by
// the robot's clock, with tracking errors and heap calls of each.
#pragma once

#include <limits>

#include "program/cycle_endpoint.hpp"
#include "program/results/log_writer.hpp"
#include "program/results/progress.hpp"
#include "program/results/run_log.hpp"
#include "program/results/run_recording.hpp"
#include "program/results/summary.hpp"
#include "program/trajectory_feed.hpp"
#include "program/watchdog_thread.hpp"

namespace tactus {

/// Makes SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGTSTP, which would stop the cycles of an arm that
/// moves, end the loop instead of the program, and writing to a closed pipe or beyond a limit of
/// size an error instead of its end.
void catch_interrupts();

void end_with(RunResult& result, int code, const char* name);
/// The same for a run that a Status ended.
void end_with(RunResult& result, Status fault);

inline constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

/// Length of a run, in cycles in which the arm is commanded.
struct RunLength {
  std::int64_t cycles = kUnlimited;  ///< until then; unlimited: until the trajectory has settled
  bool fixed = false;  ///< the user's; else a trajectory that has to wait for its file gets longer
};

class RunLoop {
 public:
  RunLoop(Session& session, TrajectoryInput& input, TrajectoryFeed& feed, WatchdogThread& watchdog,
          RunResult& result, RunLength length)
      : session_(session),
        input_(input),
        feed_(feed),
        watchdog_(watchdog),
        result_(result),
        length_(length),
        goal_(session, input) {}

  /// Serves clients instead of following a trajectory: faults end no cycles, as a client may rearm;
  /// only a signal does. [init]
  void serve(CycleEndpoint& endpoint) { endpoint_ = &endpoint; }
  /// Notes phases of the reference and reports in a recording. [init]
  void record(RunRecording& recording) { recording_ = &recording; }
  /// Advances the executive's time by one period in every cycle, so that late cycles are no fault.
  /// [init]
  void in_virtual_time() { virtual_ = true; }
  /// Connects to the robot and requests its drives. False: refused.
  bool start();
  /// Takes the robot's report of a fault, disables its drives and closes the wire. The loops do so
  /// at once after their last cycle: drives watch for the commands of every cycle.
  void stop();
  /// The fault that ended the cycles, and the robot's words on it.
  Status latched() const { return fault_.verdict.status; }
  const FaultVerdict& fault() const { return fault_; }
  const Message& trouble() const { return trouble_; }
  /// kOk, or why the drives may not be disabled, and the robot's words on it.
  Status left() const { return left_; }
  const Message& left_trouble() const { return left_trouble_; }
  /// True once the arm has been commanded.
  bool armed() const { return armed_; }
  /// True if the arm has never been commanded, or was being armed again, when a signal arrived, and
  /// no fault is the reason.
  bool cut_while_arming() const { return latched() == Status::kHalted && (unarmed_ || !armed_); }
  /// True if a signal arrived while the robot was being connected to.
  bool cut_short() const { return cut_short_; }
  /// True if the time of the run has passed, and nothing else ended it.
  bool ended_as_planned() const { return planned_end_; }
  /// Cycles in which it has been, and their time.
  std::int64_t commanded() const { return commanded_; }
  double time_s() const;
  /// Why the arm or the trajectory was refused, or the run ended before the trajectory did; empty
  /// if nothing more is known than the name of the result. Call it after stop().
  Reason why() const;
  /// Why the generator has given its goal up, by an error of its own axis; empty if it has not.
  Reason gave_up() const { return end_.axis < 0 ? Reason() : goal_.given_up(end_); }
  /// Runs cycles as fast as the host can and logs the rows after each.
  void in_lock_step(RunLog& log, Progress& progress);
  /// Runs each cycle at its time by the monotonic clock; the writer logs rows and shows progress.
  /// Missed periods are left out, and the plant does not move in them.
  void in_real_time(LogWriter& writer, Progress& progress);
  /// Runs each cycle when the robot begins it, otherwise as in real time. There are no latencies:
  /// the stamps are the robot's.
  void at_robots_pace(Clock& clock, LogWriter& writer, Progress& progress);

 private:
  /// Runs one cycle, triggers the watchdog, counts its heap calls and adds its tracking errors.
  /// False: the run is over, the arm is at rest, and drives that were disabled are.
  bool cycle(const CycleTime& now);
  bool arm();
  void halt();
  bool follow();
  void count_starving();
  void feed();
  void break_off();
  void take_result(Status status);
  bool time_has_passed() const;
  bool over(Status status);
  bool served(Status status);
  CycleTime time_of(const CycleTime& now);

  Session& session_;
  TrajectoryInput& input_;
  TrajectoryFeed& feed_;
  WatchdogThread& watchdog_;
  RunResult& result_;
  RunLength length_;
  GoalWatch goal_;
  CycleEndpoint* endpoint_ = nullptr;  // of a server; null: none
  RunRecording* recording_ = nullptr;  // null: none
  bool virtual_ = false;
  std::int64_t virtual_ns_ = 0;
  std::int64_t began_ns_ = 0;  // the present cycle, by the monotonic clock, whatever triggers it
  Verdict end_;                // of the goal's final report
  double ended_s_ = 0.0;       // when the time of the run had passed
  bool pending_ = false;       // the goal was sent, and its final report has not arrived
  std::int64_t commanded_ = 0;
  FaultVerdict fault_;
  Status left_ = Status::kOk;
  Message trouble_, left_trouble_;
  bool armed_ = false;
  bool planned_end_ = false, cut_short_ = false;
  bool refused_ = false;     // the trajectory was refused
  bool halted_ = false;      // a signal has arrived
  bool unarmed_ = false;     // while the arm was being armed
  bool broken_off_ = false;  // a later part of it was
};

/// Prints why the robot was not commanded to the end, if it was not.
void explain(const Session& session, const Options& options, const RunLoop& loop);

}  // namespace tactus
