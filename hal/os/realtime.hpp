// Realtime: asks Linux for what a cycle needs, step by step, and reads every step back from the
// system: what was granted is what the report says, not what was asked for.
#pragma once

#include <sched.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/os/realtime_settings.hpp"

namespace tactus {

enum class StepOutcome : std::uint8_t { kNotAsked, kOk, kRefused };
inline constexpr std::array<const char*, 3> kStepOutcomeWords = {"not asked", "ok", "refused"};

struct RealtimeStep {
  const char* name = "";
  StepOutcome outcome = StepOutcome::kNotAsked;
  int error = 0;  ///< errno of a refusal; 0: granted, but reading back says otherwise
  const char* remedy = "";
};

/// The steps in the order they are taken in.
enum class RealtimeStage : std::uint8_t { kCpu, kMemory, kStack, kHeap, kDmaLatency, kScheduler };

struct RealtimeReport {
  std::array<RealtimeStep, 6> steps;

  const RealtimeStep& operator[](RealtimeStage stage) const {
    return steps[static_cast<std::size_t>(stage)];
  }
  /// Whether any step was asked for and refused.
  bool refused() const;
};

class Realtime {
 public:
  Realtime() = default;
  ~Realtime() { release(); }
  Realtime(const Realtime&) = delete;
  Realtime& operator=(const Realtime&) = delete;

  /// Takes every step that is asked for, for the calling thread; a step that is refused does not
  /// keep the others from being taken. Threads and programs started later inherit priority and CPU.
  /// [init]
  const RealtimeReport& apply(const RealtimeSettings& settings);
  const RealtimeReport& report() const { return report_; }
  /// Gives back what was granted, but for the C library's way with the heap; from the thread that
  /// applied. [any]
  void release();

 private:
  int set_cpu(int cpu);
  int lock_memory();
  int hold_dma_latency();
  int set_priority(int priority);

  RealtimeReport report_;
  bool applied_ = false;
  int dma_latency_ = -1;  // the open file; the demand ends when it is closed
  int policy_before_ = 0, priority_before_ = 0;
  cpu_set_t cpus_before_{};
};

/// Pages the calling thread had to wait for since it began. [any]
std::int64_t page_faults();

}  // namespace tactus
