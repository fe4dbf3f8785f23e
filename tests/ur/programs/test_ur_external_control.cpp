// Tests external control: a text of our own with the relevant lines, and the messages that the
// control computer sends over its sockets.
#include "tests/ur/programs/ur_control_computer.hpp"

namespace tactus::ur {
namespace {

// Proves URE-30.

void external_control_connects_out_in_its_order_to_the_address_in_the_text(void**) {
  connect();
  g_bench.send(g_primary, kExternalControl);
  constexpr std::array<int, 3> kPorts = {50003, 50004, 50001};
  for (const int port : kPorts) {
    int wanted = 0;
    for (int i = 0; i < 3 && wanted == 0; ++i) {
      g_bench.ticks(1);
      for (Link& link : g_bench->links().all())
        if (link.state() == Link::State::kWanted) {
          assert_string_equal(link.host(), "10.0.0.7");
          wanted = link.port();
          link.connected();
        }
    }
    assert_int_equal(wanted, port);
  }
}

void set_points_move_the_arm_and_silence_ends_the_program(void**) {
  start_external();
  Joints q = g_bench.image().actual_q;
  tick(100);
  assert_true(playing());  // the first read waits without limit
  for (int k = 0; k < 125; ++k) {
    q[5] += 0.004;
    reverse(20.0, q, ControlMode::kServoJ);
    tick();
  }
  // The arm lags by the lookahead of 30 ms, at half a radian per second.
  ASSERT_NEAR(q[5] - g_bench.image().target_q[5], 0.5 * (0.03 - 0.004), 1e-3);
  tick(2);
  assert_true(playing());  // extrapolated at the present speed
  ASSERT_NEAR(g_bench.image().target_qd[5], 0.5, 0.02);
  tick(40);
  assert_false(playing());
  assert_true(g_bench.image().target_qd.isZero(0.0));
  assert_int_equal(g_bench.image().safety_mode, 1);
  assert_int_equal(g_bench.image().output.ints[5], 0);  // halted: no line after the loop runs
}

void stopped_ends_the_loop_and_the_program_goes_on_behind_it(void**) {
  start_external();
  reverse(100.0, Joints::Zero(), ControlMode::kStopped);
  tick(20);
  assert_true(playing());
  assert_int_equal(g_bench.image().output.ints[5], 77);
  tick(60);
  assert_false(playing());
}

void a_set_point_too_far_away_is_ignored(void**) {
  start_external();
  Joints q = g_bench.image().actual_q;
  q[0] += 0.3;  // 37 rad/s
  const Joints before = g_bench.image().target_q;
  reverse(0.0, q, ControlMode::kServoJ);
  tick(20);
  assert_true((g_bench.image().target_q - before).cwiseAbs().maxCoeff() < 1e-3);
}

void speeds_are_ramped_and_held(void**) {
  start_external();
  Joints dq = Joints::Zero();
  dq[4] = 0.4;
  for (int k = 0; k < 50; ++k) {
    reverse(20.0, dq, ControlMode::kSpeedJ);
    tick();
  }
  ASSERT_NEAR(g_bench.image().target_qd[4], 0.4, 1e-9);
  ASSERT_NEAR(g_bench.image().actual_qd[4], 0.4, 1e-3);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(external_control_connects_out_in_its_order_to_the_address_in_the_text),
      cmocka_unit_test(set_points_move_the_arm_and_silence_ends_the_program),
      cmocka_unit_test(stopped_ends_the_loop_and_the_program_goes_on_behind_it),
      cmocka_unit_test(a_set_point_too_far_away_is_ignored),
      cmocka_unit_test(speeds_are_ramped_and_held),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
