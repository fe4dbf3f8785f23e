// Tests the requests to Linux before the first cycle. Every test runs in a child process, with its
// rights or without them. The host decides what it grants; the report must be true in either case.
#include "hal/os/realtime.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "program/heap_count.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr std::size_t kPage = 4096;
constexpr int kNobody = 65534;
constexpr RealtimeSettings kNothing = {Required::kWarn, 0, -1, Switch::kOff, Switch::kOff, 0, 0};

/// Ends a child's body with false and prints the place.
#define CHECK(condition)                                                   \
  do {                                                                     \
    if (!(condition)) {                                                    \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
      return false;                                                        \
    }                                                                      \
  } while (false)

void in_a_child(bool (*body)()) {
  const pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) _exit(body() ? 0 : 1);
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/// Takes every right from the child, whoever runs the tests.
void drop_rights() {
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &none);
  if (setresuid(kNobody, kNobody, kNobody) != 0) std::perror("setresuid");
  __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2] = {};
  syscall(SYS_capset, &header, data);
}

bool is(const RealtimeStep& step, StepOutcome outcome, int error) {
  if (step.outcome == outcome && step.error == error) return true;
  std::fprintf(stderr, "%s: %s, errno %d\n", step.name, name(step.outcome), step.error);
  return false;
}

// Proves RT-1.

void nothing_that_is_not_asked_for_is_done(void**) {
  in_a_child([] {
    drop_rights();
    Realtime realtime;
    const RealtimeReport& report = realtime.apply(kNothing);
    CHECK(!report.refused());
    for (const RealtimeStep& step : report.steps) CHECK(is(step, StepOutcome::kNotAsked, 0));
    return true;
  });
}

void every_refusal_is_reported_with_its_reason_and_a_remedy(void**) {
  in_a_child([] {
    drop_rights();
    RealtimeSettings settings;
    settings.cpu = 1023;
    Realtime realtime;
    const RealtimeReport& report = realtime.apply(settings);
    CHECK(report.refused());
    CHECK(is(report[RealtimeStage::kCpu], StepOutcome::kRefused, EINVAL));
    CHECK(is(report[RealtimeStage::kScheduler], StepOutcome::kRefused, EPERM));
    // The address sanitizer grants a lock without locking: only reading it back reveals that.
    CHECK(is(report[RealtimeStage::kMemory], StepOutcome::kRefused, kHeapIsCounted ? EPERM : 0));
    const RealtimeStep& dma_latency = report[RealtimeStage::kDmaLatency];
    if (geteuid() != 0)
      CHECK(is(dma_latency, StepOutcome::kRefused, EACCES) ||
            is(dma_latency, StepOutcome::kRefused, ENOENT));
    for (const RealtimeStep& step : report.steps) CHECK(step.name[0] != 0 && step.remedy[0] != 0);
    if (kHeapIsCounted)  // needs the C library's own heap
      CHECK(is(report[RealtimeStage::kHeap], StepOutcome::kOk, 0));
    return true;
  });
}

void memory_that_is_not_there_is_refused(void**) {
  if (!kHeapIsCounted) _skip(__FILE__, __LINE__);  // sanitizers end the program here
  in_a_child([] {
    const rlimit little = {std::size_t{256} << 20, std::size_t{256} << 20};
    setrlimit(RLIMIT_AS, &little);
    RealtimeSettings settings = kNothing;
    settings.heap_KiB = 1000000;
    Realtime realtime;
    const RealtimeReport& report = realtime.apply(settings);
    CHECK(report.refused());
    return is(report[RealtimeStage::kHeap], StepOutcome::kRefused, ENOMEM);
  });
}

// Proves RT-2.

void the_thread_runs_on_the_cpu_that_is_named_and_is_let_go_again(void**) {
  in_a_child([] {
    drop_rights();
    cpu_set_t before, during, after;
    CHECK(sched_getaffinity(0, sizeof before, &before) == 0);
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
      if (!CPU_ISSET(static_cast<std::size_t>(cpu), &before)) continue;
      RealtimeSettings settings = kNothing;
      settings.cpu = cpu;
      Realtime realtime;
      CHECK(is(realtime.apply(settings)[RealtimeStage::kCpu], StepOutcome::kOk, 0));
      CHECK(sched_getcpu() == cpu);
      CHECK(sched_getaffinity(0, sizeof during, &during) == 0 && CPU_COUNT(&during) == 1);
      realtime.release();
      CHECK(sched_getaffinity(0, sizeof after, &after) == 0 && CPU_EQUAL(&before, &after));
    }
    return true;
  });
}

void a_priority_that_is_granted_is_in_force_until_it_is_given_back(void**) {
  in_a_child([] {
    Realtime realtime;
    RealtimeSettings settings = kNothing;
    settings.priority = 7;
    const RealtimeStep& step = realtime.apply(settings)[RealtimeStage::kScheduler];
    sched_param during{};
    const bool granted = step.outcome == StepOutcome::kOk;
    CHECK(granted || is(step, StepOutcome::kRefused, EPERM));
    CHECK(sched_getscheduler(0) == (granted ? SCHED_FIFO : SCHED_OTHER));
    CHECK(sched_getparam(0, &during) == 0 && during.sched_priority == (granted ? 7 : 0));
    realtime.release();
    return sched_getscheduler(0) == SCHED_OTHER;
  });
}

/// Whether a page just mapped, and not touched, is in memory.
bool new_page_is_resident() {
  void* page = mmap(nullptr, kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  unsigned char resident = 0;
  mincore(page, kPage, &resident);
  munmap(page, kPage);
  return (resident & 1U) != 0;
}

void memory_that_is_locked_is_there_before_it_is_touched(void**) {
  in_a_child([] {
    Realtime realtime;
    RealtimeSettings settings = kNothing;
    settings.lock_memory = Switch::kOn;
    CHECK(!new_page_is_resident());
    const bool granted =
        realtime.apply(settings)[RealtimeStage::kMemory].outcome == StepOutcome::kOk;
    CHECK(new_page_is_resident() == granted);
    realtime.release();
    return !new_page_is_resident();
  });
}

/// The number of pages fetched for a stack of that many bytes.
[[gnu::noinline]] std::int64_t faults_of_stack() {
  volatile char bytes[400 * 1024];
  const std::int64_t before = page_faults();
  for (std::size_t i = 0; i < sizeof bytes; i += kPage) bytes[i] = 1;
  return page_faults() - before;
}

void stack_that_was_fetched_before_is_not_fetched_again(void**) {
  if (!kHeapIsCounted) _skip(__FILE__, __LINE__);  // sanitizers need more memory for a stack
  in_a_child([] {
    Realtime realtime;
    RealtimeSettings settings = kNothing;
    settings.stack_KiB = 512;
    CHECK(is(realtime.apply(settings)[RealtimeStage::kStack], StepOutcome::kOk, 0));
    return faults_of_stack() == 0;
  });
}

void a_latency_that_is_granted_is_the_one_the_kernel_keeps(void**) {
  in_a_child([] {
    Realtime realtime;
    RealtimeSettings settings = kNothing;
    settings.dma_latency = Switch::kOn;
    const RealtimeStep& step = realtime.apply(settings)[RealtimeStage::kDmaLatency];
    if (step.outcome == StepOutcome::kRefused) return step.error != 0;
    std::int32_t kept_us = -1;
    const auto read_back = [&kept_us] {
      const int file = open("/dev/cpu_dma_latency", O_RDONLY);
      const bool good = read(file, &kept_us, sizeof kept_us) == sizeof kept_us;
      close(file);
      return good;
    };
    CHECK(read_back() && kept_us == 0);
    return true;
  });
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(nothing_that_is_not_asked_for_is_done),
      cmocka_unit_test(every_refusal_is_reported_with_its_reason_and_a_remedy),
      cmocka_unit_test(memory_that_is_not_there_is_refused),
      cmocka_unit_test(the_thread_runs_on_the_cpu_that_is_named_and_is_let_go_again),
      cmocka_unit_test(a_priority_that_is_granted_is_in_force_until_it_is_given_back),
      cmocka_unit_test(memory_that_is_locked_is_there_before_it_is_touched),
      cmocka_unit_test(stack_that_was_fetched_before_is_not_fetched_again),
      cmocka_unit_test(a_latency_that_is_granted_is_the_one_the_kernel_keeps),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
