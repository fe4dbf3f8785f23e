// RunLoop: the cycles of a run, in lock-step with the plant's virtual time or one for every period
// of the wall clock, and what is watched around each.
#pragma once

#include "boards/program/log_writer.hpp"
#include "boards/program/progress.hpp"
#include "boards/program/run_log.hpp"
#include "boards/program/summary.hpp"
#include "boards/program/trajectory_input.hpp"

namespace tactus {

/// From now on SIGINT and SIGTERM end the loop instead of the program.
void catch_interrupts();

void end_with(RunResult& result, int code, const char* name);

class RunLoop {
 public:
  RunLoop(Session& session, const TrajectoryInput& input, RunResult& result)
      : session_(session), input_(input), result_(result) {}

  /// As fast as the host can: a cycle, then its rows into the log.
  void in_lock_step(std::int64_t cycles, RunLog& log, Progress& progress);
  /// Each cycle at its time by the monotonic clock; rows and progress are the writer's. Missed
  /// periods are left out, and the plant stands still in them.
  void in_real_time(std::int64_t cycles, LogWriter& writer, Progress& progress);

 private:
  bool braking() const { return session_.executive.braking(); }
  /// One cycle and what is watched around it. False: the run is over, and an arm that was braked
  /// has come to rest.
  bool cycle(const CycleTime& now);
  bool follow();

  Session& session_;
  const TrajectoryInput& input_;
  RunResult& result_;
  bool refused_ = false;  // the trajectory
};

}  // namespace tactus
