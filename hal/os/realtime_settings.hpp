// RealtimeSettings: the [realtime] section of a pipeline file, which a board on Linux requests from
// the operating system before the first cycle.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/load_error.hpp"

namespace tactus {

enum class Switch : std::uint8_t { kOff, kOn };

constexpr const char* name(Switch state) {
  switch (state) {
    case Switch::kOff: return "off";
    case Switch::kOn: return "on";
  }
  return nullptr;
}

/// Whether a start continues if the operating system refuses a step, or if the host harms real time
/// by a required setting that no step can change.
enum class Required : std::uint8_t { kWarn, kRefuse };

constexpr const char* name(Required required) {
  switch (required) {
    case Required::kWarn: return "warn";
    case Required::kRefuse: return "refuse";
  }
  return nullptr;
}

inline constexpr int kMaxStack_KiB = 1024;

struct RealtimeSettings {
  Required required = Required::kWarn;
  int priority = 80;  ///< of SCHED_FIFO; 0: not requested; 99 belongs to the kernel's own threads
  int cpu = -1;       ///< CPU of the cycle; -1: any
  Switch lock_memory = Switch::kOn;
  Switch dma_latency = Switch::kOn;  ///< keep the CPUs out of sleep states that take long to leave
  int stack_KiB = 256;               ///< touched before the first cycle; 0: not requested
  int heap_KiB = 1024;               ///< touched and kept by the C library; 0: not requested
  Value watchdog{};                  ///< device that resets the machine; empty: none
  int watchdog_timeout_s = 5;        ///< it does so that long after the last completed cycle

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.choice("required", required);
    visit.param("priority", priority, Range{0.0, 98.0}, "1");
    visit.param("cpu", cpu, Range{-1.0, 1023.0}, "1");
    visit.choice("lock_memory", lock_memory);
    visit.choice("dma_latency", dma_latency);
    visit.param("stack_KiB", stack_KiB, Range{0.0, kMaxStack_KiB}, "KiB");
    visit.param("heap_KiB", heap_KiB, Range{0.0, 1e6}, "KiB");
    visit.text("watchdog", watchdog, "device of a hardware watchdog: /dev/watchdog; default: none");
    visit.param("watchdog_timeout_s", watchdog_timeout_s, Range{1.0, 3600.0}, "s");
  }
};

}  // namespace tactus
