// The start of a UR's HAL against a controller that fails in every phase of it.
#include "tests/ur_hal_bench.hpp"

namespace tactus::ur {
namespace {

std::optional<UrHalBench> g_bench;

UrHalBench& fresh() {
  return g_bench.emplace();
}

// Proves URH-1.
void a_start_ends_with_the_program_waiting(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.start());
  assert_int_equal(bench.robot.uploads(), 1);
  assert_int_equal(bench.hal.session().protocol(), 2);
  ASSERT_OK(bench.cycles(3));
}

void a_controller_without_protocol_2_is_spoken_to_in_1(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.only_protocol_1 = true;
  ASSERT_OK(bench.start());
  assert_int_equal(bench.hal.session().protocol(), 1);
  ASSERT_OK(bench.cycles(3));
}

// Proves URH-2.
void the_first_set_point_is_where_the_arm_is(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycle());
  const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
  for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
}

/// The fault is over: the next start ends with the arm where it is, and it stays there.
void assert_starts_now(UrHalBench& bench) {
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.faults = {};
    const double timestamp_s = bench.robot.image.timestamp_s;
    bench.robot.image = FakeImage();
    bench.robot.image.timestamp_s = timestamp_s;
  }
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(5));
  const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
  for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
}

/// Starts against one fault; its Status and reason. No set-point, and nothing is left of it.
void refuses(const FakeFaults& faults, Status expected, const char* reason) {
  UrHalBench& bench = fresh();
  bench.robot.faults = faults;
  ASSERT_STATUS(bench.start(), expected);
  assert_true(bench.says(reason));
  ASSERT_STATUS(bench.run_cycle(), expected);
  assert_true(bench.robot.count() <= 0);
  assert_starts_now(bench);
}

// Proves URH-3.
void a_reset_in_any_phase_is_named(void**) {
  struct Row {
    int type;
    const char* reason;
  };
  for (const Row& row : {Row{'V', "phase protocol: the connection was closed"},
                         Row{'v', "phase version: the connection was closed"},
                         Row{'O', "phase outputs: the connection was closed"},
                         Row{'I', "phase inputs: the connection was closed"},
                         Row{'S', "phase start: the connection was closed"},
                         Row{'U', "the connection was closed"}}) {
    FakeFaults faults;
    faults.reset_at = row.type;
    refuses(faults, Status::kConnectionLost, row.reason);
  }
}

void silence_in_any_phase_is_named(void**) {
  struct Row {
    int type;
    const char* reason;
  };
  for (const Row& row : {Row{'V', "phase protocol: no reply within 300 ms"},
                         Row{'v', "phase version: no reply within 300 ms"},
                         Row{'O', "phase outputs: no reply within 300 ms"},
                         Row{'I', "phase inputs: no reply within 300 ms"},
                         Row{'S', "phase start: no reply within 300 ms"}}) {
    FakeFaults faults;
    faults.silent_at = row.type;
    refuses(faults, Status::kBusTimeout, row.reason);
  }
}

void nobody_there_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.robot.start();
  bench.settings.rtde_port = bench.robot.rtde_port();
  bench.robot.stop();
  bench.hal.configure(bench.settings, Tool{}, 8000);
  ASSERT_STATUS(bench.executive.start(), Status::kConnectionLost);
  assert_true(bench.says("127.0.0.1 port "));
  assert_true(bench.says("refused"));
}

// Proves URH-4.
void fields_that_are_not_ours_are_named(void**) {
  FakeFaults faults;
  faults.inputs = "INT32,IN_USE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE";
  refuses(faults, Status::kRegistersInUse, "input_double_register_24 is IN_USE, not DOUBLE");
  faults = {};
  faults.outputs = "DOUBLE,VECTOR6D,NOT_FOUND";
  refuses(faults, Status::kWireFormat, "actual_q is NOT_FOUND, not VECTOR6D");
  faults.outputs = "DOUBLE,VECTOR6D";
  refuses(faults, Status::kWireFormat, "actual_q is missing, not VECTOR6D");
  faults.outputs = "DOUBLE,VECTOR6D,VECTOR6INT32";
  refuses(faults, Status::kWireFormat, "actual_q is VECTOR6INT32, not VECTOR6D");
}

void an_old_controller_is_named(void**) {
  FakeFaults faults;
  faults.minor = 8;
  refuses(faults, Status::kRefusedByRobot, "software 3.8, at least 3.9");
}

void a_start_that_is_not_accepted_is_named(void**) {
  FakeFaults faults;
  faults.refuses_start = true;
  refuses(faults, Status::kRefusedByRobot, "phase start: not accepted");
}

// Proves URH-5.
void a_program_that_is_refused_is_named(void**) {
  FakeFaults faults;
  faults.refuses_program = true;
  refuses(faults, Status::kRefusedByRobot, "line 2, column 3: compile_error_name_not_found:foo:");
}

void a_program_that_never_runs_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.refuses_program = true;
  bench.robot.faults.drops_program = true;
  ASSERT_STATUS(bench.start(), Status::kRefusedByRobot);
  assert_true(bench.says("start of the program on the robot: not within 300 ms"));
  assert_starts_now(bench);
}

void another_program_is_left_alone(void**) {
  UrHalBench& bench = fresh();
  bench.robot.image.runtime_state = 2;
  ASSERT_STATUS(bench.start(), Status::kRefusedByRobot);
  assert_true(bench.says("end of the program on the robot: not within 300 ms"));
  assert_int_equal(bench.robot.uploads(), 0);
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
        Row{1, 3, Status::kRobotMode, "POWER_OFF"}, Row{1, 6, Status::kRobotMode, "BACKDRIVE"}}) {
    UrHalBench& bench = fresh();
    bench.robot.image.safety_mode = row.safety;
    bench.robot.image.robot_mode = row.robot;
    ASSERT_STATUS(bench.start(), row.status);
    assert_true(bench.says(row.reason));
    assert_int_equal(bench.robot.uploads(), 0);
  }
}

void a_protective_stop_is_released_where_the_file_says_so(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
  bench.robot.image.safety_mode = 3;
  bench.robot.image.safety_bits = 4;
  bench.robot.faults.unlock_refusals = 1;
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(3));
}

/// A program that begins while the arm slows down would stop it suddenly.
void an_arm_that_moves_is_waited_for(void**) {
  UrHalBench& bench = fresh();
  bench.robot.image.dq[2] = -0.5;
  ASSERT_STATUS(bench.start(), Status::kRefusedByRobot);
  assert_true(bench.says("standstill of the arm: not within 300 ms"));
  assert_int_equal(bench.robot.uploads(), 0);
}

void power_comes_where_the_file_says_so(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.robot.image.robot_mode = 3;
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(3));
}

void a_protective_stop_during_the_start_ends_it(void**) {
  FakeFaults faults;
  faults.stops_on_program = true;
  refuses(faults, Status::kProtectiveStop, "PROTECTIVE_STOP");
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_start_ends_with_the_program_waiting),
      cmocka_unit_test(a_controller_without_protocol_2_is_spoken_to_in_1),
      cmocka_unit_test(the_first_set_point_is_where_the_arm_is),
      cmocka_unit_test(a_reset_in_any_phase_is_named),
      cmocka_unit_test(silence_in_any_phase_is_named),
      cmocka_unit_test(nobody_there_is_named),
      cmocka_unit_test(fields_that_are_not_ours_are_named),
      cmocka_unit_test(an_old_controller_is_named),
      cmocka_unit_test(a_start_that_is_not_accepted_is_named),
      cmocka_unit_test(a_program_that_is_refused_is_named),
      cmocka_unit_test(a_program_that_never_runs_is_named),
      cmocka_unit_test(another_program_is_left_alone),
      cmocka_unit_test(stops_that_people_release_are_refused),
      cmocka_unit_test(a_protective_stop_is_released_where_the_file_says_so),
      cmocka_unit_test(an_arm_that_moves_is_waited_for),
      cmocka_unit_test(power_comes_where_the_file_says_so),
      cmocka_unit_test(a_protective_stop_during_the_start_ends_it),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
