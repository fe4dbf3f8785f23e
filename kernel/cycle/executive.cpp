#include "kernel/cycle/executive.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

Cause cause_of_stage(Status status) {
  return status >= Status::kSensorNotFinite && status <= Status::kSensorNotSteady ? Cause::kSensor
                                                                                  : Cause::kStage;
}

Status reason_of(const Drive& drive) {
  return drive.reason == Status::kOk ? Status::kDriveFault : drive.reason;
}

}  // namespace

Status Executive::cycle(const CycleTime& now) {
  if (period_ns_ == 0) return Status::kNotStarted;
  timing_.begin(commands(rung()));
  const std::uint64_t begin_ns = timing_.marked();
  ++telemetry_.cycles;
  check_clock(now);
  read();
  step();
  write(guarded());
  timing_.end_row(0, pipeline_.schedule[0], begin_ns);
  if (commands(rung()))
    run_rows();
  else
    watch_times();
  watch_rest();
  watch_overruns(timing_.close(Stage::kCycle, begin_ns));
  return latched_;
}

/// Checks the clock and counts the periods without a cycle.
void Executive::check_clock(const CycleTime& now) {
  now_ = now;
  const ClockWatch::Result result = clock_.add(now.stamp_ns);
  telemetry_.slips +=
      static_cast<std::uint32_t>(std::min<std::int64_t>(clock_.missed(), UINT32_MAX));
  const Finding missed{static_cast<double>(clock_.missed())};
  if (result == ClockWatch::Result::kWrong) walk(Cause::kClock, Status::kClock);
  if (result == ClockWatch::Result::kSlip) walk(Cause::kSlip, Status::kSlip, missed);
  if (result == ClockWatch::Result::kLongSlip) walk(Cause::kLongSlip, Status::kSlip, missed);
}

/// Reads and judges the state. One that is not finite is discarded; the last finite one remains.
void Executive::read() {
  RobotState state;
  wire_ = hal_.read(now_, state);
  if (ok_or_walk(Cause::kWire, wire_)) {
    if (state.finite())
      measured_ = state;
    else
      measured_.drives = state.drives;
    pipeline_.robot.set_measured(measured_);  // recorded even if no block is stepped
    log_drives();
    watch_drives();
    const Status status = commands(rung()) ? guard_.check(state, now_) : Status::kOk;
    ok_or_walk(Cause::kState, status, tripped());
  }
  timing_.lap(Stage::kRead);
}

/// Logs every fault that stood before the request to arm (the request clears it), and the warning
/// of a drive once in an arming. Neither changes anything else.
void Executive::log_drives() {
  const bool before = rung() == Rung::kArming && requested_ != DriveRequest::kArm;
  LoopBound<kDof> joints;
  for (int i = 0; i < kDof; ++i) {
    joints.tick();
    const Drive& drive = measured_.drives[static_cast<std::size_t>(i)];
    const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(i));
    const bool stood = before && drive.state == DriveState::kFault;
    if (stood) log(Cause::kOldFault, reason_of(drive), {0.0, i, drive.code}, rung(), rung());
    if (!drive.warns || (warned_ & bit) != 0 || rung() == Rung::kDisabled) continue;
    warned_ |= bit;
    log(Cause::kWarning, Status::kOk, {0.0, i, drive.code}, rung(), rung());
  }
}

/// Finds the first drive that does not follow, or that could not be armed. A fault that was there
/// before the request is none of arming.
void Executive::watch_drives() {
  const bool follow = commands(rung());
  const bool arm = rung() == Rung::kArming && requested_ == DriveRequest::kArm;
  for (int i = 0; i < kDof; ++i) {
    const Drive& drive = measured_.drives[static_cast<std::size_t>(i)];
    const bool lost = follow && drive.state != DriveState::kEnabled;
    const bool failed = arm && drive.state == DriveState::kFault;
    if (lost || failed) return walk(Cause::kDrive, reason_of(drive), {0.0, i, drive.code});
  }
}

/// Steps the chain, or brakes its references.
void Executive::step() {
  if (refuses(rung())) pipeline_.brake(latched_, way_);
  if (!commands(rung()) || !chain_) return;
  const std::uint64_t begin_ns = timing_.marked();
  const Status status = pipeline_.step(measured_, &timing_);
  ok_or_walk(cause_of_stage(status), status);
  timing_.close(Stage::kStep, begin_ns);
}

/// Returns the chain's command as limited by the guard; without a chain, the guard's brake.
RobotCommand Executive::guarded() {
  RobotCommand command = pipeline_.robot.command();
  if (chain_ && commands(rung())) {
    const Status status = guard_.limit(measured_, command, brakes(rung()));
    if (ok_or_walk(Cause::kCommand, status, tripped()) && limiting_.add(guard_.telemetry().limited))
      walk(Cause::kLimiting, Status::kLimiting, {pipeline_.guard.limiting_share});
  }
  if (!chain_ && commands(rung())) command = guard_.brake(measured_);
  timing_.lap(Stage::kGuard);
  return command;
}

/// Writes the command for drives that follow, and what is requested of the others.
void Executive::write(const RobotCommand& command) {
  RobotCommand sent = {pipeline_.robot.mode()};
  if (commands(rung())) {
    sent = command;
    sent.request = DriveRequest::kFollow;
  }
  if (rung() == Rung::kArming) sent.request = DriveRequest::kArm;
  pipeline_.robot.write_outputs(sent);
  requested_ = sent.request;
  const Status status = hal_.write(sent);
  if (wire_ == Status::kOk) wire_ = status;
  ok_or_walk(Cause::kWire, status);
  timing_.lap(Stage::kWrite);
}

/// Runs the rows that are due after the control chain, which is the first. They run only while the
/// drives follow.
void Executive::run_rows() {
  const std::int64_t number = commanded_++;
  const double time_s = static_cast<double>(number) * pipeline_.robot.period_s();
  const std::uint64_t rows_begin_ns = timing_.marked();
  for (int i = 1; i < pipeline_.schedule.count() && commands(rung()); ++i) {
    const Row& row = pipeline_.schedule[i];
    const std::uint64_t begin_ns = timing_.marked();
    if (row.run == nullptr || (row.optional && skips_) || !row.due(number)) continue;
    ok_or_walk(Cause::kRow, row.run(row.context, measured_, time_s));
    timing_.end_row(i, row, begin_ns);
  }
  timing_.close(Stage::kRows, rows_begin_ns);
}

/// Begins to look for rest; what was seen before does not count.
void Executive::await_rest(int longest_ms) {
  const int blocks = pipeline_.executive.rest_blocks(pipeline_.robot.period_us);
  rest_.start(static_cast<std::int32_t>(cycles_of(longest_ms)), static_cast<std::uint16_t>(blocks));
}

/// Finds a braked arm that has come to rest, has not done so in time, or moves again.
void Executive::watch_rest() {
  const RestWatch::Result found = rest_.add(measured_.dq, pipeline_.executive.rest_velocity);
  if (!brakes(rung())) return;
  if (found == RestWatch::Result::kAtRest) walk(Cause::kAtRest, latched_);
  if (found == RestWatch::Result::kTooLong) walk(Cause::kStopTime, Status::kStopTime);
  if (found == RestWatch::Result::kMoved) walk(Cause::kMoved, Status::kMoved);
}

/// Ends an arming that takes too long. Ends the wait for disabled drives once they are disabled,
/// the wire has failed, or disabling_ms have passed.
void Executive::watch_times() {
  if (arming_ > 0 && --arming_ == 0) give_up_arming();
  if (disabling_ == 0) return;
  bool down = requested_ == DriveRequest::kDisable;  // or they may just have begun to arm
  for (const Drive& drive : measured_.drives)
    down = down && (drive.state == DriveState::kDisabled || drive.state == DriveState::kFault);
  if (down || wire_ != Status::kOk)
    disabling_ = 0;
  else if (--disabling_ == 0)
    walk(Cause::kStopTime, Status::kStopTime);
}

void Executive::watch_overruns(std::uint64_t took_ns) {
  const bool overrun = took_ns > static_cast<std::uint64_t>(period_ns_);
  if (overrun) ++telemetry_.overruns;
  const RateWatch::Result found = overruns_.add(overrun && judges_overruns_);
  if (found == RateWatch::Result::kTooMany)
    walk(Cause::kOverruns, Status::kOverrun, {static_cast<double>(took_ns) * 1e-3});
  if (found == RateWatch::Result::kClean) walk(Cause::kClean, Status::kOk);
}

/// Walks the ladder for every Status but kOk, and returns whether it is kOk.
bool Executive::ok_or_walk(Cause cause, Status status, const Finding& found) {
  if (status == Status::kOk) return true;
  walk(cause, status, found);
  return false;
}

/// Goes to the rung that the ladder gives for `cause`. Logs a change of rung, and on the same rung
/// the first occurrence of each cause, a chain that is given up and a brake that becomes harder.
void Executive::walk(Cause cause, Status status, const Finding& found) {
  const Rung from = rung(), to = next(from, cause, pipeline_.robot.mode());
  const std::uint32_t bit = 1U << static_cast<unsigned>(cause);
  const bool lost = chain_ && !rule(cause).chain;
  const bool harder = rule(cause).way == BrakeWay::kAtOnce && way_ == BrakeWay::kOnPath;
  chain_ = cause == Cause::kRearm || (chain_ && rule(cause).chain);
  skips_ =
      cause == Cause::kOverruns || (skips_ && cause != Cause::kClean && cause != Cause::kRearm);
  if (harder) way_ = BrakeWay::kAtOnce;
  if (cause == Cause::kRearm) way_ = BrakeWay::kOnPath;
  const bool again = (seen_ & bit) != 0 || cause == Cause::kClean;
  seen_ |= bit;
  if (to == from && again && !lost && !harder && cause != Cause::kAtRest) return;
  log(cause, status, found, from, to);
  if (to == from) return;
  seen_ = bit;
  rung_ = static_cast<std::uint8_t>(to);
  if (!refuses(to)) latched_ = Status::kOk;
  if (refuses(to) &&
      (latched_ == Status::kOk || latched_ == Status::kArming || to == Rung::kArming))
    latched_ = status;
  if (brakes(to)) await_rest(pipeline_.executive.stop_ms);
  arming_ = to == Rung::kArming ? cycles_of(pipeline_.executive.arming_ms) : 0;
  disabling_ = to == Rung::kDisabled ? cycles_of(pipeline_.executive.disabling_ms) : 0;
}

void Executive::log(Cause cause, Status status, const Finding& found, Rung from, Rung to) {
  events_.add({now_.stamp_ns, telemetry_.cycles, static_cast<std::uint32_t>(commanded_),
               static_cast<float>(found.value), found.code, status, cause, from, to,
               static_cast<std::int8_t>(found.joint)});
}

/// Returns the joint, value and limit that the guard found.
Executive::Finding Executive::tripped() const {
  return {guard_.telemetry().tripped_value, guard_.telemetry().tripped_joint};
}

std::int64_t Executive::cycles_of(int ms) const {
  const int period_us = pipeline_.robot.period_us;
  return (std::int64_t{1000} * ms + period_us - 1) / period_us;
}

}  // namespace tactus
