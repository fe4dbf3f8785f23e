// Tests the stops of the emulated controller: their triggers, the messages about them, and the
// recovery.
#include "tests/ur/controller/ur_state_client.hpp"

namespace tactus::ur {
namespace {

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
