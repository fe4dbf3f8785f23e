// Tests the emulated controller as its clients see it: modes and their durations, the dashboard,
// stops, their triggers, the messages about them, and the recovery.
#include "tests/ur/controller/ur_state_client.hpp"

namespace tactus::ur {
namespace {

// Proves URE-5.

void the_first_packets_have_the_lengths_of_the_version(void**) {
  connect_clients();
  const std::string_view first = g_bench.take(g_primary);
  ByteReader head(reinterpret_cast<const std::uint8_t*>(first.data()), first.size());
  assert_int_equal(head.u32(), first.size());  // for clients that take each read for a packet
  assert_int_equal(head.i8(), 20);
  head.u64();
  assert_int_equal(head.i8(), -2);
  assert_int_equal(head.u8(), 3);
  g_bench.ticks(1);
  const std::string_view got = g_bench.take(g_primary);
  ByteReader reader(reinterpret_cast<const std::uint8_t*>(got.data()), got.size());
  const std::size_t end = reader.left() - reader.u32();
  assert_int_equal(reader.i8(), 16);
  std::array<std::uint32_t, 16> sizes{};
  while (reader.left() > end) {
    const std::uint32_t size = reader.u32();
    const std::uint8_t type = reader.u8();
    assert_true(type < sizes.size());
    sizes[type] = size;
    reader.text(size - 5);
  }
  assert_true(reader.done());
  constexpr std::array<std::uint32_t, 9> kSizes = {47, 251, 37, 75, 101, 225, 445, 61, 9};
  for (std::size_t i = 0; i < kSizes.size(); ++i) assert_int_equal(sizes[i], kSizes[i]);
  g_bench.ticks(125);
  std::size_t packets = 0;
  const std::string_view second = g_bench.take(g_primary);
  for (std::size_t at = 0; at < second.size(); ++packets) {
    ByteReader length(reinterpret_cast<const std::uint8_t*>(second.data()) + at, 4);
    at += length.u32();
  }
  assert_int_equal(packets, 10);
}

void the_real_time_port_sends_a_packet_every_cycle(void**) {
  connect_clients();
  const int client = g_bench->open(Service::kRealtime);
  g_bench.ticks(3);
  const std::string_view got = g_bench.take(client);
  assert_int_equal(got.size(), 3 * 1116);
  const auto* data = reinterpret_cast<const std::uint8_t*>(got.data()) + 2 * 1116;
  const auto number = [&](std::size_t offset) { return ByteReader(data + offset, 8).f64(); };
  assert_true(number(kTimeOffset) == 100.0 + 3 * 0.008);
  for (int i = 0; i < 6; ++i)
    ASSERT_NEAR(number(kQActualOffset + 8 * static_cast<std::size_t>(i)), Settings().initial_q[i],
                kEncoder_rad);
  assert_true(number(kRobotModeOffset) == 7.0);
  assert_true(number(kJointModesOffset) == 253.0);
  assert_true(number(kSafetyModeOffset) == 1.0);
  assert_true(number(kProgramStateOffset) == 1.0);
  assert_true(number(kSafetyStatusOffset) == 1.0);
  struct Row {
    Version version;
    std::size_t size;
  };
  for (const Row& row : {Row{{3, 2, 0, 1}, 1060}, Row{{5, 4, 0, 1}, 1116}, Row{{5, 9, 0, 1}, 1140},
                         Row{{5, 11, 1, 108318}, 1220}}) {
    Settings other;
    other.version = row.version;
    connect_clients(other);
    const int second = g_bench->open(Service::kRealtime);
    g_bench.ticks(1);
    assert_int_equal(g_bench.take(second).size(), row.size);
  }
}

// Proves URE-6.

void power_comes_and_goes_in_its_own_time(void**) {
  Settings settings;
  settings.switched_on = false;
  connect_clients(settings);
  expect_reply("robotmode", "Robotmode: POWER_OFF");
  expect_reply("brake release", "Brake releasing");
  g_bench.ticks(1);
  expect_reply("robotmode", "Robotmode: POWER_ON");
  assert_true(g_bench.until([] { return in_mode(RobotMode::kIdle); }, 260));
  assert_false(in_mode(RobotMode::kRunning));
  assert_true(g_bench.until([] { return in_mode(RobotMode::kRunning); }, 130));
  expect_reply("power on", "Powering on");  // changes nothing
  g_bench.ticks(500);
  expect_reply("robotmode", "Robotmode: RUNNING");
  g_bench.send(g_primary, "power off\n");
  g_bench.ticks(1);
  assert_true(in_mode(RobotMode::kRunning));
  assert_true(g_bench.until([] { return in_mode(RobotMode::kPowerOff); }, 60));
  g_bench.send(g_primary, "set robotmode run\n");
  assert_true(g_bench.until([] { return in_mode(RobotMode::kRunning); }, 500));
}

void the_dashboard_answers_line_by_line(void**) {
  connect_clients();
  expect_reply("PolyscopeVersion", "URSoftware 3.15.8.106339 (Jan 01 2022)");
  expect_reply("play", "Failed to execute: play");
  expect_reply("load nothing.urp", "File not found: nothing.urp");
  expect_reply("load /ursim/programs/wait_program.urp",
               "Loading program: /ursim/programs/wait_program.urp");
  expect_reply("programState", "STOPPED wait_program.urp");
  expect_reply("play", "Starting program");
  expect_reply("running", "Program running: true");
  expect_reply("pause", "Pausing program");
  expect_reply("programState", "PAUSED wait_program.urp");
  expect_reply("play", "Starting program");
  expect_reply("stop", "Stopped");
  expect_reply("running", "Program running: false");
  expect_reply("setUserRole OPERATOR", "Setting user role: OPERATOR");
  expect_reply("getUserRole", "OPERATOR");
  expect_reply("is in remote control", "could not understand: 'is in remote control'");
  g_bench.send(g_dashboard, "quit\n");
  assert_true(g_bench.take(g_dashboard) == "Disconnected\n");
  assert_true(g_bench->ended(g_dashboard));
}

void an_e_series_has_an_operational_mode(void**) {
  Settings settings;
  settings.version = {5, 11, 1, 108318};
  connect_clients(settings);
  expect_reply("get operational mode", "NONE");
  expect_reply("is in remote control", "true");
  expect_reply("set operational mode manual", "Operational mode MANUAL is set");
  expect_reply("set operational mode automatic", "Operational mode AUTOMATIC is set");
  expect_reply("set operational mode fast", "Failed setting operational mode: fast");
  expect_reply("get operational mode", "AUTOMATIC");
  expect_reply("clear operational mode",
               "No longer controlling the operational mode. Current operational mode: "
               "'AUTOMATIC'.");
  connect_clients();
  for (const char* line :
       {"set operational mode manual", "clear operational mode", "get operational mode"}) {
    std::array<char, 96> reply{};
    std::snprintf(reply.data(), reply.size(), "could not understand: '%s'", line);
    expect_reply(line, reply.data());
  }
}

// Proves URE-20.

void a_push_is_a_collision_and_a_wrong_encoder_a_deviation(void**) {
  connect_clients();
  g_bench.ticks(10);
  g_bench.controller().faults().push[2] = -100.0;
  assert_true(g_bench.until(protective_stopped, 50));
  assert_true(heard(MessageType::kErrorCode, stop_bytes(Code::kCollision, 2)));
  connect_clients();
  g_bench.ticks(10);
  g_bench.controller().faults().encoder_offset[4] = 0.2;
  assert_true(g_bench.until(protective_stopped, 2));
  assert_true(heard(MessageType::kErrorCode, stop_bytes(Code::kPathDeviation, 4)));
}

void a_script_that_goes_silent_at_speed_is_a_sudden_stop(void**) {
  connect_clients();
  std::array<char, 1024> script;
  std::size_t size = 0;
  size += static_cast<std::size_t>(std::snprintf(script.data(), script.size(), "def late():\n"));
  for (int k = 1; k <= 6; ++k)
    size += static_cast<std::size_t>(std::snprintf(
        script.data() + size, script.size() - size,
        "  servoj([0,-1.5708,1.5708,-1.5708,-1.5708,%.3f],t=0.008,lookahead_time=0.03,gain=2000)\n",
        0.01 * k));
  std::snprintf(script.data() + size, script.size() - size, "  sleep(1.0)\nend\n");
  g_bench.send(g_primary, script.data());
  assert_true(g_bench.until(protective_stopped, 12));
  assert_true(heard(MessageType::kErrorCode, stop_bytes(Code::kPathSanity, kSuddenStop)));
  assert_int_equal(g_bench.image().runtime_state, 1);
  g_bench.ticks(100);
  assert_true(g_bench.image().target_qd.isZero(0.0));
  assert_true(in_mode(RobotMode::kRunning));
}

// Proves URE-21.

void a_protective_stop_is_told_and_unlocked_when_it_may_be(void**) {
  connect_clients();
  g_bench.take(g_primary);
  g_bench.send(g_primary, "protective_stop()\n");
  g_bench.ticks(1);
  assert_true(protective_stopped());
  expect_reply("safetymode", "Safetymode: PROTECTIVE_STOP");
  assert_int_equal(g_bench.image().safety_status_bits & kProtectiveStopBit, kProtectiveStopBit);
  assert_true(heard(MessageType::kSafetyMode, stop_bytes(Code::kFromScript, 0)));
  expect_reply("unlock protective stop",
               "Cannot unlock protective stop until 5s after occurrence. Always inspect cause of "
               "protective stop before unlocking");
  g_bench.ticks(624);
  assert_true(protective_stopped());
  g_bench.ticks(2);
  expect_reply("unlock protective stop", "Protective stop releasing");
  g_bench.ticks(15);
  assert_false(protective_stopped());
  g_bench.send(g_primary, "protective_stop()\nset unlock protective stop\n");
  g_bench.ticks(1);
  assert_true(protective_stopped());  // not at once
  assert_true(g_bench.until([] { return !protective_stopped(); }, 625));
}

/// The sum of 2500 cycles of 2 ms is a little less than 5 s.
void a_stop_is_unlocked_exactly_five_seconds_after_it(void**) {
  const Settings settings;
  for (const double cycle_s : {0.008, 0.002}) {
    Safety safety(settings);
    assert_true(safety.protective_stop());
    const int cycles = static_cast<int>(5.0 / cycle_s + 0.5);
    for (int k = 1; k < cycles; ++k) safety.tick(cycle_s);
    assert_false(safety.unlock());
    safety.tick(cycle_s);
    assert_true(safety.unlock());
  }
}

void the_safety_system_steps_in_at_its_limits(void**) {
  connect_clients();
  g_bench.controller().faults().encoder_offset[0] = 7.0;  // rad: beyond 363 degrees
  g_bench.ticks(14);
  assert_int_equal(g_bench.image().safety_mode, static_cast<int>(SafetyMode::kViolation));
  assert_true(
      heard(MessageType::kErrorCode, stop_bytes(Code::kSafetyViolation, kViolatedJointPosition)));
  g_bench.ticks(60);
  assert_true(in_mode(RobotMode::kPowerOff));
  g_bench.controller().faults() = {};
  expect_reply("restart safety", "Restarting safety");
  g_bench.ticks(1);
  expect_reply("safetymode", "Safetymode: NORMAL");
}

void the_tool_stays_below_its_speed_limit(void**) {
  Settings settings;
  settings.initial_q << 0.0, -0.3, 0.0, 0.0, 0.0, 0.0;  // stretched out, at a singularity
  connect_clients(settings);
  g_bench.send(g_primary, "movej([2.5,-0.3,0,0,0,0],a=3.0,v=2.0)\n");
  double fastest = 0.0, scaling = 1.0;
  for (int i = 0; i < 500; ++i) {
    g_bench.ticks(1);
    fastest = std::max(fastest, g_bench.image().actual_tcp_speed.head<3>().norm());
    if (g_bench.image().program_running) scaling = std::min(scaling, g_bench.image().speed_scaling);
  }
  assert_true(fastest > 1.3 && fastest < 1.5);
  assert_true(scaling > 0.3 && scaling < 0.9);  // 2 rad/s at 1.2 m would be 2.4 m/s
  ASSERT_NEAR(g_bench.image().target_speed_fraction, 1.0, 0.0);
  ASSERT_NEAR(g_bench.image().actual_q[0], 2.5, kEncoder_rad);
  assert_int_equal(g_bench.image().safety_mode, 1);
}

void what_a_test_breaks_is_broken(void**) {
  connect_clients();
  g_bench.controller().faults().frozen_stamp = true;
  const double stamp = g_bench.image().timestamp;
  g_bench.ticks(2);
  assert_true(g_bench.image().timestamp == stamp);
  g_bench.controller().faults().nan_positions = true;
  g_bench.ticks(1);
  assert_true(std::isnan(g_bench.image().actual_q[3]));
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_first_packets_have_the_lengths_of_the_version),
      cmocka_unit_test(the_real_time_port_sends_a_packet_every_cycle),
      cmocka_unit_test(power_comes_and_goes_in_its_own_time),
      cmocka_unit_test(the_dashboard_answers_line_by_line),
      cmocka_unit_test(an_e_series_has_an_operational_mode),
      cmocka_unit_test(a_push_is_a_collision_and_a_wrong_encoder_a_deviation),
      cmocka_unit_test(a_script_that_goes_silent_at_speed_is_a_sudden_stop),
      cmocka_unit_test(a_protective_stop_is_told_and_unlocked_when_it_may_be),
      cmocka_unit_test(a_stop_is_unlocked_exactly_five_seconds_after_it),
      cmocka_unit_test(the_safety_system_steps_in_at_its_limits),
      cmocka_unit_test(the_tool_stays_below_its_speed_limit),
      cmocka_unit_test(what_a_test_breaks_is_broken),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
