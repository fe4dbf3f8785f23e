// Published: a number that the cycle writes and any thread may read, without a lock and without
// disturbing the cycle. Each number is consistent in itself; two of them may come from different
// cycles.
#pragma once

#include <atomic>

namespace tactus {

template <class T>
class Published {
  static_assert(std::atomic<T>::is_always_lock_free, "a lock would be taken: use 32 bits");

 public:
  Published() = default;
  Published(T value) : value_(value) {}  // NOLINT: implicit, as for a plain number
  Published(const Published& other) : value_(static_cast<T>(other)) {}
  operator T() const { return value_.load(std::memory_order_relaxed); }  // NOLINT
  /// [cyclic, one writer]
  Published& operator=(T value) {
    value_.store(value, std::memory_order_relaxed);
    return *this;
  }
  Published& operator=(const Published& other) { return *this = static_cast<T>(other); }
  Published& operator++() { return *this += T{1}; }
  Published& operator+=(T value) { return *this = static_cast<T>(*this + value); }

 private:
  std::atomic<T> value_{};
};

}  // namespace tactus
