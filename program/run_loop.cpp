#include "program/run_loop.hpp"

#include <cmath>
#include <csignal>

#include "hal/os/cycle_clock.hpp"
#include "hal/os/realtime.hpp"
#include "program/heap_count.hpp"
#include "program/session/fault_verdict.hpp"

namespace tactus {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int) {
  interrupted = 1;
}

}  // namespace

void catch_interrupts() {
  for (const int brakes : {SIGINT, SIGTERM, SIGQUIT, SIGTSTP}) std::signal(brakes, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // under nohup
  std::signal(SIGXFSZ, SIG_IGN);  // a log that becomes too large is an error of its file
  std::signal(SIGPIPE, SIG_IGN);  // a closed output must not stop the arm
}

void end_with(RunResult& result, int code, const char* name) {
  result.code = code;
  result.name = name;
}

void end_with(RunResult& result, Status fault) {
  end_with(result, static_cast<int>(fault), name(fault));
  result.fault = fault;
}

/// Takes the result of the run from the reports on its trajectory. A run without a trajectory
/// succeeds. False: the trajectory was refused, and the run ends.
bool RunLoop::follow() {
  if (!planned_end_) goal_.follow();
  Report report;
  while (feed_.poll(report)) {
    if (recording_ != nullptr) recording_->watch(report);
    if (report.id != input_.id || planned_end_) continue;
    if (report.outcome == Outcome::kStarved) count_starving();
    if (!is_final(report.outcome)) continue;
    pending_ = false;
    end_ = report.verdict;
    if (length_.cycles == kUnlimited)
      length_.cycles =
          commanded_ + std::llround(session_.gateway.settle_s / session_.pipeline.robot.period_s());
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

/// The arm waits on its path for a file: the planned time of the run is no longer its end.
void RunLoop::count_starving() {
  ++result_.starved;
  if (!length_.fixed) length_.cycles = kUnlimited;
}

/// Feeds a file longer than its store between two cycles. Virtual time waits for a pipe.
void RunLoop::feed() {
  while (feed_.advance() == FeedResult::kNotYet && interrupted == 0) {
  }
}

/// A part of the file was refused: the arm is brought to rest on its path, and the run ends.
void RunLoop::break_off() {
  broken_off_ = true;
  end_with(result_, refusal_code(input_), name(Outcome::kRefused));
}

bool RunLoop::start() {
  Status status = session_.executive.start();
  if (status == Status::kOk) status = session_.executive.arm();
  if (status == Status::kArming) return true;
  cut_short_ = interrupted != 0;  // the signal ended a wait for the robot
  if (cut_short_)
    end_with(result_, kEndedOtherwise, "interrupted");
  else
    end_with(result_, status);
  return false;
}

/// Takes over the drives once they are enabled, and then sends the trajectory.
bool RunLoop::arm() {
  const Status status = session_.executive.arm();
  if (status == Status::kArming) return true;
  if (status != Status::kOk) {
    end_with(result_, status);
    return session_.executive.busy();
  }
  armed_ = true;
  pending_ = input_.given();
  const bool begun = session_.follower == nullptr || session_.follower->begin(input_);
  if (begun && feed_.begin()) return true;
  end_with(result_, refusal_code(input_), name(Outcome::kRefused));
  return false;
}

void RunLoop::halt() {
  session_.executive.halt();
  if (session_.follower != nullptr) session_.follower->halt();
}

/// The time of the executive in the cycle that begins `now`.
CycleTime RunLoop::time_of(const CycleTime& now) {
  if (!virtual_) return now;
  virtual_ns_ += std::int64_t{1000} * session_.pipeline.robot.period_us;
  return {virtual_ns_};
}

void RunLoop::stop() {
  const Pipeline& pipeline = session_.pipeline;
  fault_ = fault_verdict(session_.executive.latched(), session_.executive.guard(), pipeline);
  if (latched() != Status::kOk) trouble_ = session_.hal.trouble();
  if (trouble_.empty() && latched() != Status::kOk && latched() == pipeline.failure)
    trouble_ << "block [" << pipeline.name(pipeline.failed) << "]";
  if (latched() == Status::kPathTolerance)
    trouble_ << ": its reference rests, and the arm does not stay there; look at gains, tool and "
                "mounting; "
             << (fault_.axes == VerdictAxes::kTip ? "hold_tolerance" : "path_tolerance")
             << " = 0 lets it be pushed away";
  if (cut_while_arming()) trouble_ << "it ended before the arm was armed";
  result_.rung = session_.executive.rung();
  left_ = session_.executive.stop();
  if (left_ != Status::kOk) left_trouble_ = session_.hal.trouble();
}

bool RunLoop::cycle(const CycleTime& now) {
  const bool commanded = commands(session_.executive.rung());
  Status status = Status::kOk;
  {
    const HeapWatch watch;
    status = session_.executive.cycle(time_of(now));
  }
  watchdog_.cycle_completed();
  if (recording_ != nullptr) recording_->watch(session_.pipeline.motion_state());
  halted_ = interrupted != 0;  // a later signal counts in the next cycle, which brakes
  unarmed_ = unarmed_ || (halted_ && session_.executive.rung() == Rung::kArming);
  if (halted_ && session_.executive.rung() != Rung::kDisabled) halt();
  commanded_ += commanded ? 1 : 0;
  if (endpoint_ != nullptr) return served(status);
  if (status == Status::kArming && !halted_) return arm();
  for (int i = 0; i < result_.tracking_count && commanded; ++i)
    result_.tracking[static_cast<std::size_t>(i)].add();
  if (commanded) result_.expectation.add();
  if (!follow()) refused_ = true;
  if (feed_.refused() && !broken_off_ && !planned_end_) break_off();
  take_result(status);
  return session_.executive.busy() || !over(status);
}

/// True until a signal has come, and the arm is at rest and its drives are disabled.
bool RunLoop::served(Status status) {
  if (!halted_) endpoint_->work(status);
  endpoint_->publish({began_ns_});
  armed_ = armed_ || commands(session_.executive.rung());
  return session_.executive.busy() || !halted_;
}

void RunLoop::take_result(Status status) {
  if (status == Status::kOk || planned_end_ || broken_off_) return;
  if (halted_ && (status == Status::kHalted || status == Status::kArming))
    end_with(result_, kEndedOtherwise, "interrupted");
  else
    end_with(result_, status);
}

bool RunLoop::time_has_passed() const {
  if (commanded_ < length_.cycles) return false;
  return length_.fixed || !pending_ || time_s() >= goal_.latest_report_s();
}

Reason RunLoop::why() const {
  if (result_.fault != Status::kOk) {
    Reason text = gave_up();
    if (!text.empty()) text << "; then ";
    return text << stop_reason(
               fault_verdict(result_.fault, session_.executive.guard(), session_.pipeline),
               trouble_);
  }
  if (std::string_view(result_.name) == name(Outcome::kRefused)) return input_.refusal;
  if (pending_ && planned_end_) return goal_.unfinished(ended_s_);
  if (end_.ok() && std::string_view(result_.name) == name(Outcome::kAborted)) return goal_.left();
  return gave_up();
}

/// True if no cycle is to follow. An arm that moves when its time has passed is halted first.
bool RunLoop::over(Status status) {
  if (status != Status::kOk || refused_ || halted_) return true;
  if (!time_has_passed() && !broken_off_) return false;
  planned_end_ = true;
  ended_s_ = time_s();
  if (session_.executive.at_rest()) return true;
  halt();
  return false;
}

double RunLoop::time_s() const {
  return static_cast<double>(commanded_) * session_.pipeline.robot.period_s();
}

void RunLoop::in_lock_step(RunLog& log, Progress& progress) {
  const std::int64_t period_ns = std::int64_t{1000} * session_.pipeline.robot.period_us;
  bool goes_on = true;
  for (std::int64_t k = 0; goes_on; ++k) {
    goes_on = cycle({k * period_ns});
    if (goes_on) feed();
    log.drain(session_.recorder);
    progress.update(time_s());
  }
  stop();
}

void RunLoop::in_real_time(LogWriter& writer, Progress& progress) {
  RealtimeResult& realtime = result_.realtime;
  CycleClock clock;
  Status status = clock.start(std::int64_t{1000} * session_.pipeline.robot.period_us);
  writer.begin(session_.recorder, progress);
  const std::int64_t faults = page_faults();
  {
    const HeapWatch watch;  // covers everything in this thread, not only the cycle
    bool goes_on = true;
    while (goes_on && status == Status::kOk) {
      Wake wake;
      status = clock.wait(wake);
      realtime.latency.add(static_cast<std::uint64_t>(wake.latency_ns()));
      began_ns_ = wake.stamp_ns;
      if (status == Status::kOk) goes_on = cycle({wake.stamp_ns});
    }
  }
  realtime.page_faults = page_faults() - faults;
  stop();
  writer.end();
  if (status != Status::kOk) end_with(result_, status);
}

void RunLoop::at_robots_pace(Clock& clock, LogWriter& writer, Progress& progress) {
  writer.begin(session_.recorder, progress);
  const std::int64_t faults = page_faults();
  Status status = Status::kOk;
  {
    const HeapWatch watch;
    bool goes_on = true;
    while (goes_on && status == Status::kOk) {
      CycleTime now;
      status = clock.wait(now);
      began_ns_ = monotonic_ns();
      if (status == Status::kOk) goes_on = cycle(now);
    }
  }
  result_.realtime.page_faults = page_faults() - faults;
  stop();
  writer.end();
  if (status != Status::kOk) end_with(result_, status);
}

}  // namespace tactus
