// Tests a UR's HAL at the rates of an e-Series against the emulated controller with its arm, over
// sockets in lock-step.
#include "tests/ur/hal/ur_emulated_bench.hpp"

namespace tactus::ur {
namespace {

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
      cmocka_unit_test(five_hundred_cycles_in_a_second),
      cmocka_unit_test(an_e_series_at_125_hz_is_given_a_set_point_for_four_of_its_cycles),
      cmocka_unit_test(a_cb3_is_not_asked_for_500_hz),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_arm.reset();
  g_robot.reset();
  return failed;
}
