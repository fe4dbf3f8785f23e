// Mailbox: a wait-free queue of fixed size between exactly one producer and one consumer. A full
// mailbox refuses a message and never overwrites one: the producer always gets the result, so
// nothing is lost silently.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace tactus {

/// A mailbox whose slots are elsewhere: Mailbox is the one that has them.
/// `Atomic` is another than the standard's in the test that tries its memory orders.
template <class T, template <class> class Atomic = std::atomic>
class MessageQueue {
  static_assert(std::is_trivially_destructible_v<T>, "messages are plain values");

 public:
  /// Uses `capacity` slots, a power of two; they outlive the queue. [init]
  MessageQueue(T* slots, std::uint32_t capacity) : slots_(slots), capacity_(capacity) {}
  MessageQueue(const MessageQueue&) = delete;
  MessageQueue& operator=(const MessageQueue&) = delete;

  std::size_t capacity() const { return capacity_; }

  /// Appends a message. Returns false, without effect, if the mailbox is full. [any, producer only]
  bool post(const T& message) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == capacity_) return false;
    slots_[head & (capacity_ - 1)] = message;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Removes the oldest message; false if there is none. [any, consumer only]
  bool take(T& message) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    message = slots_[tail & (capacity_ - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Number of waiting messages, at least: the producer may add more. [any, consumer only]
  std::size_t size() const {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_relaxed);
  }

  /// Number of messages that can be posted, at least: the consumer may free more.
  /// [any, producer only]
  std::size_t space() const {
    return capacity_ -
           (head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire));
  }

 private:
  T* slots_;
  std::uint32_t capacity_;
  Atomic<std::uint32_t> head_{0};  // written by the producer
  Atomic<std::uint32_t> tail_{0};  // written by the consumer
};

template <class T, std::uint32_t N, template <class> class Atomic = std::atomic>
class Mailbox : public MessageQueue<T, Atomic> {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "the capacity is a power of two");

 public:
  Mailbox() : MessageQueue<T, Atomic>(slots_, N) {}

 private:
  T slots_[N]{};  // no std::array, whose data() must not be called before its construction
};

}  // namespace tactus
