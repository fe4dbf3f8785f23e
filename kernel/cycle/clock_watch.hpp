// ClockWatch: judges the times at which cycles begin. A late cycle is counted and bridged: the
// blocks always move by one period, so nothing is caught up in a burst. One early cycle may follow
// a late one; a second in a row is a burst.
#pragma once

#include <cstdint>

#include "kernel/pipeline/rate_watch.hpp"
#include "kernel/pipeline/settings.hpp"

namespace tactus {

class ClockWatch {
 public:
  enum class Result : std::uint8_t { kNothing, kSlip, kLongSlip, kWrong };

  /// Restarts the watch: any time may be the first. [init]
  void start(std::int64_t period_ns, const ExecutiveSection& settings) {
    *this = {};
    period_ns_ = period_ns;
    max_slip_ = settings.max_slip;
    forgive(settings);
  }
  /// Forgets the late cycles so far. [between two cycles]
  void forgive(const ExecutiveSection& settings) {
    late_.start(settings.max_late, settings.late_window, settings.late_window);
  }

  /// Takes the time at which a cycle begins, ns. [cyclic]
  Result add(std::int64_t stamp_ns) {
    const std::int64_t before_ns = last_ns_;
    last_ns_ = stamp_ns;
    missed_ = 0;
    if (stamp_ns < 0 || stamp_ns <= before_ns) return Result::kWrong;
    if (before_ns < 0) return Result::kNothing;
    const std::int64_t half_ns = period_ns_ / 2, elapsed_ns = stamp_ns - before_ns;
    early_ = elapsed_ns < half_ns ? early_ + 1 : 0;
    missed_ = (elapsed_ns - half_ns) / period_ns_;
    const bool often = late_.add(missed_ > 0) == RateWatch::Result::kTooMany;
    if (early_ > 1) return Result::kWrong;
    if (missed_ > 2 * max_slip_) return Result::kLongSlip;
    return missed_ > max_slip_ || often ? Result::kSlip : Result::kNothing;
  }

  /// Periods without a cycle before the last one.
  std::int64_t missed() const { return missed_; }

 private:
  std::int64_t period_ns_ = 1, max_slip_ = 0, last_ns_ = -1, missed_ = 0;
  int early_ = 0;
  RateWatch late_;
};

}  // namespace tactus
