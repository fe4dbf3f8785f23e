// Tests that a cycle with a UR's HAL never allocates, whatever arrives over the wire.
#include <cstdlib>

#include "program/heap_count.hpp"
#include "tests/ur/hal/ur_moving_bench.hpp"

namespace tactus::ur {
namespace {

/// Number of calls to the heap that `run` makes in this thread.
template <class Run>
std::uint64_t calls_of(Run&& run) {
  const std::uint64_t before = heap_allocations();
  const HeapWatch watch;
  run();
  return heap_allocations() - before;
}

// Proves URH-26.

void calls_to_the_heap_are_counted(void**) {
  const auto call = [] {
    void* volatile memory = std::malloc(100);
    std::free(memory);
  };
  assert_int_equal(calls_of(call), kHeapIsCounted ? 1 : 0);
}

void a_cycle_allocates_nothing(void**) {
  UrHalBench& bench = moving();
  Status ended = Status::kOk;
  const std::uint64_t calls = calls_of([&] {
    ASSERT_OK(bench.cycles(100));
    for (int i = 0; i < 3; ++i) ASSERT_OK(bench.run_cycle());  // bridged
    for (int i = 0; i < 4; ++i) bench.robot.send_package();    // late, and concatenated
    ASSERT_OK(bench.cycle());
    bench.robot.send_code(153, 2);
    bench.robot.drop_rtde();
    ended = bench.run_cycle();
  });
  assert_int_equal(calls, 0);
  ASSERT_STATUS(ended, Status::kConnectionLost);
}

/// From the first connection to the program that holds the arm, and the way back.
void a_start_allocates_nothing(void**) {
  UrHalBench& bench = g_bench.emplace();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  ASSERT_OK(bench.start());
  static_cast<void>(bench.executive.stop());
  bench.robot.change([](FakeImage& image) {
    image.robot_mode = 3;
    image.runtime_state = 1;
  });
  Status status = Status::kOk;
  const std::uint64_t calls = calls_of([&] { status = bench.start(); });
  ASSERT_STATUS(status, Status::kOk);
  assert_int_equal(calls, 0);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(calls_to_the_heap_are_counted),
      cmocka_unit_test(a_cycle_allocates_nothing),
      cmocka_unit_test(a_start_allocates_nothing),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
