// Clock: begins the cycles. The kernel reads no clock; a board's loop waits for one and passes the
// time in. The clock is the host's, or that of a wire whose master is the robot.
#pragma once

#include <cstdint>

#include "kernel/core/status.hpp"

namespace tactus {

/// The time at which a cycle began, by the clock that triggers it, which is never negative.
struct CycleTime {
  std::int64_t stamp_ns = 0;
};

class Clock {
 public:
  /// Waits for the beginning of the next cycle. It bridges what the clock's source leaves out, so
  /// that a cycle begins in any case. kClock if it cannot. [between two cycles]
  virtual Status wait(CycleTime& now) = 0;

 protected:
  ~Clock() = default;
};

}  // namespace tactus
