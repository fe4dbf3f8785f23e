// How the drives of a UR are armed, and when arming is refused; its phases: one that does not end,
// and a wire that is lost in one.
#include "tests/ur/hal/ur_exchange_bench.hpp"
#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {
namespace {

/// Arming against a controller made of bytes that fails, and arming again when it does not.

UrHalBench& fresh() {
  return g_bench.emplace();
}

/// The fault is over: the next arming ends with the arm where it is, and it stays there.
void assert_arms_now(UrHalBench& bench, bool reconnects) {
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    const double timestamp_s = bench.robot.image.timestamp_s;
    bench.robot.faults = {};
    bench.robot.image = FakeImage();
    bench.robot.image.timestamp_s = timestamp_s;
  }
  if (reconnects) ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.cycle(), bench.executive.latched());  // the cause has gone
  ASSERT_OK(bench.arm());
  ASSERT_OK(bench.cycles(5));
  const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
  for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
}

/// Arms against one fault of the robot; its Status and reason.
void assert_refused(UrHalBench& bench, Status expected, const char* reason) {
  bench.settings.connect_ms = 2000;  // however late on a host that is busy
  ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.arm(), expected);
  assert_true(bench.says(reason));
  assert_true(bench.drives_are(DriveState::kFault));
  bench.robot.settle();
  assert_true(bench.robot.count() <= 0);
}

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

// Proves URH-29.

struct LateRow {
  DrivePhase phase;
  const char* problem;
  void (*delay)(UrHalBench& bench);
};
constexpr std::array<LateRow, 7> kLate = {
    {{DrivePhase::kReleaseStop, "the protective stop was not released",
      [](UrHalBench& bench) {
        bench.robot.image.safety_mode = 3;
        bench.robot.faults.does_nothing = true;
      }},
     {DrivePhase::kPowerOn, "the robot was not powered on",
      [](UrHalBench& bench) {
        bench.robot.image.robot_mode = 3;
        bench.robot.faults.does_nothing = true;
      }},
     {DrivePhase::kReleaseBrakes, "the brakes were not released",
      [](UrHalBench& bench) {
        bench.robot.image.robot_mode = 5;
        bench.robot.faults.does_nothing = true;
      }},
     {DrivePhase::kOtherProgram, "the program on the robot did not end",
      [](UrHalBench& bench) { bench.robot.image.runtime_state = 4; }},
     {DrivePhase::kStandstill, "the arm did not come to rest",
      [](UrHalBench& bench) { bench.robot.image.dq[2] = -0.5; }},
     {DrivePhase::kProgram, "the program on the robot did not start",
      [](UrHalBench& bench) { bench.robot.faults.begins_late = 10000; }},
     {DrivePhase::kFirstSetPoint, "the program on the robot used no set-point",
      [](UrHalBench& bench) { bench.robot.faults.uses_no_set_points = true; }}}};

/// 300 ms are 38 cycles.
void a_phase_that_does_not_end_is_named(void**) {
  for (const LateRow& row : kLate) {
    UrHalBench& bench = fresh();
    bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
    bench.settings.on_power_off = OnPowerOff::kPowerOn;
    row.delay(bench);
    ASSERT_OK(bench.connect());
    ASSERT_STATUS(bench.executive.arm(), Status::kArming);
    int cycles = 0;
    Status status = Status::kArming;
    for (; status == Status::kArming; bench.robot.settle()) {
      status = bench.cycle();
      cycles += bench.hal.phase() == row.phase ? 1 : 0;
    }
    ASSERT_STATUS(status, Status::kRefusedByRobot);
    assert_in_range(cycles, 38, 39);
    Message expected(row.problem);
    expected << " within 300 ms";
    assert_true(bench.says(expected));
    bench.robot.settle();
    assert_true(bench.robot.count() <= 0 || row.phase == DrivePhase::kFirstSetPoint);
  }
}

// Proves URH-7.

/// It is shown one cycle after that of its packet.
void a_stop_in_any_phase_of_the_program_ends_arming(void**) {
  for (const DrivePhase phase :
       {DrivePhase::kOtherProgram, DrivePhase::kStandstill, DrivePhase::kRegister,
        DrivePhase::kUpload, DrivePhase::kProgram, DrivePhase::kFirstSetPoint, DrivePhase::kTip}) {
    UrExchange& bench = g_exchange.emplace();
    bench.robot.faults.begins_late = 3;
    bench.open();
    bench.exchange_until(DriveRequest::kArm, phase);
    bench.robot.change([](FakeImage& image) { image.safety_mode = 3; });
    bench.exchange(DriveRequest::kArm);
    bench.exchange(DriveRequest::kArm);
    for (const Drive& drive : bench.state.drives) {
      assert_true(drive.state == DriveState::kFault);
      ASSERT_STATUS(drive.reason, Status::kProtectiveStop);
    }
    for (int i = 0; i < 10; ++i) bench.exchange(DriveRequest::kArm);
    assert_int_equal(bench.robot.ends(), bench.robot.uploads());
    assert_true(bench.robot.count() <= 0);
  }
}

// Proves URH-34.

/// The robot runs its program, and then has its tip elsewhere, for some packets or for good.
UrExchange& with_another_tip() {
  UrExchange& bench = g_exchange.emplace();
  bench.open();
  bench.exchange_until(DriveRequest::kArm, DrivePhase::kFirstSetPoint);
  bench.robot.change([](FakeImage& image) { image.tip_error_m = 0.05; });
  bench.exchange_until(DriveRequest::kArm, DrivePhase::kTip);
  for (int i = 0; i < 3; ++i) bench.exchange(DriveRequest::kArm);
  assert_string_equal(name(bench.hal.phase()), name(DrivePhase::kTip));
  return bench;
}

void a_tip_that_shows_late_is_waited_for(void**) {
  UrExchange& bench = with_another_tip();
  bench.robot.change([](FakeImage& image) { image.tip_error_m = 0.0; });
  bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
}

void a_tip_that_stays_elsewhere_ends_arming_and_the_program(void**) {
  UrExchange& bench = with_another_tip();
  for (int i = 0; i < 4; ++i) bench.exchange(DriveRequest::kArm);
  for (const Drive& drive : bench.state.drives) ASSERT_STATUS(drive.reason, Status::kMismatch);
  assert_true(bench.says("0.05 m and 0 rad apart"));
  bench.exchange_until(DriveRequest::kArm, DrivePhase::kFault);
  assert_int_equal(bench.robot.ends(), 1);
}

// Proves URH-3.

/// Ports that only arming needs: their loss is a wire that must be opened anew.
void a_port_that_is_closed_is_named_when_it_is_needed(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  ASSERT_OK(bench.connect());
  bench.robot.drop_dashboard();
  ASSERT_OK(bench.arm());
  static_cast<void>(bench.executive.stop());
  bench.robot.change([](FakeImage& image) { image = FakeImage(); });
  ASSERT_OK(bench.connect());
  ASSERT_OK(bench.arm());
  bench.robot.drop_primary();
  ASSERT_OK(bench.cycles(5));  // motion does not need it
  static_cast<void>(bench.executive.stop());
  bench.robot.change([](FakeImage& image) {
    image.runtime_state = 1;
    image.robot_mode = 3;
  });
  ASSERT_OK(bench.connect());
  bench.robot.drop_primary();
  ASSERT_STATUS(bench.arm(), Status::kConnectionLost);
  assert_true(bench.says("primary port: the connection was closed"));
  bench.robot.change([](FakeImage& image) { assert_int_equal(image.robot_mode, 3); });
  assert_arms_now(bench, true);
  static_cast<void>(bench.executive.stop());
  bench.robot.change([](FakeImage& image) {
    image.runtime_state = 1;
    image.robot_mode = 3;
  });
  ASSERT_OK(bench.connect());
  bench.robot.close_dashboard();
  ASSERT_STATUS(bench.arm(), Status::kConnectionLost);
  assert_true(bench.says("dashboard: the connection was lost, and no other could be made"));
  ASSERT_STATUS(bench.executive.arm(), Status::kConnectionLost);
}

// Proves URH-35.

/// A connection that was made in local control stays refused, or is closed.
void a_pendant_that_is_switched_to_remote_control_lets_the_next_arming_through(void**) {
  for (const bool closes : {false, true}) {
    UrHalBench& bench = fresh();
    bench.settings.on_power_off = OnPowerOff::kPowerOn;
    bench.robot.faults.local = true;
    bench.robot.image.robot_mode = 3;
    ASSERT_OK(bench.connect());
    ASSERT_STATUS(bench.arm(), Status::kRefusedByRobot);
    assert_true(bench.says("'Command is not allowed due to safety reasons, please switch robot"));
    assert_int_equal(bench.robot.dashboard_connections(), 2);  // one more for each command
    bench.robot.change([&](FakeImage&) { bench.robot.faults.local = false; });
    if (closes) bench.robot.drop_dashboard();
    ASSERT_OK(bench.arm());
    assert_int_equal(bench.robot.dashboard_connections(), 3);
    bench.robot.change([](FakeImage& image) { assert_int_equal(image.robot_mode, 7); });
  }
}

/// Every attempt has one new connection; the time ends them.
void a_protective_stop_that_local_control_keeps_is_told_in_the_robots_words(void**) {
  UrHalBench& bench = fresh();
  bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
  bench.robot.faults.local = true;
  bench.robot.image.safety_mode = 3;
  ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.arm(), Status::kRefusedByRobot);
  assert_true(bench.says("the protective stop was not released within 300 ms"));
  assert_true(bench.says("; the robot answered 'Command is not allowed due to safety reasons, "));
  assert_int_equal(bench.robot.dashboard_connections(), 2);
}

// Proves URH-3.

void a_program_that_goes_nowhere_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.drops_program = true;
  assert_refused(bench, Status::kRefusedByRobot,
                 "the program on the robot did not start within 300 ms");
  assert_arms_now(bench, true);
}

void a_connection_that_is_closed_at_the_first_registers_is_named(void**) {
  UrHalBench& bench = fresh();
  bench.robot.faults.reset_at = 'U';
  ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.arm(), Status::kConnectionLost);
  assert_true(bench.says("the connection was closed"));
  assert_arms_now(bench, true);
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
      cmocka_unit_test(a_phase_that_does_not_end_is_named),
      cmocka_unit_test(a_stop_in_any_phase_of_the_program_ends_arming),
      cmocka_unit_test(a_tip_that_shows_late_is_waited_for),
      cmocka_unit_test(a_tip_that_stays_elsewhere_ends_arming_and_the_program),
      cmocka_unit_test(a_port_that_is_closed_is_named_when_it_is_needed),
      cmocka_unit_test(a_pendant_that_is_switched_to_remote_control_lets_the_next_arming_through),
      cmocka_unit_test(a_protective_stop_that_local_control_keeps_is_told_in_the_robots_words),
      cmocka_unit_test(a_program_that_goes_nowhere_is_named),
      cmocka_unit_test(a_connection_that_is_closed_at_the_first_registers_is_named),
  };
  return cmocka_run_group_tests(tests, nullptr, end_exchange);
}
