// Realtime: requests from Linux what a cycle needs, step by step, and reads every step back, so
// that the report says what was granted, not what was requested.
#pragma once

#include <sched.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/os/realtime_settings.hpp"

namespace tactus {

enum class StepOutcome : std::uint8_t { kNotAsked, kOk, kRefused };

constexpr const char* name(StepOutcome outcome) {
  switch (outcome) {
    case StepOutcome::kNotAsked: return "not asked";
    case StepOutcome::kOk: return "ok";
    case StepOutcome::kRefused: return "refused";
  }
  return nullptr;
}

struct RealtimeStep {
  const char* name = "";
  StepOutcome outcome = StepOutcome::kNotAsked;
  int error = 0;  ///< errno of a refusal; 0: granted, but not in effect when read back
  const char* remedy = "";
};

/// The steps, in the order in which they are taken.
enum class RealtimeStage : std::uint8_t { kCpu, kMemory, kStack, kHeap, kDmaLatency, kScheduler };

struct RealtimeReport {
  std::array<RealtimeStep, 6> steps;

  const RealtimeStep& operator[](RealtimeStage stage) const {
    return steps[static_cast<std::size_t>(stage)];
  }
  /// True if any requested step was refused.
  bool refused() const;
};

class Realtime {
 public:
  Realtime() = default;
  ~Realtime() { release(); }
  Realtime(const Realtime&) = delete;
  Realtime& operator=(const Realtime&) = delete;

  /// Takes every requested step for the calling thread; after a refused step the others are still
  /// taken. Threads and programs started later inherit priority and CPU. [init]
  const RealtimeReport& apply(const RealtimeSettings& settings);
  const RealtimeReport& report() const { return report_; }
  /// Undoes the steps, except the settings of the C library's heap. Call it from the thread that
  /// called apply(). [any]
  void release();

 private:
  int set_cpu(int cpu);
  int lock_memory();
  int hold_dma_latency();
  int set_priority(int priority);

  RealtimeReport report_;
  bool applied_ = false;
  int dma_latency_ = -1;  // the open file; the request ends when it is closed
  int policy_before_ = 0, priority_before_ = 0;
  cpu_set_t cpus_before_{};
};

/// Returns the number of page faults of the calling thread since it began. [any]
std::int64_t page_faults();

}  // namespace tactus
