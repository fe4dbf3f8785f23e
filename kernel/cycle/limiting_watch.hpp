// LimitingWatch: decides when the guard limits for too long: in more than a stated share of the
// cycles of a window, which slides by sixteenths of its length. Counting then restarts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

class LimitingWatch {
 public:
  static constexpr int kParts = 16;  ///< parts of the window

  /// Restarts the watch: more than `share`, 0 to 1, of `window` cycles are too many; 1: never.
  /// [init]
  void start(double share, std::int64_t window) {
    *this = {};
    part_cycles_ = std::max<std::int64_t>(1, window / kParts);
    most_ = share * static_cast<double>(kParts * part_cycles_);
  }

  /// Counts one cycle; true if the guard has now limited in too many. [cyclic]
  bool add(bool limited) {
    if (cycle_++ == part_cycles_) {
      cycle_ = 1;
      part_ = (part_ + 1) % kParts;
      sum_ -= counts_[part_];
      counts_[part_] = 0;
    }
    if (!limited) return false;
    ++counts_[part_];
    ++sum_;
    if (!(static_cast<double>(sum_) > most_)) return false;
    counts_ = {};
    sum_ = 0;
    return true;
  }

 private:
  std::array<std::int32_t, kParts> counts_{};
  std::size_t part_ = 0;
  std::int64_t part_cycles_ = 1, cycle_ = 0, sum_ = 0;
  double most_ = 0.0;
};

}  // namespace tactus
