// The emulated controller as its clients see it: modes and their times, stops and their triggers, the
// messages that tell of them, and the dashboard.
#include <cstdio>

#include "tests/ur_bench.hpp"
#include "tests/testing.hpp"

namespace tactus::ur {
namespace {

Bench g_bench;
int g_primary = -1, g_dashboard = -1;

void connect(const Settings& settings = {}) {
  g_bench.start(settings);
  assert_true(g_bench.started());
  g_primary = g_bench->open(Service::kPrimary);
  g_dashboard = g_bench->open(Service::kDashboard);
  g_bench.take(g_dashboard);
}

void expect_reply(std::string_view command, std::string_view reply) {
  g_bench.send(g_dashboard, command);
  g_bench.send(g_dashboard, "\n");
  std::string_view got = g_bench.take(g_dashboard);
  assert_true(!got.empty() && got.back() == '\n');
  got.remove_suffix(1);
  if (got != reply) print_error("%.*s\n", static_cast<int>(got.size()), got.data());
  assert_true(got == reply);
}

/// Whether the bytes of the primary port hold a message of this type whose body begins like this.
bool heard(MessageType type, std::string_view body) {
  const std::string_view got = g_bench.take(g_primary);
  StateFrames frames;
  Packet packet;
  bool found = false;
  for (std::size_t at = 0; at < got.size();) {
    at += frames.take(reinterpret_cast<const std::uint8_t*>(got.data()) + at, got.size() - at);
    NextPacket next;
    while ((next = frames.next(packet)) == NextPacket::kPacket) {
      ByteReader reader(packet.data, packet.size);
      reader.u32();
      if (reader.i8() != static_cast<int>(StateType::kRobotMessage)) continue;
      reader.u64();
      reader.i8();
      if (reader.u8() != static_cast<int>(type)) continue;
      found = found || reader.rest().substr(0, body.size()) == body;
    }
    assert_true(next != NextPacket::kBroken);
  }
  return found;
}

/// Code and argument as they begin a body.
std::string_view stop_bytes(Code code, std::int32_t argument) {
  static std::array<std::uint8_t, 8> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  writer.i32(static_cast<std::int32_t>(code));
  writer.i32(argument);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool protective_stopped() {
  return g_bench.image().safety_mode == static_cast<int>(SafetyMode::kProtectiveStop);
}
bool in_mode(RobotMode mode) {
  return g_bench.image().robot_mode == static_cast<int>(mode);
}

// Proves URE-5.

void the_first_packets_have_the_lengths_of_the_version(void**) {
  connect();
  const std::string_view got = g_bench.take(g_primary);
  ByteReader reader(reinterpret_cast<const std::uint8_t*>(got.data()), got.size());
  const std::uint32_t version_size = reader.u32();
  assert_int_equal(reader.i8(), 20);
  reader.u64();
  assert_int_equal(reader.i8(), -2);
  assert_int_equal(reader.u8(), 3);
  reader.text(version_size - 15);
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
  connect();
  const int client = g_bench->open(Service::kRealtime);
  g_bench.ticks(3);
  const std::string_view got = g_bench.take(client);
  assert_int_equal(got.size(), 3 * 1116);
  const auto* data = reinterpret_cast<const std::uint8_t*>(got.data()) + 2 * 1116;
  const auto number = [&](std::size_t offset) { return ByteReader(data + offset, 8).f64(); };
  assert_true(number(kTimeOffset) == 100.0 + 3 * 0.008);
  for (int i = 0; i < 6; ++i)
    ASSERT_NEAR(number(kQActualOffset + 8 * static_cast<std::size_t>(i)),
                Settings().initial_q[i], 1e-9);
  assert_true(number(kRobotModeOffset) == 7.0);
  assert_true(number(kJointModesOffset) == 253.0);
  assert_true(number(kSafetyModeOffset) == 1.0);
  assert_true(number(kProgramStateOffset) == 1.0);
  assert_true(number(kSafetyStatusOffset) == 1.0);
  Settings old;
  old.version = {3, 2, 0, 1};
  connect(old);
  const int second = g_bench->open(Service::kRealtime);
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(second).size(), 1060);
}

// Proves URE-6.

void power_comes_and_goes_in_its_own_time(void**) {
  Settings settings;
  settings.switched_on = false;
  connect(settings);
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
  connect();
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

// Proves URE-20.

void a_push_is_a_collision_and_a_wrong_encoder_a_deviation(void**) {
  connect();
  g_bench.ticks(10);
  g_bench.controller().faults().push[2] = -100.0;
  assert_true(g_bench.until(protective_stopped, 50));
  assert_true(heard(MessageType::kErrorCode, stop_bytes(Code::kCollision, 2)));
  connect();
  g_bench.ticks(10);
  g_bench.controller().faults().encoder_offset[4] = 0.2;
  assert_true(g_bench.until(protective_stopped, 2));
  assert_true(heard(MessageType::kErrorCode, stop_bytes(Code::kPathDeviation, 4)));
}

void a_script_that_goes_silent_at_speed_is_a_sudden_stop(void**) {
  connect();
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
  connect();
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

void the_safety_system_steps_in_at_its_limits(void**) {
  connect();
  g_bench.controller().faults().encoder_offset[0] = 7.0;  // rad: beyond 363 degrees
  g_bench.ticks(14);
  assert_int_equal(g_bench.image().safety_mode, static_cast<int>(SafetyMode::kViolation));
  assert_true(heard(MessageType::kErrorCode,
                    stop_bytes(Code::kSafetyViolation, kViolatedJointPosition)));
  g_bench.ticks(60);
  assert_true(in_mode(RobotMode::kPowerOff));
  g_bench.controller().faults() = {};
  expect_reply("restart safety", "Restarting safety");
  g_bench.ticks(1);
  expect_reply("safetymode", "Safetymode: NORMAL");
}

void the_tool_stays_below_its_speed_limit(void**) {
  Settings settings;
  settings.initial_q << 0.0, -0.3, 0.0, 0.0, 0.0, 0.0;  // stretched out
  connect(settings);
  g_bench.send(g_primary, "movej([2.5,-0.3,0,0,0,0],a=3.0,v=2.0)\n");
  double fastest = 0.0;
  for (int i = 0; i < 500; ++i) {
    g_bench.ticks(1);
    fastest = std::max(fastest, g_bench.image().actual_tcp_speed.head<3>().norm());
  }
  assert_true(fastest > 1.3 && fastest < 1.5);
  ASSERT_NEAR(g_bench.image().actual_q[0], 2.5, 1e-6);
  assert_int_equal(g_bench.image().safety_mode, 1);
}

void what_a_test_breaks_is_broken(void**) {
  connect();
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
      cmocka_unit_test(a_push_is_a_collision_and_a_wrong_encoder_a_deviation),
      cmocka_unit_test(a_script_that_goes_silent_at_speed_is_a_sudden_stop),
      cmocka_unit_test(a_protective_stop_is_told_and_unlocked_when_it_may_be),
      cmocka_unit_test(the_safety_system_steps_in_at_its_limits),
      cmocka_unit_test(the_tool_stays_below_its_speed_limit),
      cmocka_unit_test(what_a_test_breaks_is_broken),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
