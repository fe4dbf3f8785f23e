// EventLog: the last changes of rung, in fixed memory. One writer, the cycle; any thread may read
// without a lock. A new event overwrites the oldest, and the number of lost events is known.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "kernel/cycle/ladder.hpp"

namespace tactus {

struct Event {
  std::int64_t stamp_ns = 0;    ///< begin of the cycle, by the clock that triggers it
  std::uint32_t cycle = 0;      ///< its number since start
  std::uint32_t commanded = 0;  ///< cycles before it in which the drives followed: the log's time
  float value = 0.0F;           ///< value found: of a joint, missed periods, or us; 0: none
  std::uint32_t code = 0;       ///< the drive's own number of fault or warning; 0: none
  Status status = Status::kOk;  ///< why
  Cause cause = Cause::kRearm;
  Rung from = Rung::kDisabled, to = Rung::kDisabled;
  std::int8_t joint = -1;  ///< from 0; -1: no joint
};
static_assert(std::is_trivially_copyable_v<Event>);

/// `Atomic` and `capacity` are others in the test that tries its memory orders.
template <template <class> class Atomic, std::uint32_t capacity>
class EventLogOf {
 public:
  static constexpr std::uint32_t kCapacity = capacity;

  /// [cyclic, one writer]
  void add(const Event& event) {
    const std::uint32_t number = added_.load(std::memory_order_relaxed);
    std::array<std::uint32_t, kWords> words{};
    std::memcpy(words.data(), &event, sizeof event);
    begun_.store(number + 1, std::memory_order_relaxed);  // a reader of a new word sees it
    Slot& slot = slots_[number % kCapacity];
    for (std::size_t i = 0; i < kWords; ++i) slot[i].store(words[i], std::memory_order_release);
    added_.store(number + 1, std::memory_order_release);
  }
  /// Number of events so far. [any]
  std::uint32_t count() const { return added_.load(std::memory_order_acquire); }
  /// Number of events that are overwritten. [any]
  std::uint32_t lost() const { return count() > kCapacity ? count() - kCapacity : 0; }
  /// Reads event `number`, from 0; false if it does not exist or is overwritten. [any]
  bool read(std::uint32_t number, Event& event) const {
    if (number >= count()) return false;
    std::array<std::uint32_t, kWords> words;
    const Slot& slot = slots_[number % kCapacity];
    for (std::size_t i = 0; i < kWords; ++i) words[i] = slot[i].load(std::memory_order_acquire);
    std::memcpy(static_cast<void*>(&event), words.data(), sizeof event);
    return begun_.load(std::memory_order_relaxed) - number <= kCapacity;
  }

 private:
  static constexpr std::size_t kWords = sizeof(Event) / sizeof(std::uint32_t);
  static_assert(sizeof(Event) % sizeof(std::uint32_t) == 0);
  using Slot = std::array<Atomic<std::uint32_t>, kWords>;

  std::array<Slot, kCapacity> slots_{};
  Atomic<std::uint32_t> begun_{0}, added_{0};
};

using EventLog = EventLogOf<std::atomic, 32>;

}  // namespace tactus
