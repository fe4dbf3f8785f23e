// OverrunWatch: when single overruns become too many, and when they are over. More than a stated
// number within a window of cycles is too many; then counting begins anew, so that every further
// rung takes as many again. They are over after a stated number of cycles in a row without one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

class OverrunWatch {
 public:
  static constexpr int kMost = 16;  ///< largest `allowed`
  enum class Found : std::uint8_t { kNothing, kTooMany, kClean };

  /// More than `allowed`, 0..kMost, within `window` cycles are too many; `clean` cycles are clean.
  /// [init]
  void start(int allowed, int window, int clean) {
    *this = {};
    allowed_ = allowed, window_ = window, clean_ = clean;
  }

  /// What the cycle that has just ended comes to. [cyclic]
  Found add(bool overrun) {
    ++cycle_;
    if (!overrun) return ++clean_cycles_ % clean_ == 0 ? Found::kClean : Found::kNothing;
    clean_cycles_ = 0;
    // A ring of the last `allowed` overruns before this one: the oldest tells how long they took.
    const auto size = static_cast<std::size_t>(allowed_) + 1;
    cycles_[count_ % size] = cycle_;
    const bool full = ++count_ >= size;
    const std::int64_t oldest = cycles_[count_ % size];
    if (!full || cycle_ - oldest >= window_) return Found::kNothing;
    count_ = 0;
    return Found::kTooMany;
  }

 private:
  std::array<std::int64_t, kMost + 1> cycles_{};
  std::size_t count_ = 0;
  std::int64_t cycle_ = 0, clean_cycles_ = 0;
  int allowed_ = 0, window_ = 1, clean_ = 1;
};

}  // namespace tactus
