// Interval: what is left of a number's range when several bounds are put on it.
#pragma once

#include <algorithm>

namespace tactus {

struct Interval {
  double lo, hi;

  /// No less than `below`, no more than `above`. [any]
  void cut(double below, double above) {
    lo = std::max(lo, below);
    hi = std::min(hi, above);
  }
  /// Also everything between x and what there is. [any]
  void include(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  /// The one nearest to x; in the middle of the bounds if they leave nothing. [any]
  double nearest(double x) const { return lo <= hi ? std::clamp(x, lo, hi) : 0.5 * (lo + hi); }
};

}  // namespace tactus
