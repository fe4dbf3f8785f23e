// How a UR's HAL opens its wire, against a controller that fails in every phase of it.
#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {
namespace {

UrHalBench& fresh() {
  return g_bench.emplace();
}

// Proves URH-1, URH-28.
void a_connection_leaves_the_drives_alone(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.connect());
  assert_int_equal(bench.hal.session().protocol(), 2);
  for (int i = 0; i < 20; ++i) {
    ASSERT_STATUS(bench.cycle(), Status::kNotStarted);
    assert_true(bench.drives_are(DriveState::kDisabled));
    bench.robot.settle();
  }
  RobotState state;
  ASSERT_OK(bench.hal.read({}, state));
  for (const Drive& drive : state.drives) assert_true(drive.valid);
  assert_int_equal(bench.robot.uploads(), 0);
  assert_int_equal(bench.robot.count(), 0);
}

void a_controller_without_protocol_2_is_spoken_to_in_1(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.only_protocol_1 = true;
  ASSERT_OK(bench.start());
  assert_int_equal(bench.hal.session().protocol(), 1);
  ASSERT_OK(bench.cycles(3));
}

/// Connects against one fault; its Status and reason. Nothing is left of it.
void refuses(const FakeFaults& faults, Status expected, const char* reason) {
  UrHalBench& bench = fresh();
  bench.robot.faults = faults;
  ASSERT_STATUS(bench.connect(), expected);
  assert_true(bench.says(reason));
  ASSERT_STATUS(bench.run_cycle(), expected);
  assert_true(bench.robot.count() <= 0);
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    bench.robot.faults = {};
  }
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(5));
}

// Proves URH-3.
void a_reset_and_silence_in_any_phase_are_named(void**) {
  struct Row {
    int type;
    const char* phase;
  };
  for (const Row& row : {Row{'V', "protocol"}, Row{'v', "version"}, Row{'O', "outputs"},
                         Row{'I', "inputs"}, Row{'S', "start"}})
    for (const bool silent : {false, true}) {
      FakeFaults faults;
      (silent ? faults.silent_at : faults.reset_at) = row.type;
      Message reason("phase ");
      reason << row.phase << (silent ? ": no reply within 1000 ms" : ": the connection was closed");
      refuses(faults, silent ? Status::kBusTimeout : Status::kConnectionLost, reason.c_str());
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

/// The remedy of a port is not that of the address at which the robot has just answered.
void a_port_that_is_closed_beside_rtde_is_the_one_to_look_at(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.connect());
  const auto again = [&bench] {
    bench.robot.by_itself();
    bench.hal.configure(bench.settings, Tool{}, 8000);
    ASSERT_STATUS(bench.executive.start(), Status::kConnectionLost);
    assert_true(bench.says("127.0.0.1 port 1: Connection refused; the robot answers at "));
    assert_false(bench.says("is it on?"));
  };
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.settings.dashboard_port = 1;
  again();
  assert_true(bench.says("takes on_power_off and on_protective_stop = refuse only"));
  bench.settings.primary_port = 1;
  again();
  assert_true(bench.says("so check primary_port"));
}

// Proves URH-27.

/// One byte in 2 ms: the longest reply, of 135 bytes, comes in time; all of them, of 213, do not.
void a_controller_that_dribbles_is_given_one_time_for_the_whole(void**) {
  UrHalBench& bench = fresh();
  bench.settings.connect_ms = 350;
  bench.robot.faults.dribbling_port = 0;
  ASSERT_STATUS(bench.connect(), Status::kBusTimeout);
  assert_true(bench.says("no reply within 350 ms"));
}

void a_dashboard_that_dribbles_is_given_what_is_left_of_it(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.settings.connect_ms = 80;
  bench.robot.faults.dribbling_port = 2;
  ASSERT_STATUS(bench.connect(), Status::kBusTimeout);
  assert_true(bench.says("within 80 ms"));
}

void a_dashboard_that_cannot_be_needed_is_not_asked(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.silent_dashboard = true;
  ASSERT_OK(bench.connect());
  bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
  ASSERT_STATUS(bench.connect(), Status::kBusTimeout);
}

// Proves URH-4.
void fields_that_are_not_ours_are_named(void**) {
  FakeFaults faults;
  faults.inputs = "INT32,IN_USE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE";
  refuses(faults, Status::kRegistersInUse, "input_double_register_24 is IN_USE, not DOUBLE; end");
  faults = {};
  faults.outputs = "DOUBLE,VECTOR6D,NOT_FOUND";
  refuses(faults, Status::kWireFormat, "actual_q is NOT_FOUND, not VECTOR6D");
  faults.outputs = "DOUBLE,VECTOR6D";
  refuses(faults, Status::kWireFormat, "actual_q is missing, not VECTOR6D");
  faults.outputs = "DOUBLE,VECTOR6D,VECTOR6INT32";
  refuses(faults, Status::kWireFormat, "actual_q is VECTOR6INT32, not VECTOR6D");
}

// Proves URH-33.

/// A recipe with an unknown field is void, so that the conversation begins anew.
void software_that_tells_no_tool_is_asked_for_the_rest(void**) {
  for (const bool only_protocol_1 : {false, true}) {
    UrHalBench& bench = fresh();
    bench.robot.faults.old_software = true;
    bench.robot.faults.only_protocol_1 = only_protocol_1;
    ASSERT_OK(bench.start());
    assert_int_equal(bench.robot.connections(), 2);
    assert_true(std::isnan(bench.hal.state().payload_kg));
    assert_true(bench.hal.state().tcp_offset.hasNaN());
    ASSERT_OK(bench.cycles(5));
  }
}

void a_payload_that_is_no_number_is_refused(void**) {
  UrHalBench& bench = fresh();
  bench.robot.image.payload_kg = kRequired;
  ASSERT_STATUS(bench.connect(), Status::kWireFormat);
  assert_true(bench.says("payload is not finite"));
}

// Proves URH-4.
void an_old_controller_is_named(void**) {
  FakeFaults faults;
  faults.minor = 8;
  refuses(faults, Status::kRefusedByRobot,
          "software 3.8 has no registers from 24 up; update to 3.9");
}

void a_start_that_is_not_accepted_is_named(void**) {
  FakeFaults faults;
  faults.refuses_start = true;
  refuses(faults, Status::kRefusedByRobot, "phase start: the controller refused to start sending");
}

void what_the_robot_does_not_offer_is_named(void**) {
  UrHalBench& bench = fresh();
  ASSERT_OK(bench.connect());
  for (const CommandMode mode : {CommandMode::kVelocity, CommandMode::kEffort}) {
    ASSERT_STATUS(bench.hal.connect(mode), Status::kNotOffered);
    assert_true(bench.says("positions only"));
  }
  bench.hal.configure(bench.settings, Tool{}, 4000);
  ASSERT_STATUS(bench.hal.connect(CommandMode::kPosition), Status::kNotOffered);
  assert_true(bench.says("period_us = 4000: a UR takes 8000, or 2000"));
  bench.settings.zero_force = ZeroForce::kOn;
  ASSERT_STATUS(bench.connect(), Status::kNotOffered);
  assert_true(bench.says("a CB3 has no force sensor"));
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_connection_leaves_the_drives_alone),
      cmocka_unit_test(a_controller_without_protocol_2_is_spoken_to_in_1),
      cmocka_unit_test(a_reset_and_silence_in_any_phase_are_named),
      cmocka_unit_test(nobody_there_is_named),
      cmocka_unit_test(a_port_that_is_closed_beside_rtde_is_the_one_to_look_at),
      cmocka_unit_test(a_controller_that_dribbles_is_given_one_time_for_the_whole),
      cmocka_unit_test(a_dashboard_that_dribbles_is_given_what_is_left_of_it),
      cmocka_unit_test(a_dashboard_that_cannot_be_needed_is_not_asked),
      cmocka_unit_test(fields_that_are_not_ours_are_named),
      cmocka_unit_test(software_that_tells_no_tool_is_asked_for_the_rest),
      cmocka_unit_test(a_payload_that_is_no_number_is_refused),
      cmocka_unit_test(an_old_controller_is_named),
      cmocka_unit_test(a_start_that_is_not_accepted_is_named),
      cmocka_unit_test(what_the_robot_does_not_offer_is_named),
  };
  return cmocka_run_group_tests(tests, nullptr, end_bench);
}
