#include "kernel/executive.hpp"

#include <algorithm>

namespace tactus {
namespace {

Cause cause_of_stage(Status status) {
  return status >= Status::kSensorNotFinite && status <= Status::kSensorNotSteady ? Cause::kSensor
                                                                                  : Cause::kStage;
}

}  // namespace

Status Executive::add(const Row& row) {
  if (row.run == nullptr) return Status::kBadValue;
  return pipeline_.schedule.add(row, pipeline_.robot.period_us).status;
}

Status Executive::start() {
  period_ns_ = std::int64_t{1000} * pipeline_.robot.period_us;
  cycles_ = 0;
  telemetry_.cycles = telemetry_.slips = telemetry_.overruns = 0;
  timing_.clear();
  events_.clear();
  rung_ = static_cast<std::uint8_t>(Rung::kDisabled);
  if (!pipeline_.schedule.bind("control", run_control, this)) return latched_ = Status::kMissingKey;
  const Status status = attach();
  if (status != Status::kOk) latched_ = status;
  return status;
}

/// From drives that are disabled.
Status Executive::attach() {
  const CommandMode mode = pipeline_.robot.mode();
  Status status = hal_.start(mode, measured_);
  if (status == Status::kOk)
    status = guard_.start(pipeline_.guard, mode, measured_, pipeline_.robot.period_s());
  if (status == Status::kOk) status = pipeline_.start(measured_);
  if (status != Status::kOk) return hal_.stop(), status;
  stamp_ns_ = -1;  // before any clock
  watch_anew();
  move(Cause::kRearm, Status::kOk, 0.0);
  return status;
}

/// From a hold the drives and the guard's sequence go on: the command joins the new reference
/// within limits.
Status Executive::rearm() {
  if (rung() == Rung::kDisabled) return attach();
  if (!brakes(rung())) return Status::kOk;
  if (!rest_.at_rest()) return Status::kNotAtRest;
  TRY(guard_.check(measured_));
  TRY(pipeline_.start(measured_));
  watch_anew();
  move(Cause::kRearm, Status::kOk, 0.0);
  return Status::kOk;
}

void Executive::watch_anew() {
  const ExecutiveSection& settings = pipeline_.executive;
  overruns_.start(settings.max_overruns, settings.overrun_window, settings.clean_cycles);
  const Guard::Params& guard = pipeline_.guard;
  limiting_.start(guard.limiting_share, static_cast<std::int64_t>(guard.limiting_window * 1e6) /
                                            pipeline_.robot.period_us);
}

void Executive::stop() {
  if (enabled()) return move(Cause::kOff, Status::kNotStarted, 0.0);
  hal_.stop();  // again: whoever asks may rely on it
}

Status Executive::cycle(const CycleTime& now) {
  if (!enabled()) return pipeline_.brake(latched_, way_), latched_;
  timing_.mark();
  const std::uint64_t begin_ns = timing_.marked();
  ++cycles_, ++telemetry_.cycles;
  check_clock(now);
  run_rows();
  watch_rest();
  watch_overruns(timing_.close(Stage::kCycle, begin_ns));
  return latched_;
}

/// The sentence this kernel is about.
void Executive::control() {
  RobotState state;
  RobotCommand command;
  if (!passes(Cause::kWire, hal_.read(state)) || !accept(state)) return;
  timing_.lap(Stage::kRead);
  if (!decide(command)) return;
  timing_.lap(Stage::kGuard);
  passes(Cause::kWire, hal_.write(command));
  timing_.lap(Stage::kWrite);
}

/// What is not finite is kept from everybody: the last state that was stays.
bool Executive::accept(const RobotState& state) {
  const Status status = guard_.check(state);
  if (status != Status::kStateNotFinite) measured_ = state;
  pipeline_.robot.set_measured(measured_);  // recorded even where no block is stepped
  passes(Cause::kState, status);
  return enabled();
}

/// The chain's command as the guard allows it; where there is none, the guard brakes.
bool Executive::decide(RobotCommand& command) {
  if (refuses(rung())) pipeline_.brake(latched_, way_);
  const std::uint64_t begin_ns = timing_.marked();
  if (chain_) {
    const Status status = pipeline_.step(measured_, &timing_);
    passes(cause_of_stage(status), status);
    timing_.close(Stage::kStep, begin_ns);
  }
  command = pipeline_.robot.command();
  if (chain_ && passes(Cause::kCommand, guard_.limit(measured_, command))) watch_limiting();
  if (!chain_) command = guard_.brake(measured_);
  return enabled();
}

Status Executive::run_control(void* executive, const RobotState&, double) {
  static_cast<Executive*>(executive)->control();
  return Status::kOk;
}

/// The control chain is the first of them. Nothing runs any more once the drives are disabled.
void Executive::run_rows() {
  const std::int64_t number = cycles_ - 1;
  const double time_s = static_cast<double>(number) * pipeline_.robot.period_s();
  std::uint64_t rows_begin_ns = 0;
  for (int i = 0; i < pipeline_.schedule.count() && enabled(); ++i) {
    const Row& row = pipeline_.schedule[i];
    const std::uint64_t begin_ns = timing_.marked();
    if (row.run == nullptr || (row.optional && skips_) || !row.due(number)) continue;
    passes(Cause::kRow, row.run(row.context, measured_, time_s));
    timing_.end_row(i, row, begin_ns);
    if (i == 0) rows_begin_ns = timing_.marked();
  }
  if (enabled()) timing_.close(Stage::kRows, rows_begin_ns);
}

/// A late cycle is counted and bridged: the blocks always move by one period, so nothing is caught
/// up in a burst. One early cycle may follow a late one; a second in a row is a burst.
void Executive::check_clock(const CycleTime& now) {
  const std::int64_t before_ns = stamp_ns_;
  const bool first = before_ns < 0;
  stamp_ns_ = now.stamp_ns;
  if (!passes(Cause::kClock, now.stamp_ns > before_ns ? Status::kOk : Status::kClock) || first)
    return;
  const std::int64_t elapsed_ns = now.stamp_ns - before_ns;
  early_ = elapsed_ns < period_ns_ / 2 ? early_ + 1 : 0;
  passes(Cause::kClock, early_ > 1 ? Status::kClock : Status::kOk);
  const std::int64_t missed = (elapsed_ns - period_ns_ / 2) / period_ns_;
  const std::int64_t bridged = pipeline_.executive.max_slip;
  telemetry_.slips += static_cast<std::uint32_t>(std::min<std::int64_t>(missed, UINT32_MAX));
  if (missed > bridged)
    passes(missed > 2 * bridged ? Cause::kLongSlip : Cause::kSlip, Status::kSlip,
           static_cast<double>(missed));
}

void Executive::watch_limiting() {
  if (limiting_.add(guard_.telemetry().limited))
    move(Cause::kLimiting, Status::kLimiting, pipeline_.guard.limiting_share);
}

/// An arm that is braked has come to rest, or has not in time.
void Executive::watch_rest() {
  if (!brakes(rung())) return;
  const RestWatch::Found found = rest_.add(measured_.dq, pipeline_.executive.rest_velocity);
  if (found == RestWatch::Found::kAtRest) move(Cause::kAtRest, latched_, 0.0);
  if (found == RestWatch::Found::kTooLong) move(Cause::kStopTime, Status::kStopTime, 0.0);
}

void Executive::watch_overruns(std::uint64_t took_ns) {
  const bool overrun = took_ns > static_cast<std::uint64_t>(period_ns_);
  if (overrun) ++telemetry_.overruns;
  const OverrunWatch::Found found = overruns_.add(overrun && judges_overruns_);
  if (found == OverrunWatch::Found::kTooMany)
    move(Cause::kOverruns, Status::kOverrun, static_cast<double>(took_ns) * 1e-3);
  if (found == OverrunWatch::Found::kClean) move(Cause::kClean, Status::kOk, 0.0);
}

/// False, and down the ladder, if the Status is not kOk.
bool Executive::passes(Cause cause, Status status, double value) {
  if (status == Status::kOk) return true;
  move(cause, status, value);
  return false;
}

/// To where the ladder says `cause` leads; what changes by it, and why, is in the log: a chain that
/// is given up, a brake that becomes harder and one that has come to rest too.
void Executive::move(Cause cause, Status status, double value) {
  const Rung from = rung(), to = next(from, cause, pipeline_.robot.mode());
  const bool lost = chain_ && !rule(cause).chain;
  const bool harder = rule(cause).way == BrakeWay::kAtOnce && way_ == BrakeWay::kOnPath;
  chain_ = cause == Cause::kRearm || (chain_ && rule(cause).chain);
  skips_ =
      cause == Cause::kOverruns || (skips_ && cause != Cause::kClean && cause != Cause::kRearm);
  if (harder) way_ = BrakeWay::kAtOnce;
  if (cause == Cause::kRearm) way_ = BrakeWay::kOnPath;
  if (to == from && !lost && !harder && cause != Cause::kAtRest) return;
  const Guard::Telemetry& guard = guard_.telemetry();
  const bool joint = cause == Cause::kState || cause == Cause::kCommand;
  events_.add({stamp_ns_, telemetry_.cycles,
               static_cast<float>(joint ? guard.tripped_value : value), status, cause, from, to,
               static_cast<std::int8_t>(joint ? guard.tripped_joint : -1)});
  if (to == from) return;
  rung_ = static_cast<std::uint8_t>(to);
  if (!refuses(to)) latched_ = Status::kOk;
  if (refuses(to) && latched_ == Status::kOk) latched_ = status;
  if (brakes(to))
    rest_.start((std::int64_t{1000} * pipeline_.executive.stop_ms + pipeline_.robot.period_us - 1) /
                pipeline_.robot.period_us);
  if (to == Rung::kDisabled) hal_.stop();
}

}  // namespace tactus
