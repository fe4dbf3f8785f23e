// Mailbox: a wait-free queue of fixed size between exactly one producer and one consumer. A full
// mailbox refuses, it never overwrites: whoever posts knows, and nothing is lost silently.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace tactus {

template <class T, std::size_t N>
class Mailbox {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "the capacity is a power of two");
  static_assert(std::is_trivially_destructible_v<T>, "messages are plain values");

 public:
  static constexpr std::size_t capacity() { return N; }

  /// Puts a message in; false, and nothing happens, if the mailbox is full. [any, producer only]
  bool post(const T& message) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == N) return false;
    slots_[head % N] = message;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Takes the oldest message out; false if there is none. [any, consumer only]
  bool take(T& message) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    message = slots_[tail % N];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Messages that wait; the producer can only make it more. [any, consumer only]
  std::size_t size() const {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_relaxed);
  }

  /// Messages that can be posted for certain; the consumer can only make it more. [any, producer
  /// only]
  std::size_t space() const {
    return N - (head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire));
  }

 private:
  std::array<T, N> slots_{};
  std::atomic<std::uint32_t> head_{0};  // written by the producer
  std::atomic<std::uint32_t> tail_{0};  // written by the consumer
};

}  // namespace tactus
