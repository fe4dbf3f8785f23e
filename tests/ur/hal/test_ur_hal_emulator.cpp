// Tests a UR's HAL against the emulated controller with its arm, over sockets: a user's actions at
// the pendant and faults of the robot during a trajectory, and the rates of an e-Series.
#include "tests/ur/hal/ur_emulated_bench.hpp"

namespace tactus::ur {
namespace {

/// Sends a command from another client of the dashboard.
void tell(const char* command, const char* reply) {
  using Answer = DashboardClient::Answer;
  DashboardClient dashboard;
  Message why;
  ASSERT_OK(dashboard.connect("127.0.0.1", kDashboardPort + kOffset, Deadline(2000), why));
  dashboard.ask(command, reply);
  for (int i = 0; i < 2000 && dashboard.poll(why) == Answer::kPending; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  assert_true(dashboard.poll(why) == Answer::kYes);
}
/// Runs until the executive stops, which must be in the cycle of the first packet that reports the
/// stop.
void assert_stops_in_the_cycle_of_its_packet(UrArmBench& bench, int most) {
  for (int i = 0; i < most; ++i) {
    const UrState& said = bench.hal.state();
    assert_true(said.robot_mode == 7 && said.safety_mode == 1 && said.runtime_state == 2);
    if (bench.run_cycle() != Status::kOk) return;
  }
  _fail(__FILE__, __LINE__);
}

/// It stays where it has come to rest.
void assert_stays(UrArmBench& bench) {
  const Vector6 stood = bench.hal.state().q;
  for (int i = 0; i < 100; ++i) {
    ASSERT_OK(bench.run_cycle());
    assert_true((bench.hal.state().q - stood).cwiseAbs().maxCoeff() < 1e-3);
  }
  ASSERT_NEAR(bench.reference(), stood[0], 1e-3);
}
void assert_ok(UrArmBench& bench, Status status) {
  if (status != Status::kOk) print_error("%s: %s\n", name(status), bench.hal.trouble().c_str());
  ASSERT_OK(status);
}
/// The arm comes to rest without us; it is armed on the same wire, or on a new one.
void assert_rearms_at_rest(UrArmBench& bench) {
  assert_ok(bench, arm(bench));
  assert_stays(bench);
}
void assert_starts_at_rest(UrArmBench& bench) {
  assert_ok(bench, start(bench));
  assert_stays(bench);
}

// Proves URH-18.
void a_trajectory_is_followed_to_its_goal(void**) {
  UrArmBench& bench = fresh_arm();
  ASSERT_OK(start(bench));
  const double begin = bench.hal.state().q[0];
  const std::uint32_t id = bench.send_line();
  Report report;
  Outcome outcome = Outcome::kStarted;
  double largest = 0.0;
  for (int i = 0; i < 500 && outcome != Outcome::kSucceeded; ++i) {
    ASSERT_OK(bench.run_cycle());
    largest = std::max(largest, std::abs(bench.reference() - bench.hal.state().q[0]));
    while (bench.client.poll(report))
      if (report.id == id) outcome = report.outcome;
  }
  assert_true(outcome == Outcome::kSucceeded);
  for (int i = 0; i < 100; ++i) ASSERT_OK(bench.run_cycle());
  ASSERT_NEAR(bench.hal.state().q[0], begin + 1.0, 1e-3);
  assert_true(largest < 0.625 * (0.1 + 5 * 0.008));  // top speed times lookahead and transport
}

void a_robot_without_power_is_switched_on(void**) {
  Settings settings;
  settings.switched_on = false;
  UrArmBench& bench = fresh_arm(settings);
  ASSERT_STATUS(start(bench), Status::kRobotMode);
  assert_true(bench.says("POWER_OFF"));
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  assert_starts_at_rest(bench);
}

// Proves URH-19.
void a_protective_stop_is_seen_told_and_never_resumed(void**) {
  UrArmBench& bench = moving_arm();
  upload("sec stop():\n  protective_stop()\nend\n");
  assert_stops_in_the_cycle_of_its_packet(bench, 20);
  ASSERT_STATUS(bench.executive.latched(), Status::kProtectiveStop);
  assert_true(bench.says("C209"));
  ASSERT_STATUS(arm(bench), Status::kProtectiveStop);  // people look first
  bench.settings.on_protective_stop = OnProtectiveStop::kRelease;
  assert_starts_at_rest(bench);
}

void a_protective_stop_is_released_on_the_same_wire(void**) {
  UrArmBench& bench = moving_arm(OnProtectiveStop::kRelease);
  upload("sec stop():\n  protective_stop()\nend\n");
  assert_stops_in_the_cycle_of_its_packet(bench, 20);
  ASSERT_STATUS(bench.executive.latched(), Status::kProtectiveStop);
  assert_rearms_at_rest(bench);
}

void a_program_stopped_at_the_pendant_is_not_started_by_itself(void**) {
  UrArmBench& bench = moving_arm();
  tell("stop", "Stopped");
  assert_stops_in_the_cycle_of_its_packet(bench, 20);
  ASSERT_STATUS(bench.executive.latched(), Status::kProgramStopped);
  assert_rearms_at_rest(bench);
}

void power_cut_at_the_pendant_ends_the_motion(void**) {
  UrArmBench& bench = moving_arm();
  tell("power off", "Powering off");
  assert_stops_in_the_cycle_of_its_packet(bench, 50);
  assert_true(bench.executive.latched() == Status::kRobotMode ||
              bench.executive.latched() == Status::kProgramStopped);
  g_robot->pass(100);  // until the power is off
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  assert_starts_at_rest(bench);
}

void a_second_client_cannot_have_the_registers(void**) {
  UrArmBench& bench = moving_arm();
  RtdeClient second;
  Message why;
  ASSERT_STATUS(second.start("127.0.0.1", kRtdePort + kOffset, 125.0, false, Deadline(2000), why),
                Status::kRegistersInUse);
  assert_non_null(std::strstr(why.c_str(), "input_int_register_24 is IN_USE"));
  for (int i = 0; i < 20; ++i) ASSERT_OK(bench.run_cycle());
}

void a_controller_that_goes_away_is_seen_at_once(void**) {
  UrArmBench& bench = moving_arm();
  g_robot.reset();
  assert_stops_in_the_cycle_of_its_packet(bench, 20);
  ASSERT_STATUS(bench.executive.latched(), Status::kConnectionLost);
  ASSERT_STATUS(arm(bench), Status::kConnectionLost);
  Settings settings;
  settings.start_time_s = 1.0;  // it was restarted
  g_robot.emplace(settings);
  assert_starts_at_rest(bench);
}

// Proves URH-20.
void a_cycle_loop_that_ends_leaves_an_arm_at_rest(void**) {
  UrArmBench& bench = moving_arm();
  static_cast<void>(bench.executive.stop());
  g_robot->pass(200);
  RobotState state;
  ASSERT_OK(bench.hal.connect(CommandMode::kPosition));
  ASSERT_OK(bench.hal.read({}, state));
  assert_true(std::abs(state.dq[0]) < 1e-3);
}

/// Moves the slider from another client.
void set_slider(double fraction) {
  RtdeStream stream;
  Message why;
  ASSERT_OK(stream.connect("127.0.0.1", kRtdePort + kOffset, Deadline(2000), why));
  std::array<std::uint8_t, 128> bytes;
  ByteWriter names(bytes.data(), bytes.size());
  RtdeStream::begin(names, RtdeType::kSetupInputs);
  names.text("speed_slider_mask,speed_slider_fraction");
  assert_true(stream.send(names) == Socket::Sent::kAll);
  ByteWriter data(bytes.data(), bytes.size());
  RtdeStream::begin(data, RtdeType::kDataPackage);
  data.u8(1);
  data.u32(1);
  data.f64(fraction);
  assert_true(stream.send(data) == Socket::Sent::kAll);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

void the_slider_to_zero_and_back_loses_nothing_of_the_path(void**) {
  UrArmBench& bench = fresh_arm();
  ASSERT_OK(start(bench));
  const double begin = bench.hal.state().q[0];
  bench.send_line();
  for (int i = 0; i < 150; ++i) ASSERT_OK(bench.run_cycle());
  set_slider(0.0);
  for (int i = 0; i < 200; ++i) ASSERT_OK(bench.run_cycle());
  const double stood = bench.reference();
  for (int i = 0; i < 100; ++i) ASSERT_OK(bench.run_cycle());
  ASSERT_NEAR(bench.reference(), stood, 1e-6);
  assert_true(stood < begin + 0.9);
  set_slider(1.0);
  for (int i = 0; i < 700; ++i) ASSERT_OK(bench.run_cycle());
  ASSERT_NEAR(bench.hal.state().q[0], begin + 1.0, 1e-3);
}

Settings e_series() {
  Settings settings;
  settings.version = {5, 11, 1, 108318};
  return settings;
}

struct Followed {
  double largest = 0.0;  ///< between reference and measured, rad
  double error = 0.0;    ///< at the end, rad
};

/// Follows a line of 3 s for 4 s: one cycle for every period, one set-point for every cycle.
Followed follow_line(UrArmBench& bench, double period_s) {
  ASSERT_OK(start(bench));
  const double begin = bench.hal.state().q[0];
  const std::int32_t held = bench.hal.set_points();
  bench.send_line();
  Followed followed;
  const int cycles = static_cast<int>(4.0 / period_s + 0.5);
  for (int i = 0; i < cycles; ++i) {
    const double before_s = bench.hal.state().timestamp_s;
    ASSERT_OK(bench.run_cycle());
    ASSERT_NEAR(bench.hal.state().timestamp_s - before_s, period_s, 1e-9);
    if (i > 1) assert_in_range(bench.hal.set_points() - bench.hal.state().echo, 1, 2);
    followed.largest =
        std::max(followed.largest, std::abs(bench.reference() - bench.hal.state().q[0]));
  }
  assert_int_equal(bench.executive.telemetry().slips, 0);
  assert_int_equal(bench.hal.set_points() - held, cycles);
  followed.error = std::abs(bench.hal.state().q[0] - begin - 1.0);
  return followed;
}

// Proves URH-25.

void five_hundred_cycles_in_a_second(void**) {
  const Followed followed = follow_line(fresh_arm(e_series(), 2000), 0.002);
  assert_true(followed.error < 1e-3);
  assert_true(followed.largest < 0.625 * (0.1 + 5 * 0.002));  // top speed: lookahead, transport
}

void an_e_series_at_125_hz_is_given_a_set_point_for_four_of_its_cycles(void**) {
  const Followed followed = follow_line(fresh_arm(e_series(), 8000), 0.008);
  assert_true(followed.error < 1e-3);
  assert_true(followed.largest < 0.625 * (0.1 + 5 * 0.008));
}

void a_cb3_is_not_asked_for_500_hz(void**) {
  UrArmBench& bench = fresh_arm({}, 2000);
  ASSERT_STATUS(bench.executive.start(), Status::kRefusedByRobot);
  assert_true(
      bench.says("software 3.15: at most 125 Hz, not 500 Hz; set [robot] period_us = 8000"));
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_is_followed_to_its_goal),
      cmocka_unit_test(a_robot_without_power_is_switched_on),
      cmocka_unit_test(a_protective_stop_is_seen_told_and_never_resumed),
      cmocka_unit_test(a_protective_stop_is_released_on_the_same_wire),
      cmocka_unit_test(a_program_stopped_at_the_pendant_is_not_started_by_itself),
      cmocka_unit_test(power_cut_at_the_pendant_ends_the_motion),
      cmocka_unit_test(a_second_client_cannot_have_the_registers),
      cmocka_unit_test(a_controller_that_goes_away_is_seen_at_once),
      cmocka_unit_test(a_cycle_loop_that_ends_leaves_an_arm_at_rest),
      cmocka_unit_test(the_slider_to_zero_and_back_loses_nothing_of_the_path),
      cmocka_unit_test(five_hundred_cycles_in_a_second),
      cmocka_unit_test(an_e_series_at_125_hz_is_given_a_set_point_for_four_of_its_cycles),
      cmocka_unit_test(a_cb3_is_not_asked_for_500_hz),
  };
  return cmocka_run_group_tests(tests, nullptr, end_arm);
}
