#include "hal/os/realtime.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "hal/os/small_file.hpp"

namespace tactus {
namespace {

constexpr std::size_t kKiB = 1024;
constexpr std::size_t kPage = 4096;  // the smallest of any machine, so that no page is left out
constexpr int kReadsBackOtherwise = 0;
constexpr int kGranted = -1;

struct StepText {
  const char* name;
  const char* remedy;
};

// In the order of RealtimeStage.
constexpr std::array<StepText, 6> kTexts = {{
    {"cpu", "choose a CPU that is online and in the process's cpuset"},
    {"lock_memory", "raise RLIMIT_MEMLOCK (limits.conf: memlock unlimited) or grant CAP_IPC_LOCK"},
    {"stack", "set lock_memory = on, or lower stack_KiB"},
    {"heap", "free memory, or lower heap_KiB"},
    {"dma_latency", "give this user write access to /dev/cpu_dma_latency"},
    {"priority", "raise RLIMIT_RTPRIO (limits.conf: rtprio 98) or grant CAP_SYS_NICE"},
}};

void touch(volatile char* bytes, std::size_t size) {
  for (std::size_t i = 0; i < size; i += kPage) bytes[i] = 0;
}

/// Touches `size` bytes of the stack below the caller; the stack grows downwards.
[[gnu::noinline]] void touch_stack(std::size_t size) {
  constexpr std::size_t kLargest = std::size_t{kMaxStack_KiB} * kKiB;
  volatile char bytes[kLargest];
  touch(bytes + (kLargest - size), size);
}

/// Touches the stack twice; the second time must cause no page fault.
int prefault_stack(std::size_t size) {
  touch_stack(size);
  const std::int64_t before = page_faults();
  touch_stack(size);
  return page_faults() == before ? kGranted : kReadsBackOtherwise;
}

/// Makes the C library keep freed memory and take large pieces from the heap too, so that memory
/// touched once stays resident.
int prefault_heap(std::size_t size) {
#ifdef __GLIBC__
  if (mallopt(M_TRIM_THRESHOLD, -1) == 0 || mallopt(M_MMAP_MAX, 0) == 0) return EINVAL;
#endif
  auto* bytes = static_cast<char*>(std::malloc(size));
  if (bytes == nullptr) return ENOMEM;
  touch(bytes, size);
  const std::int64_t before = page_faults();
  touch(bytes, size);
  const bool resident = page_faults() == before;
  std::free(bytes);
  return resident ? kGranted : kReadsBackOtherwise;
}

}  // namespace

bool RealtimeReport::refused() const {
  return std::any_of(steps.begin(), steps.end(), [](const RealtimeStep& step) {
    return step.outcome == StepOutcome::kRefused;
  });
}

std::int64_t page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

int Realtime::set_cpu(int cpu) {
  cpu_set_t wanted, granted;
  CPU_ZERO(&wanted);
  CPU_SET(static_cast<std::size_t>(cpu), &wanted);
  if (sched_setaffinity(0, sizeof wanted, &wanted) != 0) return errno;
  if (sched_getaffinity(0, sizeof granted, &granted) != 0) return errno;
  return CPU_EQUAL(&wanted, &granted) ? kGranted : kReadsBackOtherwise;
}

/// Locks the memory and checks the result: a sandbox may report success without locking anything.
/// The locked size must be at least half of the resident size, which is approximate and includes
/// pages that are never locked.
int Realtime::lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) return errno;
  SmallFile status;
  if (!status.read("/proc/self/status")) return status.error();
  const int locked_kB = leading_int(status.line("VmLck:"));
  const int resident_kB = leading_int(status.line("VmRSS:"));
  return locked_kB > 0 && locked_kB >= resident_kB / 2 ? kGranted : kReadsBackOtherwise;
}

int Realtime::hold_dma_latency() {
  dma_latency_ = open("/dev/cpu_dma_latency", O_RDWR | O_CLOEXEC);
  if (dma_latency_ < 0) return errno;
  const std::int32_t wanted_us = 0;
  std::int32_t granted_us = -1;
  if (write(dma_latency_, &wanted_us, sizeof wanted_us) != sizeof wanted_us) return errno;
  if (pread(dma_latency_, &granted_us, sizeof granted_us, 0) != sizeof granted_us) return errno;
  return granted_us == wanted_us ? kGranted : kReadsBackOtherwise;
}

int Realtime::set_priority(int priority) {
  sched_param wanted{}, granted{};
  wanted.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO, &wanted) != 0) return errno;
  if (sched_getparam(0, &granted) != 0) return errno;
  const bool same =
      sched_getscheduler(0) == SCHED_FIFO && granted.sched_priority == wanted.sched_priority;
  return same ? kGranted : kReadsBackOtherwise;
}

const RealtimeReport& Realtime::apply(const RealtimeSettings& settings) {
  release();
  sched_param before{};
  sched_getparam(0, &before);
  priority_before_ = before.sched_priority;
  policy_before_ = sched_getscheduler(0);
  sched_getaffinity(0, sizeof cpus_before_, &cpus_before_);
  applied_ = true;
  const auto take = [this](RealtimeStage stage, bool asked, auto&& ask) {
    const auto i = static_cast<std::size_t>(stage);
    report_.steps[i] = {kTexts[i].name, StepOutcome::kNotAsked, 0, kTexts[i].remedy};
    if (!asked) return;
    const int error = ask();
    report_.steps[i].outcome = error == kGranted ? StepOutcome::kOk : StepOutcome::kRefused;
    report_.steps[i].error = std::max(error, 0);
  };
  const auto bytes = [](int size_KiB) { return static_cast<std::size_t>(size_KiB) * kKiB; };
  take(RealtimeStage::kCpu, settings.cpu >= 0, [&] { return set_cpu(settings.cpu); });
  take(RealtimeStage::kMemory, settings.lock_memory == Switch::kOn, [&] { return lock_memory(); });
  take(RealtimeStage::kStack, settings.stack_KiB > 0,
       [&] { return prefault_stack(bytes(settings.stack_KiB)); });
  take(RealtimeStage::kHeap, settings.heap_KiB > 0,
       [&] { return prefault_heap(bytes(settings.heap_KiB)); });
  take(RealtimeStage::kDmaLatency, settings.dma_latency == Switch::kOn,
       [&] { return hold_dma_latency(); });
  // The priority comes last, so that the steps above do not hold up the rest of the machine.
  take(RealtimeStage::kScheduler, settings.priority > 0,
       [&] { return set_priority(settings.priority); });
  return report_;
}

void Realtime::release() {
  if (!applied_) return;
  applied_ = false;
  const auto asked = [this](RealtimeStage stage) {
    return report_[stage].outcome != StepOutcome::kNotAsked;
  };
  sched_param before{};
  before.sched_priority = priority_before_;
  if (asked(RealtimeStage::kScheduler)) sched_setscheduler(0, policy_before_, &before);
  if (asked(RealtimeStage::kCpu)) sched_setaffinity(0, sizeof cpus_before_, &cpus_before_);
  if (asked(RealtimeStage::kMemory)) munlockall();
  if (dma_latency_ >= 0) close(dma_latency_);
  dma_latency_ = -1;
}

}  // namespace tactus
