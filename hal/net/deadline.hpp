// Deadline: one time-out for several waits, so that a peer that answers a little at a time does not
// prolong the whole.
#pragma once

#include <ctime>

#include <cstdint>

namespace tactus {

class Deadline {
 public:
  /// Begins now. [init]
  explicit Deadline(int whole_ms)
      : whole_ms_(whole_ms), end_ns_(now_ns() + whole_ms * kMillisecond_ns) {}

  /// Time left, ns; 0 when it is over. [init]
  std::int64_t left_ns() const {
    const std::int64_t left = end_ns_ - now_ns();
    return left > 0 ? left : 0;
  }
  /// The whole time, ms, for messages.
  int whole_ms() const { return whole_ms_; }

  /// Time of the monotonic clock. [any]
  static std::int64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * kSecond_ns + now.tv_nsec;
  }

 private:
  static constexpr std::int64_t kMillisecond_ns = 1'000'000, kSecond_ns = 1'000'000'000;

  int whole_ms_;
  std::int64_t end_ns_;
};

}  // namespace tactus
