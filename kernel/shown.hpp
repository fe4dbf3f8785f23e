// Shown: a number that the cycle writes and anybody may read, from any thread, without a lock and
// without disturbing the cycle. Each is whole by itself; two of them need not be of one cycle.
#pragma once

#include <atomic>

namespace tactus {

template <class T>
class Shown {
  static_assert(std::atomic<T>::is_always_lock_free, "a lock would be taken: use 32 bits");

 public:
  Shown() = default;
  Shown(T value) : value_(value) {}  // NOLINT: a number that is shown is a number
  Shown(const Shown& other) : value_(static_cast<T>(other)) {}
  operator T() const { return value_.load(std::memory_order_relaxed); }  // NOLINT
  /// [cyclic, one writer]
  Shown& operator=(T value) {
    value_.store(value, std::memory_order_relaxed);
    return *this;
  }
  Shown& operator=(const Shown& other) { return *this = static_cast<T>(other); }
  Shown& operator++() { return *this += T{1}; }
  Shown& operator+=(T value) { return *this = static_cast<T>(*this + value); }

 private:
  std::atomic<T> value_{};
};

}  // namespace tactus
