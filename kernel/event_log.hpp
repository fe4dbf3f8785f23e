// EventLog: the last changes of rung, in fixed memory. One writer, the cycle; any thread reads
// without a lock. A new event overwrites the oldest; how many are lost is known.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "kernel/ladder.hpp"

namespace tactus {

struct Event {
  std::int64_t stamp_ns = 0;    ///< when the cycle began, by its own clock
  std::uint32_t cycle = 0;      ///< its number since start
  float value = 0.0F;           ///< what was found: joint's value, periods missed, us; 0: nothing
  Status status = Status::kOk;  ///< why
  Cause cause = Cause::kRearm;
  Rung from = Rung::kDisabled, to = Rung::kDisabled;
  std::int8_t joint = -1;  ///< from 0; -1: not of a joint
};
static_assert(std::is_trivially_copyable_v<Event>);

class EventLog {
 public:
  static constexpr std::uint32_t kCapacity = 32;

  /// [cyclic, one writer]
  void add(const Event& event) {
    const std::uint32_t number = added_.load(std::memory_order_relaxed);
    std::array<std::uint32_t, kWords> words{};
    std::memcpy(words.data(), &event, sizeof event);
    begun_.store(number + 1, std::memory_order_relaxed);  // seen by whoever sees a new word
    Slot& slot = slots_[number % kCapacity];
    for (std::size_t i = 0; i < kWords; ++i) slot[i].store(words[i], std::memory_order_release);
    added_.store(number + 1, std::memory_order_release);
  }
  /// Forgets everything; nobody may read meanwhile. [init]
  void clear() {
    added_.store(0, std::memory_order_relaxed);
    begun_.store(0, std::memory_order_relaxed);
  }

  /// How many there have been. [any]
  std::uint32_t count() const { return added_.load(std::memory_order_acquire); }
  /// How many of them are overwritten. [any]
  std::uint32_t lost() const { return count() > kCapacity ? count() - kCapacity : 0; }
  /// Event `number`, from 0; false if there is none such, or it is overwritten. [any]
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
  using Slot = std::array<std::atomic<std::uint32_t>, kWords>;

  std::array<Slot, kCapacity> slots_{};
  std::atomic<std::uint32_t> begun_{0}, added_{0};
};

}  // namespace tactus
