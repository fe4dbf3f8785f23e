// RateWatch: decides when single bad cycles, which overran or began late, become too many, and when
// they are over. More than a stated number within a window of cycles is too many; counting then
// restarts, so that every further rung takes as many again. They are over after a stated number of
// good cycles in a row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

class RateWatch {
 public:
  static constexpr int kMost = 16;  ///< largest `allowed`
  enum class Result : std::uint8_t { kNothing, kTooMany, kClean };

  /// Restarts the watch: more than `allowed` bad cycles, 0..kMost, within `window` cycles are too
  /// many; `clean` good cycles in a row are clean. [init]
  void start(int allowed, int window, int clean) {
    *this = {};
    allowed_ = allowed;
    window_ = window;
    clean_ = clean;
  }

  /// Counts the cycle that has just ended and returns the result. [cyclic]
  Result add(bool bad) {
    ++cycle_;
    if (!bad) return ++clean_cycles_ % clean_ == 0 ? Result::kClean : Result::kNothing;
    clean_cycles_ = 0;
    // A ring of this bad cycle and the `allowed` before it: the oldest gives their duration.
    const auto size = static_cast<std::size_t>(allowed_) + 1;
    cycles_[count_ % size] = cycle_;
    const bool full = ++count_ >= size;
    const std::int64_t oldest = cycles_[count_ % size];
    if (!full || cycle_ - oldest >= window_) return Result::kNothing;
    count_ = 0;
    return Result::kTooMany;
  }

 private:
  std::array<std::int64_t, kMost + 1> cycles_{};
  std::size_t count_ = 0;
  std::int64_t cycle_ = 0, clean_cycles_ = 0;
  int allowed_ = 0, window_ = 1, clean_ = 1;
};

}  // namespace tactus
