// How the drives of a UR are armed, and when arming is refused.
#include "tests/ur/hal/ur_arming_bench.hpp"

namespace tactus::ur {
namespace {

// Proves URH-1, URH-2.
void arming_ends_with_the_program_holding_the_arm(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.connect());
  ASSERT_OK(bench.arm());
  assert_int_equal(bench.robot.uploads(), 1);
  assert_true(bench.drives_are(DriveState::kEnabled));
  ASSERT_OK(bench.cycles(3));
  const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
  for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
}

// Proves URH-5.
void a_program_that_is_refused_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.refuses_program = true;
  assert_refused(bench, Status::kRefusedByRobot,
                 "line 2, column 3: compile_error_name_not_found:foo:");
  assert_arms_now(bench, false);
}

void another_program_is_left_alone(void**) {
  UrHalBench& bench = fresh();
  bench.robot.image.runtime_state = 2;
  assert_refused(bench, Status::kRefusedByRobot,
                 "the program on the robot did not end within 300 ms; stop it");
  assert_int_equal(bench.robot.uploads(), 0);
  assert_int_equal(bench.robot.ends(), 0);
  assert_arms_now(bench, false);
}

// Proves URH-6.
void stops_that_people_release_are_refused(void**) {
  struct Row {
    std::int32_t safety, robot;
    Status status;
    const char* reason;
  };
  for (const Row& row :
       {Row{3, 7, Status::kProtectiveStop, "PROTECTIVE_STOP"},
        Row{5, 7, Status::kSafeguardStop, "SAFEGUARD_STOP"},
        Row{6, 3, Status::kEmergencyStop, "SYSTEM_EMERGENCY_STOP"},
        Row{7, 3, Status::kEmergencyStop, "ROBOT_EMERGENCY_STOP"},
        Row{8, 3, Status::kDriveFault, "VIOLATION"}, Row{9, 3, Status::kDriveFault, "FAULT"},
        Row{4, 7, Status::kRobotMode, "RECOVERY"}, Row{12, 7, Status::kSafeguardStop, "12"},
        Row{1, 3, Status::kRobotMode, "POWER_OFF (3)"},
        Row{1, 6, Status::kRobotMode, "BACKDRIVE"}}) {
    UrHalBench& bench = fresh();
    bench.robot.image.safety_mode = row.safety;
    bench.robot.image.robot_mode = row.robot;
    assert_refused(bench, row.status, row.reason);
    assert_int_equal(bench.robot.uploads(), 0);
    assert_arms_now(bench, false);
  }
}

UrHalBench& stopped_protectively(int refusals) {
  UrHalBench& bench = fresh();
  bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
  bench.settings.power_ms = 60000;
  bench.robot.image.safety_mode = 3;
  bench.robot.image.safety_bits = 4;
  bench.robot.faults.unlock_refusals = refusals;
  return bench;
}

void a_protective_stop_is_released_where_the_file_says_so(void**) {
  UrHalBench& bench = stopped_protectively(6);
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(3));
}

void a_release_is_asked_for_seven_times(void**) {
  UrHalBench& bench = stopped_protectively(7);
  assert_refused(bench, Status::kRefusedByRobot, "Cannot unlock protective stop until 5s");
}

void power_comes_where_the_file_says_so(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.robot.image.robot_mode = 3;
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(3));
}

void power_that_is_refused_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.robot.image.robot_mode = 3;
  bench.robot.faults.refuses_power = true;
  assert_refused(bench, Status::kRefusedByRobot,
                 "answered 'power on' with 'Failed to execute: power on'");
  assert_arms_now(bench, false);
}

void a_stop_that_comes_during_arming_ends_it(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.stops_on_program = true;
  assert_refused(bench, Status::kProtectiveStop, "PROTECTIVE_STOP");
  assert_arms_now(bench, false);
}

/// An emergency stop is pressed while the power is awaited.
void a_stop_that_comes_while_power_is_switched_ends_arming(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.robot.image.robot_mode = 3;
  bench.robot.faults.does_nothing = true;
  ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.executive.arm(), Status::kArming);
  for (int i = 0; i < 5; ++i) ASSERT_STATUS(bench.cycle(), Status::kArming);
  bench.robot.change([](FakeImage& image) { image.safety_mode = 7; });
  ASSERT_STATUS(bench.arm(), Status::kEmergencyStop);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(arming_ends_with_the_program_holding_the_arm),
      cmocka_unit_test(a_program_that_is_refused_is_named),
      cmocka_unit_test(another_program_is_left_alone),
      cmocka_unit_test(stops_that_people_release_are_refused),
      cmocka_unit_test(a_protective_stop_is_released_where_the_file_says_so),
      cmocka_unit_test(a_release_is_asked_for_seven_times),
      cmocka_unit_test(power_comes_where_the_file_says_so),
      cmocka_unit_test(power_that_is_refused_is_named),
      cmocka_unit_test(a_stop_that_comes_during_arming_ends_it),
      cmocka_unit_test(a_stop_that_comes_while_power_is_switched_ends_arming),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
