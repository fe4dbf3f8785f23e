// SlewLimiter: keeps one joint's sequence of torques, or of feed-forward, within a limit and within
// a change per cycle.
#pragma once

#include <algorithm>

namespace tactus {

class SlewLimiter {
 public:
  /// `limit` in the unit of the sequence, `change` in that unit per cycle. [init]
  void start(double limit, double change, double value) {
    limit_ = limit;
    change_ = change;
    sent_ = value;
  }
  /// Returns the value to send if `wanted` (finite) is commanded. [cyclic]
  double next(double wanted) {
    const double change = std::clamp(wanted - sent_, -change_, change_);
    const double value = change == wanted - sent_ ? wanted : sent_ + change;
    return sent_ = std::clamp(value, -limit_, limit_);
  }
  /// The last value sent. [any]
  double sent() const { return sent_; }

 private:
  double limit_ = 0.0, change_ = 0.0, sent_ = 0.0;
};

}  // namespace tactus
