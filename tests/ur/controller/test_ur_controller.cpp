// Tests the emulated controller as its clients see it: modes and their durations, stops and their
// triggers, the messages about them, and the dashboard.
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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
