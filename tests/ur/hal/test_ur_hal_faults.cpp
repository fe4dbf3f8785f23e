// Tests the reaction of a UR's HAL to every fault of a robot in motion: Status, rung, cycles until
// the reaction, and the recovery. The table is that of docs/ur10.md.
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
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
