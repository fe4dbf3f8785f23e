#include "kernel/executive.hpp"

namespace tactus {

Status Executive::add(const Row& row) {
  if (row_count_ == kMaxRows) return Status::kTooLarge;
  if (row.divisor < 1 || row.offset < 0 || row.offset >= row.divisor || row.run == nullptr)
    return Status::kBadValue;
  rows_[row_count_++] = row;
  return Status::kOk;
}

Status Executive::start() {
  period_ns_ = std::int64_t{1000} * pipeline_.robot.period_us;
  stamp_ns_ = -1;  // before any clock
  telemetry_ = {};
  early_ = 0;
  for (Histogram& times : times_) times = {};
  latched_ = hal_.start(pipeline_.robot.mode(), measured_);
  if (latched_ == Status::kOk)
    latched_ = guard_.start(pipeline_.guard, pipeline_.robot.mode(), measured_,
                            pipeline_.robot.period_s());
  if (latched_ == Status::kOk) latched_ = pipeline_.start(measured_);
  if (latched_ != Status::kOk) hal_.stop();
  return latched_;
}

void Executive::stop() {
  hal_.stop();
  if (latched_ == Status::kOk) latched_ = Status::kNotStarted;
}

Status Executive::cycle(const CycleTime& now) {
  if (latched_ != Status::kOk) return latched_;
  const std::uint64_t begin_ns = lap_ns_ = stopwatch_ != nullptr ? stopwatch_() : 0;
  latched_ = run(now);
  if (latched_ != Status::kOk) hal_.stop();
  lap_ns_ = begin_ns;
  lap(Stage::kCycle);
  return latched_;
}

/// The sentence this kernel is about.
Status Executive::run(const CycleTime& now) {
  TRY(check_clock(now));
  TRY(hal_.read(measured_));
  TRY(guard_.check(measured_));
  lap(Stage::kRead);
  TRY(pipeline_.step(measured_));
  lap(Stage::kStep);
  RobotCommand command = pipeline_.robot.command();
  TRY(guard_.limit(measured_, command));
  lap(Stage::kGuard);
  TRY(hal_.write(command));
  lap(Stage::kWrite);
  run_rows();
  lap(Stage::kRows);
  return Status::kOk;
}

/// A late cycle is counted and bridged: the blocks always move by one period, so nothing is caught
/// up in a burst. Too many missed periods in a row, or a clock that stands, runs backwards or too
/// fast, stop the robot. One early cycle may follow a late one; a second in a row is a burst.
Status Executive::check_clock(const CycleTime& now) {
  const std::int64_t before_ns = stamp_ns_;
  stamp_ns_ = now.stamp_ns;
  const bool first = telemetry_.cycles++ == 0;
  if (now.stamp_ns <= before_ns) return Status::kClock;
  if (first) return Status::kOk;
  const std::int64_t elapsed_ns = now.stamp_ns - before_ns;
  early_ = elapsed_ns < period_ns_ / 2 ? early_ + 1 : 0;
  if (early_ > 1) return Status::kClock;
  const std::int64_t missed = (elapsed_ns - period_ns_ / 2) / period_ns_;
  telemetry_.slips += missed;
  return missed > pipeline_.executive.max_slip ? Status::kSlip : Status::kOk;
}

void Executive::run_rows() {
  const std::int64_t number = telemetry_.cycles - 1;
  const double time_s = static_cast<double>(number) * pipeline_.robot.period_s();
  for (std::size_t i = 0; i < row_count_; ++i) {
    const Row& row = rows_[i];
    if (number % row.divisor == row.offset) row.run(row.context, time_s);
  }
}

void Executive::lap(Stage stage) {
  if (stopwatch_ == nullptr) return;
  const std::uint64_t now_ns = stopwatch_();
  const std::uint64_t took_ns = now_ns - lap_ns_;
  lap_ns_ = now_ns;
  times_[static_cast<std::size_t>(stage)].add(took_ns);
  if (stage == Stage::kCycle && took_ns > static_cast<std::uint64_t>(period_ns_))
    ++telemetry_.overruns;
}

}  // namespace tactus
