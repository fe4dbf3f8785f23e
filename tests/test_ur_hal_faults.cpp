// What a UR's HAL does about everything that can happen to a robot in motion: fault, reaction,
// cycles until it, and what a recovery finds. docs/ur10.md has the same table.
#include <limits>

#include "tests/ur_hal_bench.hpp"

namespace tactus::ur {
namespace {

std::optional<UrHalBench> g_bench;

/// A bench whose arm is on its way.
UrHalBench& moving() {
  UrHalBench& bench = g_bench.emplace();
  ASSERT_OK(bench.start());
  bench.send_line();
  ASSERT_OK(bench.cycles(60));
  assert_true(bench.reference() > 0.01);
  return bench;
}

/// Cycles until one is not kOk; 0: none was.
int cycles_until_stopped(UrHalBench& bench, int most) {
  for (int i = 1; i <= most; ++i)
    if (bench.cycle() != Status::kOk) return i;
  return 0;
}

/// The last event walked the ladder because of the wire.
void assert_disabled_by_wire(UrHalBench& bench, Status expected) {
  ASSERT_STATUS(bench.executive.latched(), expected);
  assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(Rung::kDisabled));
  Event event;
  const EventLog& events = bench.executive.events();
  assert_true(events.read(events.count() - 1, event));
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(Cause::kWire));
  ASSERT_STATUS(event.status, expected);
}

/// Nothing moves by itself; after a rearm the reference is where the arm is now, and stays.
void assert_recovers_without_motion(UrHalBench& bench) {
  const std::int32_t before = bench.hal.set_points();
  for (int i = 0; i < 5; ++i) assert_true(bench.run_cycle() != Status::kOk);
  assert_true(bench.robot.count() <= before);  // no set-point, an end at most
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    const double timestamp_s = bench.robot.image.timestamp_s;
    bench.robot.image = FakeImage();
    bench.robot.image.timestamp_s = timestamp_s > 0.0 ? timestamp_s : 0.0;
    bench.robot.image.q[0] = 0.7;
  }
  bench.robot.by_itself();
  ASSERT_OK(bench.executive.rearm());
  bench.robot.by_hand();
  ASSERT_OK(bench.drain());
  ASSERT_OK(bench.cycles(20));
  ASSERT_NEAR(bench.reference(), 0.7, 1e-12);
  ASSERT_NEAR(bench.robot.set_point(bench.hal.set_points())[0], 0.7, 1e-12);
}

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
    {
      const std::lock_guard<std::mutex> lock(bench.robot.mutex);
      bench.robot.image.robot_mode = row.robot;
      bench.robot.image.safety_mode = row.safety;
      bench.robot.image.safety_bits = row.bits;
      bench.robot.image.runtime_state = row.runtime;
    }
    assert_int_equal(cycles_until_stopped(bench, 5), 1);
    assert_disabled_by_wire(bench, row.expected);
    assert_true(bench.says(row.reason));
    assert_recovers_without_motion(bench);
  }
}

// Proves URH-9.
void the_robots_own_code_is_told(void**) {
  UrHalBench& bench = moving();
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.image.safety_mode = 3;
  }
  bench.robot.send_code(153, 2);
  assert_int_equal(cycles_until_stopped(bench, 5), 1);
  assert_true(bench.says("C153A2: position deviates from the path, joint 3 (elbow)"));
}

// Proves URH-10.
void up_to_five_packets_may_be_missing(void**) {
  UrHalBench& bench = moving();
  for (int missing = 1; missing <= 5; ++missing) {
    const std::int32_t before = bench.hal.set_points();
    for (int i = 0; i < missing; ++i) ASSERT_OK(bench.run_cycle());
    bench.robot.set_point(before + missing);  // the robot's set-points go on
    ASSERT_OK(bench.cycle(missing + 1));
    ASSERT_OK(bench.cycles(10));
  }
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

void late_packets_begin_no_cycles_of_their_own(void**) {
  UrHalBench& bench = moving();
  const std::int32_t before = bench.hal.set_points();
  for (int i = 0; i < 3; ++i) ASSERT_OK(bench.run_cycle());
  for (int i = 0; i < 3; ++i) bench.robot.send_package();  // those of the three cycles
  ASSERT_OK(bench.cycle());
  bench.robot.set_point(before + 4);
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

void from_the_sixth_on_the_wire_is_lost(void**) {
  for (const int missing : {6, 50}) {
    UrHalBench& bench = moving();
    int stopped_at = 0;
    for (int i = 1; i <= missing && stopped_at == 0; ++i)
      if (bench.run_cycle() != Status::kOk) stopped_at = i;
    assert_int_equal(stopped_at, 6);
    assert_disabled_by_wire(bench, Status::kBusTimeout);
    assert_true(bench.says("no new packet for 6 periods, limit 5"));
    bench.robot.set_point(kServoEnded);  // the program was told
    assert_recovers_without_motion(bench);
  }
}

/// The host was away: the packets are there, the cycles are not.
void packets_left_out_walk_the_ladder_as_slips(void**) {
  struct Row {
    int left_out;
    Status expected;
    Rung rung;
  };
  for (const Row& row : {Row{3, Status::kOk, Rung::kNominal}, Row{4, Status::kSlip, Rung::kHold},
                         Row{7, Status::kSlip, Rung::kStop}, Row{50, Status::kSlip, Rung::kStop}}) {
    UrHalBench& bench = moving();
    for (int i = 0; i < row.left_out; ++i) bench.robot.send_package();
    ASSERT_STATUS(bench.cycle(), row.expected);
    assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(row.rung));
  }
}

// Proves URH-11.
void a_timestamp_that_stands_is_no_news(void**) {
  UrHalBench& bench = moving();
  int stopped_at = 0;
  for (int i = 1; i <= 20 && stopped_at == 0; ++i)
    if (bench.cycle(0.0) != Status::kOk) stopped_at = i;
  assert_int_equal(stopped_at, 6);
  assert_disabled_by_wire(bench, Status::kBusTimeout);
  assert_recovers_without_motion(bench);
}

void a_repeated_packet_is_bridged(void**) {
  UrHalBench& bench = moving();
  ASSERT_OK(bench.cycle(0.0));
  ASSERT_OK(bench.cycle(2.0));
  ASSERT_OK(bench.cycles(10));
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

void a_timestamp_that_runs_back_ends_the_motion(void**) {
  for (const double periods : {-1.0, -12400.0}) {
    UrHalBench& bench = moving();
    ASSERT_STATUS(bench.cycle(periods), Status::kClock);
    assert_disabled_by_wire(bench, Status::kClock);
    assert_true(bench.says("the robot's clock was set back to"));
    assert_recovers_without_motion(bench);
  }
}

// Proves URH-12.
void a_connection_that_is_closed_ends_the_motion_in_the_next_cycle(void**) {
  UrHalBench& bench = moving();
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.drop_rtde();
  }
  ASSERT_STATUS(bench.run_cycle(), Status::kConnectionLost);
  assert_disabled_by_wire(bench, Status::kConnectionLost);
  assert_recovers_without_motion(bench);
}

void a_field_that_is_no_number_ends_the_motion_in_its_cycle(void**) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    const char* name;
    double FakeImage::*number;
    std::array<double, 6> FakeImage::*six;
  };
  for (const Row& row : {Row{"actual_qd", nullptr, &FakeImage::dq},
                         Row{"target_moment", nullptr, &FakeImage::moment},
                         Row{"actual_TCP_pose", nullptr, &FakeImage::tcp_pose},
                         Row{"actual_TCP_force", nullptr, &FakeImage::tcp_force},
                         Row{"speed_scaling", &FakeImage::speed_scaling, nullptr},
                         Row{"target_speed_fraction", &FakeImage::speed_fraction, nullptr}}) {
    UrHalBench& bench = moving();
    {
      const std::lock_guard<std::mutex> lock(bench.robot.mutex);
      if (row.number != nullptr) bench.robot.image.*row.number = nan;
      if (row.six != nullptr) (bench.robot.image.*row.six)[5] = nan;
    }
    ASSERT_STATUS(bench.cycle(), Status::kWireFormat);
    assert_disabled_by_wire(bench, Status::kWireFormat);
    assert_true(bench.says(row.name));
    assert_true(bench.says("is not finite"));
  }
}

// Proves URH-13.
void the_trajectory_waits_for_the_slider(void**) {
  UrHalBench& bench = moving();
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.image.speed_fraction = 0.0;
  }
  ASSERT_OK(bench.cycles(100));
  const double stood = bench.reference();
  assert_true(stood < 0.9);
  ASSERT_OK(bench.cycles(100));
  ASSERT_NEAR(bench.reference(), stood, 1e-9);
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.image.speed_fraction = 1.0;
  }
  double last = stood, largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_OK(bench.cycles(1));
    largest = std::max(largest, bench.reference() - last);
    last = bench.reference();
  }
  ASSERT_NEAR(last, 1.0, 1e-9);
  assert_true(largest <
              0.008 * 0.7);  // the trajectory's own speed, 0.625 rad/s: nothing is caught up
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_the_robot_says_ends_the_motion_in_its_cycle),
      cmocka_unit_test(the_robots_own_code_is_told),
      cmocka_unit_test(up_to_five_packets_may_be_missing),
      cmocka_unit_test(late_packets_begin_no_cycles_of_their_own),
      cmocka_unit_test(from_the_sixth_on_the_wire_is_lost),
      cmocka_unit_test(packets_left_out_walk_the_ladder_as_slips),
      cmocka_unit_test(a_timestamp_that_stands_is_no_news),
      cmocka_unit_test(a_repeated_packet_is_bridged),
      cmocka_unit_test(a_timestamp_that_runs_back_ends_the_motion),
      cmocka_unit_test(a_connection_that_is_closed_ends_the_motion_in_the_next_cycle),
      cmocka_unit_test(a_field_that_is_no_number_ends_the_motion_in_its_cycle),
      cmocka_unit_test(the_trajectory_waits_for_the_slider),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
