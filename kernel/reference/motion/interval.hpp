// Interval: the range of a number that several bounds leave.
#pragma once

#include <algorithm>

namespace tactus {

struct Interval {
  double lo, hi;

  /// Adds the bounds `below` and `above`. [any]
  void cut(double below, double above) {
    lo = std::max(lo, below);
    hi = std::min(hi, above);
  }
  /// Extends the range to x. [any]
  void include(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  /// Returns the number nearest to x; the middle of the bounds if they leave none. [any]
  double nearest(double x) const { return lo <= hi ? std::clamp(x, lo, hi) : 0.5 * (lo + hi); }
};

}  // namespace tactus
