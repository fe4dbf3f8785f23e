#include "boards/program/run_loop.hpp"

#include <csignal>

#include "boards/program/heap_count.hpp"
#include "hal/os/cycle_clock.hpp"
#include "hal/os/realtime.hpp"

namespace tactus {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int) {
  interrupted = 1;
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void end_with(RunResult& result, int code, const char* name) {
  result.code = code;
  result.name = name;
}

/// What the reports say of the trajectory; a run succeeds when it has one and that succeeds, or has
/// none. False: there is nothing to go on for.
bool RunLoop::follow() {
  Report report;
  while (poll_report(session_, input_, report)) {
    if (report.id != input_.id || report.outcome == Outcome::kStarted) continue;
    const bool refused = report.outcome == Outcome::kRefused;
    end_with(result_,
             refused                                 ? static_cast<int>(report.verdict.status)
             : report.outcome == Outcome::kSucceeded ? 0
                                                     : kEndedOtherwise,
             name(report.outcome));
    if (!refused) continue;
    print_verdict(input_, report.verdict);
    return false;
  }
  return true;
}

bool RunLoop::cycle(const CycleTime& now) {
  Status status = Status::kOk;
  {
    const HeapWatch watch;
    status = session_.executive.cycle(now);
  }
  for (int i = 0; i < result_.tracking_count; ++i)
    result_.tracking[static_cast<std::size_t>(i)].add();
  if (!follow()) refused_ = true;
  if (status == Status::kHalted)
    end_with(result_, kEndedOtherwise, "interrupted");
  else if (status != Status::kOk)
    end_with(result_, static_cast<int>(status), name(status));
  if (interrupted != 0) session_.executive.halt();
  return session_.executive.braking() || (status == Status::kOk && !refused_ && interrupted == 0);
}

void RunLoop::in_lock_step(std::int64_t cycles, RunLog& log, Progress& progress) {
  const double period_s = session_.pipeline.robot.period_s();
  const std::int64_t period_ns = std::int64_t{1000} * session_.pipeline.robot.period_us;
  bool goes_on = true;
  for (std::int64_t k = 0; goes_on && (k < cycles || braking()); ++k) {
    goes_on = cycle({k * period_ns});
    log.drain(session_.recorder);
    progress.update(static_cast<double>(k) * period_s);
  }
}

void RunLoop::in_real_time(std::int64_t cycles, LogWriter& writer, Progress& progress) {
  RealtimeResult& realtime = result_.realtime;
  CycleClock clock;
  Status status = clock.start(std::int64_t{1000} * session_.pipeline.robot.period_us);
  writer.begin(session_.recorder, progress);
  const std::int64_t faults = page_faults();
  {
    const HeapWatch watch;  // of everything in this thread, not only of the cycle
    bool goes_on = true;
    for (std::int64_t k = 0; goes_on && status == Status::kOk && (k < cycles || braking()); ++k) {
      Wake wake;
      status = clock.wait(wake);
      realtime.latency.add(static_cast<std::uint64_t>(wake.latency_ns()));
      if (status == Status::kOk) goes_on = cycle({wake.stamp_ns});
    }
  }
  realtime.page_faults = page_faults() - faults;
  writer.end();
  if (status != Status::kOk) end_with(result_, static_cast<int>(status), name(status));
}

}  // namespace tactus
