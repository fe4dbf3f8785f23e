// CycleGrid: decides when the next cycle may begin. Cycles are on a grid of real time, and none is
// left out: a host that was late catches up. But the clients get time to answer between two cycles,
// or a client that streams would seem silent.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tactus::ur {

class CycleGrid {
 public:
  static constexpr std::int64_t kLongestLag_ns = 1'000'000'000;  ///< beyond it no catching up
  static constexpr std::int64_t kCatchUp = 2;                    ///< factor of the grid's rate

  CycleGrid(std::int64_t period_ns, std::int64_t now_ns)
      : period_ns_(period_ns), next_ns_(now_ns + period_ns), earliest_ns_(now_ns) {}

  /// Returns the time until the next cycle may begin, ns; not positive: at once. [any]
  std::int64_t left_ns(std::int64_t now_ns) const {
    return std::max(next_ns_, earliest_ns_) - now_ns;
  }
  /// Notes that a cycle begins. [cyclic]
  void begin(std::int64_t now_ns) {
    if (now_ns - next_ns_ > kLongestLag_ns) next_ns_ = now_ns;
    next_ns_ += period_ns_;
    earliest_ns_ = now_ns + period_ns_ / kCatchUp;
  }
  /// As begin(), and restarts the grid here. [cyclic]
  void begin_anew(std::int64_t now_ns) {
    next_ns_ = now_ns;
    begin(now_ns);
  }

 private:
  std::int64_t period_ns_, next_ns_, earliest_ns_;
};

}  // namespace tactus::ur
