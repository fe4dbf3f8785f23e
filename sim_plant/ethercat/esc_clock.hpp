// EscClock: the local clock of a slave and its system time, which follows the reference clock
// (distributed clocks, IEC 61158-4-12).
#pragma once

#include <algorithm>
#include <cstdint>

namespace tactus::segment {

class EscClock {
 public:
  static constexpr std::int64_t kSlowest = 8;  ///< share of a difference that a step corrects

  EscClock() = default;
  /// A clock that shows `start_ns` at time 0 and gains `drift_ppb` thousand-millionths. [init]
  EscClock(std::int64_t start_ns, std::int64_t drift_ppb)
      : start_ns_(start_ns), drift_ppb_(drift_ppb) {}

  /// The free-running time at `now_ns`. [any]
  std::int64_t local(std::int64_t now_ns) const {
    return sum(start_ns_, now_ns + now_ns / 1'000'000 * drift_ppb_ / 1000);
  }
  /// The system time at `now_ns`, with the offset of register 0920h. [any]
  std::int64_t system(std::int64_t now_ns) const {
    const std::int64_t steered = rate_ppb_ * (now_ns - steered_ns_) / kBillion;
    return sum(sum(local(now_ns), offset_ns_), correction_ns_ + steered);
  }
  void set_offset(std::int64_t offset_ns) {
    offset_ns_ = offset_ns;
    correction_ns_ = 0;
  }
  std::int64_t offset() const { return offset_ns_; }
  void set_delay(std::int64_t delay_ns) { delay_ns_ = delay_ns; }
  std::int64_t delay() const { return delay_ns_; }
  /// Resets the filter, register 0930h. [any]
  void reset_filter() { rate_ppb_ = difference_ns_ = 0; }

  /// The reference time has come: corrects a part of the difference, and the rate. [cyclic]
  void steer(std::int64_t reference_ns, std::int64_t now_ns) {
    const std::int64_t system_ns = system(now_ns), before_ns = steered_ns_;
    correction_ns_ = bounded(difference(system_ns, sum(local(now_ns), offset_ns_)));
    steered_ns_ = now_ns;
    difference_ns_ = bounded(difference(system_ns, sum(reference_ns, delay_ns_)));
    const std::int64_t elapsed_ns = now_ns - before_ns;
    if (elapsed_ns <= 0 || elapsed_ns > kBillion) return;
    const std::int64_t step = std::clamp(-difference_ns_ / kSlowest, -kBillion, kBillion);
    correction_ns_ = bounded(correction_ns_ + step);
    rate_ppb_ = std::clamp(rate_ppb_ + step * (kBillion / 16) / elapsed_ns, -kMostRate, kMostRate);
  }
  /// Own time minus reference time at the last step. [any]
  std::int64_t difference() const { return difference_ns_; }

 private:
  static constexpr std::int64_t kBillion = 1'000'000'000, kMostRate = 500'000;
  static constexpr std::int64_t kMost = std::int64_t{1} << 60;

  // Registers hold any bits, and times wrap.
  static std::int64_t sum(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
  }
  static std::int64_t difference(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
  }
  static std::int64_t bounded(std::int64_t time_ns) { return std::clamp(time_ns, -kMost, kMost); }

  std::int64_t start_ns_ = 0, drift_ppb_ = 0;
  std::int64_t offset_ns_ = 0, delay_ns_ = 0, correction_ns_ = 0, difference_ns_ = 0;
  std::int64_t rate_ppb_ = 0, steered_ns_ = 0;
};

}  // namespace tactus::segment
