// Tests the cycle of CanHal with its sockets: what it costs in system calls and heap, and how it
// ends.
#include <linux/can.h>
#include <linux/can/error.h>
#include <unistd.h>

#include <cstring>

#include "program/heap_count.hpp"
#include "tests/sim_plant/drives/can_hal_bench.hpp"
#include "tests/wcet/can/can_cycle.hpp"

namespace tactus::can {
namespace {

// What is counted and bounded on the Cortex-M7 is what the Hal can receive.
static_assert(Arrived::kMost == CanSocket::kBatch);

constexpr int kCycles = 1000;

CanHalBench& fresh(int buses) {
  static std::optional<CanHalBench> bench;
  return bench.emplace(buses);
}
void start(CanHalBench& bench) {
  ASSERT_OK(bench.load());
  Status status = bench.start();
  if (status == Status::kOk) status = bench.arm_drives();
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
}
/// Number of calls to the heap in one cycle of the executive, with its pipeline.
std::uint64_t heap_calls_of_a_cycle(CanHalBench& bench) {
  bench.drives_ns += CanHalBench::kPeriod_ns;
  bench.exchange();
  const std::uint64_t before = heap_allocations();
  const HeapWatch watch;
  ASSERT_OK(bench.executive.cycle({bench.now_ns += CanHalBench::kPeriod_ns}));
  return heap_allocations() - before;
}

void costs_two_system_calls_per_bus_and_no_heap(int buses) {
  CanHalBench& bench = fresh(buses);
  start(bench);
  const int before = bench.hal.system_calls();
  std::uint64_t heap_calls = 0;
  for (int i = 0; i < kCycles; ++i) heap_calls += heap_calls_of_a_cycle(bench);
  assert_int_equal(heap_calls, 0);
  assert_int_equal(bench.hal.system_calls() - before, 2 * buses * kCycles);
}
// Proves CAN-15.
void a_cycle_on_one_fd_bus_takes_two_system_calls_and_no_heap(void**) {
  costs_two_system_calls_per_bus_and_no_heap(1);
}
void a_cycle_on_three_classic_buses_takes_two_system_calls_each_and_no_heap(void**) {
  costs_two_system_calls_per_bus_and_no_heap(3);
}

/// A gone bus costs its reading, and no sending.
void a_cycle_that_loses_a_bus_allocates_nothing(void**) {
  CanHalBench& bench = fresh(3);
  start(bench);
  (void)bench.cycle();
  bench.ends[2].reset();
  const std::uint64_t before = heap_allocations();
  const HeapWatch watch;
  for (int i = 0; i < 10; ++i)
    (void)bench.executive.cycle({bench.now_ns += CanHalBench::kPeriod_ns});
  assert_int_equal(heap_allocations() - before, 0);
}

bool names_bus(CanHalBench& bench, std::size_t bus) {
  Name name("bus fd:");
  name << bench.descriptors[bus] << ":";
  return std::strstr(bench.hal.trouble().c_str(), name.c_str()) != nullptr;
}

/// Commands of a quick stop among those that the Hal has just sent, with a frame for each drive.
int quick_stops(CanHalBench& bench) {
  bench.exchange();
  int count = 0;
  for (const CanFrame& frame : bench.sent)
    if (frame.id >> 7 == 4 && load<std::uint16_t>(frame.data, 0) == cia402::kQuickStop) ++count;
  return count;
}

/// Whichever bus it is, the drives of the others get a quick stop in the same cycle.
void a_peer_that_closes_its_end_ends_the_motion_in_that_cycle_and_is_named(void**) {
  for (std::size_t gone = 0; gone < 3; ++gone) {
    CanHalBench& bench = fresh(3);
    start(bench);
    for (int i = 0; i < 10; ++i) ASSERT_OK(bench.cycle());
    bench.drives_ns += CanHalBench::kPeriod_ns;
    bench.exchange();
    bench.ends[gone].reset();
    ASSERT_STATUS(bench.executive.cycle({bench.now_ns += CanHalBench::kPeriod_ns}),
                  Status::kConnectionLost);
    assert_true(names_bus(bench, gone));
    assert_int_equal(quick_stops(bench), gone == 0 ? 4 : 5);
    ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
    RobotState state;
    ASSERT_STATUS(bench.hal.read({bench.now_ns}, state), Status::kConnectionLost);
    assert_true(names_bus(bench, gone));
  }
}

void drives_are_stopped_without_a_bus_even_if_a_command_says_follow(void**) {
  CanHalBench& bench = fresh(3);
  start(bench);
  bench.ends[0].reset();
  RobotState state;
  ASSERT_STATUS(bench.hal.read({bench.now_ns += CanHalBench::kPeriod_ns}, state),
                Status::kConnectionLost);
  RobotCommand follow;
  follow.request = DriveRequest::kFollow;
  ASSERT_STATUS(bench.hal.write(follow), Status::kConnectionLost);
  assert_int_equal(quick_stops(bench), 4);
}

void a_peer_that_closes_its_end_while_connecting_is_named(void**) {
  CanHalBench& bench = fresh(3);
  ASSERT_OK(bench.load());
  bench.ends[1].reset();
  ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), Status::kConnectionLost);
  assert_true(names_bus(bench, 1));
}

/// Of a Hal that is closed: nothing is sent or received any more.
void is_closed(CanHalBench& bench) {
  RobotState state;
  ASSERT_STATUS(bench.hal.read({bench.now_ns}, state), Status::kNotStarted);
  ASSERT_STATUS(bench.hal.write(RobotCommand()), Status::kNotStarted);
  for (auto& end : bench.ends) {
    if (!end) continue;
    CanFrame frame;
    (void)end->receive(frame);  // fails once if the Hal left answers unread
    while (end->receive(frame)) {
    }
    assert_int_equal(end->descriptor(), -1);  // it has seen the end of the link
  }
}

void disconnecting_is_safe_before_anything_else(void**) {
  CanHalBench& bench = fresh(1);
  static_cast<void>(bench.hal.disconnect());
  static_cast<void>(bench.hal.disconnect());
  RobotState state;
  ASSERT_STATUS(bench.hal.read({0}, state), Status::kNotStarted);
  ASSERT_STATUS(bench.hal.write(RobotCommand()), Status::kNotStarted);
  ASSERT_OK(bench.load());
  static_cast<void>(bench.hal.disconnect());
  static_cast<void>(bench.hal.disconnect());
  ASSERT_STATUS(bench.hal.read({0}, state), Status::kNotStarted);
}

void disconnecting_is_safe_when_connected_armed_or_lost(void**) {
  for (int state = 0; state < 3; ++state) {
    CanHalBench& bench = fresh(3);
    if (state == 0) {
      ASSERT_OK(bench.load());
      ASSERT_OK(bench.start());
    } else {
      start(bench);
    }
    if (state == 2) {
      bench.ends[0].reset();
      ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
    }
    static_cast<void>(bench.hal.disconnect());
    static_cast<void>(bench.hal.disconnect());
    is_closed(bench);
  }
}

/// A report of the controller, as its driver puts it among the frames.
void report(CanHalBench& bench, std::uint32_t what, std::uint8_t detail) {
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | what;
  frame.can_dlc = CAN_ERR_DLC;
  frame.data[1] = detail;
  assert_true(write(bench.ends[0]->descriptor(), &frame, sizeof frame) == sizeof frame);
}

void a_controller_that_is_error_passive_goes_on_and_one_off_the_bus_ends_the_motion(void**) {
  CanHalBench& bench = fresh(1);
  start(bench);
  report(bench, CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  for (int i = 0; i < 10; ++i) ASSERT_OK(bench.cycle());
  assert_true(bench.hal.health(0).error_passive);
  report(bench, CAN_ERR_BUSOFF, 0);
  ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
  assert_non_null(std::strstr(bench.hal.trouble().c_str(), "bus-off"));
}

/// A controller that restarted by itself between two cycles was off the bus.
void a_controller_that_came_back_by_itself_ends_the_motion(void**) {
  CanHalBench& bench = fresh(1);
  start(bench);
  report(bench, CAN_ERR_BUSOFF, 0);
  report(bench, CAN_ERR_RESTARTED, 0);
  ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
}

/// No drive stops by a fault of its own, and none is left before it has confirmed.
void disconnecting_waits_until_drives_that_follow_are_disabled(void**) {
  CanHalBench& bench = fresh(1);
  start(bench);
  for (int i = 0; i < 10; ++i) ASSERT_OK(bench.cycle());
  bench.while_drives_answer([&] { static_cast<void>(bench.hal.disconnect()); });
  for (int j = 0; j < kDof; ++j) {
    assert_false(bench.arm.node(j).axis().powered());
    assert_true(bench.arm.node(j).axis().braked());
    assert_int_equal(static_cast<int>(bench.arm.node(j).axis().state()),
                     static_cast<int>(cia402::State::kSwitchOnDisabled));
  }
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cycle_on_one_fd_bus_takes_two_system_calls_and_no_heap),
      cmocka_unit_test(a_cycle_on_three_classic_buses_takes_two_system_calls_each_and_no_heap),
      cmocka_unit_test(a_cycle_that_loses_a_bus_allocates_nothing),
      cmocka_unit_test(a_peer_that_closes_its_end_ends_the_motion_in_that_cycle_and_is_named),
      cmocka_unit_test(drives_are_stopped_without_a_bus_even_if_a_command_says_follow),
      cmocka_unit_test(a_peer_that_closes_its_end_while_connecting_is_named),
      cmocka_unit_test(disconnecting_is_safe_before_anything_else),
      cmocka_unit_test(disconnecting_is_safe_when_connected_armed_or_lost),
      cmocka_unit_test(
          a_controller_that_is_error_passive_goes_on_and_one_off_the_bus_ends_the_motion),
      cmocka_unit_test(a_controller_that_came_back_by_itself_ends_the_motion),
      cmocka_unit_test(disconnecting_waits_until_drives_that_follow_are_disabled),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
