// CycleClock: wakes the cycle on the grid start + k * period of the monotonic clock. Periods missed
// by a late wake-up are left out, and the next wake-up is on the grid again.
#pragma once

#include <cstdint>

#include "kernel/core/status.hpp"

namespace tactus {

/// Returns the wake-up after the one planned for `planned_ns`, at time `now_ns`: the first point of
/// the grid planned_ns + k * period_ns, k >= 1, in the future. It is strictly later than both
/// times, so a period of the grid has at most one wake-up, whatever the delays. period_ns > 0.
/// [any]
constexpr std::int64_t next_wake_ns(std::int64_t planned_ns, std::int64_t now_ns,
                                    std::int64_t period_ns) {
  if (now_ns < planned_ns + period_ns) return planned_ns + period_ns;
  return planned_ns + ((now_ns - planned_ns) / period_ns + 1) * period_ns;
}

/// The planned and the actual beginning of a cycle, by the monotonic clock.
struct Wake {
  std::int64_t planned_ns = 0;
  std::int64_t stamp_ns = 0;  ///< actual beginning, for Executive::cycle()
  std::int64_t missed = 0;    ///< points of the grid left out before this one

  std::int64_t latency_ns() const { return stamp_ns - planned_ns; }
};

/// Returns the time of the monotonic clock, ns. [cyclic]
std::int64_t monotonic_ns();

class CycleClock {
 public:
  /// Begins the grid now; the first wake-up is one period later. kBadValue unless period_ns > 0.
  /// [init]
  Status start(std::int64_t period_ns);
  /// Sleeps until the next point of the grid. A signal does not end the sleep. kNotStarted before
  /// start(), kClock if sleeping fails. [cyclic]
  Status wait(Wake& wake);

 private:
  std::int64_t period_ns_ = 0;
  std::int64_t planned_ns_ = 0;
};

}  // namespace tactus
