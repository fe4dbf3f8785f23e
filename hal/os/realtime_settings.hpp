// RealtimeSettings: the [realtime] section of a pipeline file, what a board on Linux asks of the
// operating system before the first cycle.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/describe.hpp"

namespace tactus {

enum class Switch : std::uint8_t { kOff, kOn };
inline constexpr std::array<const char*, 2> kSwitchWords = {"off", "on"};

/// What becomes of a start of which the operating system refuses a step.
enum class Required : std::uint8_t { kWarn, kRefuse };
inline constexpr std::array<const char*, 2> kRequiredWords = {"warn", "refuse"};

inline constexpr int kMaxStack_KiB = 1024;

struct RealtimeSettings {
  Required required = Required::kWarn;
  int priority = 80;  ///< of SCHED_FIFO; 0: not asked. 99 belongs to the kernel's own threads
  int cpu = -1;       ///< the one the cycle runs on; -1: any
  Switch lock_memory = Switch::kOn;
  Switch dma_latency = Switch::kOn;  ///< keep the CPUs out of sleep that takes long to leave
  int stack_KiB = 256;               ///< touched before the first cycle; 0: not asked
  int heap_KiB = 1024;  ///< likewise, and the C library keeps what it has; 0: not asked

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.choice("required", required, kRequiredWords);
    visit.param("priority", priority, Range{0.0, 98.0}, "1");
    visit.param("cpu", cpu, Range{-1.0, 1023.0}, "1");
    visit.choice("lock_memory", lock_memory, kSwitchWords);
    visit.choice("dma_latency", dma_latency, kSwitchWords);
    visit.param("stack_KiB", stack_KiB, Range{0.0, kMaxStack_KiB}, "KiB");
    visit.param("heap_KiB", heap_KiB, Range{0.0, 1e6}, "KiB");
  }
};

}  // namespace tactus
