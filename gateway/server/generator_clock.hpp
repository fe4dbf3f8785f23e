// GeneratorClock: the times that clients name, in nanoseconds of the server's monotonic clock, by
// the clock of the reference generator, which counts periods from its start. A cycle that is left
// out moves one against the other, so the offset is that of the newest cycle.
#pragma once

#include <cmath>

#include "gateway/server/limits.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

class GeneratorClock {
 public:
  /// A cycle began at `stamp_ns`; its generator time.
  void set(std::int64_t stamp_ns, double time_s) {
    stamp_ns_ = stamp_ns;
    time_s_ = time_s;
    known_ = true;
  }
  bool known() const { return known_; }

  /// Returns the generator time of a stamp, s. [any]
  double time_s(std::int64_t stamp_ns) const {
    return time_s_ + static_cast<double>(stamp_ns - stamp_ns_) * 1e-9;
  }
  /// The same of a stamp that a client gave at `now_ns`. kStampRange with its distance from now
  /// in s if it is further away than any clock that follows the server's; kNotStarted before the
  /// first cycle. [any]
  Verdict time_of(std::int64_t stamp_ns, std::int64_t now_ns, double& time_s) const {
    if (!known_) return {Status::kNotStarted};
    const auto ahead_ns = static_cast<double>(stamp_ns) - static_cast<double>(now_ns);
    if (!(std::abs(ahead_ns) <= static_cast<double>(kStampRange_ns)))
      return {Status::kStampRange, -1, -1, ahead_ns * 1e-9,
              static_cast<double>(kStampRange_ns) * 1e-9};
    time_s = this->time_s(stamp_ns);
    return {};
  }

 private:
  std::int64_t stamp_ns_ = 0;
  double time_s_ = 0.0;
  bool known_ = false;
};

}  // namespace tactus
