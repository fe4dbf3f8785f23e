// Tests the reaction of a UR's HAL to every fault of a robot in motion: Status, rung, cycles until
// the reaction, and the recovery; and to a robot that does not take its set-points. The table is
// that of docs/robots/ur10.md. A cycle never allocates, whatever arrives over the wire.
#include <cstdlib>

#include "program/heap_count.hpp"
#include "tests/ur/hal/ur_moving_bench.hpp"

namespace tactus::ur {
namespace {

struct ModeRow {
  const char* what;
  std::int32_t robot, safety;
  std::uint32_t bits, runtime;
  Status expected;
  const char* reason;
};

// Proves URH-7, URH-8.
void what_the_robot_says_ends_the_motion_in_its_cycle(void**) {
  for (const ModeRow& row :
       {ModeRow{"protective stop", 7, 3, 4, 2, Status::kProtectiveStop, "PROTECTIVE_STOP"},
        ModeRow{"protective stop, bits first", 7, 1, 4, 2, Status::kProtectiveStop,
                "PROTECTIVE_STOP"},
        ModeRow{"emergency stop at the robot", 3, 7, 1u << 6, 1, Status::kEmergencyStop,
                "ROBOT_EMERGENCY_STOP"},
        ModeRow{"emergency stop of the system", 3, 6, 1u << 5, 1, Status::kEmergencyStop,
                "SYSTEM_EMERGENCY_STOP"},
        ModeRow{"safeguard stop", 7, 5, 16, 4, Status::kSafeguardStop, "SAFEGUARD_STOP"},
        ModeRow{"violation", 3, 8, 1u << 8, 1, Status::kDriveFault, "VIOLATION"},
        ModeRow{"power off", 3, 1, 1, 1, Status::kRobotMode, "POWER_OFF"},
        ModeRow{"freedrive", 6, 1, 1, 2, Status::kRobotMode, "BACKDRIVE"},
        ModeRow{"unknown mode", 77, 1, 1, 2, Status::kRobotMode, "77"},
        ModeRow{"program stopped", 7, 1, 1, 1, Status::kProgramStopped, "is stopped"},
        ModeRow{"program paused", 7, 1, 1, 4, Status::kProgramStopped, "is paused"}}) {
    UrHalBench& bench = moving();
    bench.robot.change([&](FakeImage& image) {
      image.robot_mode = row.robot;
      image.safety_mode = row.safety;
      image.safety_bits = row.bits;
      image.runtime_state = row.runtime;
    });
    assert_int_equal(cycles_until_stopped(bench, 5), 1);
    assert_disabled_by_drive(bench, row.expected);
    assert_true(bench.says(row.reason));
    bench.robot.set_point(kServoEnded);  // the program was told
    assert_rearms_without_motion(bench);
    assert_int_equal(bench.robot.ends(), 1);
  }
}

// Proves URH-9.
void the_robots_own_code_is_told(void**) {
  UrHalBench& bench = moving();
  bench.robot.change([](FakeImage& image) { image.safety_mode = 3; });
  bench.robot.send_code(153, 2);
  assert_int_equal(cycles_until_stopped(bench, 5), 1);
  assert_true(bench.says("C153A2: position deviates from the path, joint 3 (elbow)"));
  RobotState state;
  ASSERT_OK(bench.hal.read({}, state));
  assert_int_equal(state.drives[0].code, 153);
}

// Proves URH-12.
void a_connection_that_is_closed_ends_the_motion_in_the_next_cycle(void**) {
  UrHalBench& bench = moving();
  bench.robot.drop_rtde();
  ASSERT_STATUS(bench.run_cycle(), Status::kConnectionLost);
  assert_disabled_by_wire(bench, Status::kConnectionLost);
  assert_reconnects_without_motion(bench);
}

// Proves URH-7.
/// It plays, but it is not ours: the last count stays in the register.
void a_program_that_uses_no_set_points_ends_the_motion(void**) {
  UrHalBench& bench = moving();
  bench.robot.faults.uses_no_set_points = true;
  ASSERT_OK(bench.cycles(bench.settings.patience + 5));
  assert_in_range(cycles_until_stopped(bench, 20), 1, 10);
  assert_disabled_by_drive(bench, Status::kProgramStopped);
  assert_true(bench.says("another program may have taken its place"));
}

// Proves URH-13.
void the_trajectory_waits_for_the_slider(void**) {
  UrHalBench& bench = moving();
  bench.robot.change([](FakeImage& image) { image.speed_fraction = 0.0; });
  ASSERT_OK(bench.cycles(100));
  const double stood = bench.reference();
  assert_true(stood < 0.9);
  ASSERT_OK(bench.cycles(100));
  ASSERT_NEAR(bench.reference(), stood, 1e-9);
  bench.robot.change([](FakeImage& image) { image.speed_fraction = 1.0; });
  double last = stood, largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_OK(bench.cycles(1));
    largest = std::max(largest, bench.reference() - last);
    last = bench.reference();
  }
  ASSERT_NEAR(last, 1.0, 1e-9);
  assert_true(largest < 0.008 * 0.7);  // the trajectory's own speed, 0.625 rad/s: no catching up
}

// Proves URH-24.
void slider_and_limiter_slow_the_trajectory_down_together(void**) {
  struct Row {
    double limiter, slider, share;
  };
  for (const Row& row : {Row{1.0, 0.5, 0.5}, Row{0.5, 1.0, 0.5}, Row{0.5, 0.5, 0.25},
                         Row{0.0, 0.5, 0.0}, Row{1.5, 1.0, 1.0}, Row{-1.0, 1.0, 0.0}}) {
    UrHalBench& bench = moving();
    bench.robot.change([&](FakeImage& image) {
      image.speed_scaling = row.limiter;
      image.speed_fraction = row.slider;
    });
    ASSERT_OK(bench.cycles(1));
    const PortEntry* port = bench.pipeline.ports.find("robot.speed_scaling");
    ASSERT_NEAR(*static_cast<const double*>(port->value), row.share, 0.0);
  }
}

// Proves URH-10, URH-8.

/// Commands the arm to stay until the buffers between the two are full; from then on `max_missed`
/// set-points in a row may be lost.
void a_robot_that_stops_reading_is_a_wire_that_is_lost(void**) {
  struct Row {
    int max_missed;
    const char* reason;
  };
  for (const Row& row : {Row{5, "no set-point could be sent for 6 periods, limit 5"},
                         Row{0, "no set-point could be sent for 1 period, limit 0"}}) {
    UrHalBench& bench = g_bench.emplace();
    bench.settings.max_missed = row.max_missed;
    ASSERT_OK(bench.start());
    ASSERT_OK(bench.cycles(10));
    bench.robot.stop_reading();
    bench.robot.change(
        [](FakeImage& image) { image.speed_fraction = 0.0; });  // its program may stand
    assert_true(cycles_until_stopped(bench, 100000) > 100);
    assert_disabled_by_wire(bench, Status::kBusTimeout);
    assert_true(bench.says(row.reason));
    bench.robot.read_on();
    assert_reconnects_without_motion(bench);
  }
}

// Proves URH-12.

void a_connection_that_takes_no_set_points_any_more_ends_the_motion(void**) {
  UrHalBench& bench = moving();
  bench.robot.drop_rtde();
  const RobotCommand command = {CommandMode::kPosition, bench.hal.state().q, DriveRequest::kFollow};
  Status status = Status::kOk;  // the first may still find the way open
  for (int i = 0; i < 1000 && status == Status::kOk; ++i) {
    status = bench.hal.write(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_STATUS(status, Status::kConnectionLost);
  assert_true(bench.says("the connection no longer accepts set-points"));
  RobotState state;
  ASSERT_STATUS(bench.hal.read({}, state), Status::kConnectionLost);
  ASSERT_STATUS(bench.hal.write(command), Status::kConnectionLost);
}

/// Sends more at once than all buffers hold; a message sent in part cannot be taken back.
void what_is_taken_in_part_is_a_connection_that_is_lost(void**) {
  FakeController robot;
  robot.start();
  robot.stop_reading();
  Socket socket;
  Message why;
  ASSERT_OK(socket.connect("127.0.0.1", robot.rtde_port(), Deadline(1000), why));
  static const std::array<std::uint8_t, 1 << 26> kBytes{};
  assert_true(socket.send(kBytes.data(), 56) == Socket::Sent::kAll);
  assert_true(socket.send(kBytes.data(), kBytes.size()) == Socket::Sent::kLost);
  while (socket.send(kBytes.data(), 56) == Socket::Sent::kAll) {
  }
  assert_true(socket.send(kBytes.data(), 56) == Socket::Sent::kNothing);
  robot.stop();
}

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
      cmocka_unit_test(what_the_robot_says_ends_the_motion_in_its_cycle),
      cmocka_unit_test(the_robots_own_code_is_told),
      cmocka_unit_test(a_connection_that_is_closed_ends_the_motion_in_the_next_cycle),
      cmocka_unit_test(a_program_that_uses_no_set_points_ends_the_motion),
      cmocka_unit_test(the_trajectory_waits_for_the_slider),
      cmocka_unit_test(slider_and_limiter_slow_the_trajectory_down_together),
      cmocka_unit_test(a_robot_that_stops_reading_is_a_wire_that_is_lost),
      cmocka_unit_test(a_connection_that_takes_no_set_points_any_more_ends_the_motion),
      cmocka_unit_test(what_is_taken_in_part_is_a_connection_that_is_lost),
      cmocka_unit_test(calls_to_the_heap_are_counted),
      cmocka_unit_test(a_cycle_allocates_nothing),
      cmocka_unit_test(a_start_allocates_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, end_bench);
}
