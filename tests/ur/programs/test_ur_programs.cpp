// Tests programs of existing clients, recognised by their shape: trajectories of external control,
// the driver program, the register program, and plain lines. The texts are our own, with the
// relevant lines.
#include "tests/ur/programs/ur_control_computer.hpp"

namespace tactus::ur {
namespace {

// Proves URE-31.

void spline_point(const Joints& q, double time_s) {
  send_ints("trajectory_socket", {q[0] * kMillion,
                                  q[1] * kMillion,
                                  q[2] * kMillion,
                                  q[3] * kMillion,
                                  q[4] * kMillion,
                                  q[5] * kMillion,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  0,
                                  time_s * kMillion,
                                  2,
                                  51});
}

void a_trajectory_of_splines_is_followed_and_its_result_sent(void**) {
  start_external();
  const Joints home = g_bench.image().actual_q;
  Joints goal = home;
  goal[3] += 0.5;
  forward_command(0, 0);
  forward_command(1, 1);
  spline_point(goal, 1.0);
  for (int k = 0; k < 160; ++k) {
    forward_command(0, 0);
    tick();
    const double s = std::min(1.0, g_bench.image().output.doubles[1]);
    const double x = 0.5 * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    ASSERT_NEAR(g_bench.image().target_q[3] - home[3], x, 0.02);
  }
  assert_int_equal(result(), kSucceeded);
  ASSERT_NEAR(g_bench.image().target_q[3], goal[3], 1e-3);
}

void missing_points_fail_and_a_cancel_is_told_if_the_text_does(void**) {
  start_external();
  forward_command(1, 1);
  keep_alive(80);
  assert_int_equal(result(), kFailed);
  const Joints far = g_bench.image().actual_q + Joints::Constant(0.3);
  forward_command(1, 1);
  spline_point(far, 3.0);
  keep_alive(50);
  assert_false(g_bench.image().target_qd.isZero(0.0));
  forward_command(-1, 0);
  keep_alive(30);
  assert_int_equal(result(), kCancelled);
  assert_true(g_bench.image().target_qd.isZero(0.0));

  std::array<char, 2048> text{};
  const std::string_view whole = kExternalControl, line = "socket_send_int(TRAJECTORY_RESULT";
  const std::size_t at = whole.find(line);
  std::snprintf(text.data(), text.size(), "%.*s#%s", static_cast<int>(at), kExternalControl,
                kExternalControl + at + line.size());
  start_external(text.data());
  forward_command(1, 1);
  spline_point(far, 3.0);
  keep_alive(50);
  forward_command(-1, 0);
  keep_alive(30);
  assert_int_equal(result(), -1);
}

void a_move_that_cannot_be_reached_fails_without_motion(void**) {
  start_external();
  const Joints before = g_bench.image().target_q;
  forward_command(1, 1);
  send_ints("trajectory_socket",
            {-123e6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.05e6, 1.4e6, 0, 0, 0, 0, 0, 0, 0});
  tick(10);
  assert_int_equal(result(), kFailed);
  assert_true(g_bench.image().target_q == before);
}

// Proves URE-33.

/// Writes RTDE's input registers as the client does: the command, and doubles from 0 on.
void write_registers(std::int32_t command, std::initializer_list<double> values) {
  Io& io = g_bench.controller().machine().io;
  std::size_t i = 24;
  for (const double value : values) io.input.doubles[i++] = value;
  io.input.ints[24] = command;
}

void the_register_program_shakes_hands(void**) {
  connect();
  g_bench.send(g_primary,
               "def rtde_control():\n  global reg_offset_float = # float register offset\n24\n"
               "  global reg_offset_int = # int register offset\n24\n"
               "  def signal_ready():\n  end\n  def rtde_cmd():\n  end\n  def process_cmd(cmd):\n"
               "  end\nend\n");
  tick(2);
  const auto& answer = g_bench.image().output.ints[24];
  assert_true(playing());
  assert_int_equal(answer, kReady);
  const Joints home = g_bench.image().actual_q;
  write_registers(1, {home[0], home[1], home[2], home[3], home[4], 0.2, 1.05, 1.4});
  tick(5);
  assert_int_equal(answer, kReady);
  assert_true(g_bench.until([&] { return answer == kDone; }, 200));
  ASSERT_NEAR(g_bench.image().actual_q[5], 0.2, 1e-4);
  write_registers(0, {});
  tick();
  assert_int_equal(answer, kReady);
  write_registers(9, {0, 0, 0, 0, 0.3, 0, 0.5, 0});
  tick(100);
  ASSERT_NEAR(g_bench.image().target_qd[4], 0.3, 1e-6);
  assert_int_equal(answer, kReady);
  write_registers(15, {10.0});
  assert_true(g_bench.until([&] { return answer == kDone; }, 20));
  assert_true(g_bench.image().target_qd.isZero(0.0));
  write_registers(255, {});
  tick(2);
  assert_false(playing());
}

// Proves URE-34.

void plain_lines_run_one_after_the_other(void**) {
  connect();
  g_bench.send(g_primary,
               "def lines():\n  while True:\n    write_output_integer_register(3, 9)\n    sync()\n"
               "  end\nend\n");
  tick(3);
  assert_true(playing());
  assert_int_equal(g_bench.image().output.ints[3], 9);
  g_bench.send(g_primary, "sec io():\nset_digital_out(2,True)\nend\n");
  tick(2);
  assert_true(playing());  // beside it
  assert_int_equal(g_bench.image().actual_digital_output_bits, 4);
  g_bench.send(g_primary, "stop program\n");
  tick(2);
  assert_false(playing());
  g_bench.take(g_primary);
  g_bench.send(g_primary, "def wrong():\n  calldoesntexist()\nend\n");
  tick(2);
  const std::string_view got = g_bench.take(g_primary);
  constexpr std::string_view kBody("\0\0\0\2\0\0\0\3compile_error_name_not_found:calldoesntexist:",
                                   53);
  assert_true(got.find(kBody) != std::string_view::npos);
  assert_true(got.find("PROGRAM_XXX_STARTEDwrong") == std::string_view::npos);
}

void a_program_that_is_stopped_takes_its_motion_with_it(void**) {
  connect();
  g_bench.send(g_primary, "movej([1,-1.5708,1.5708,-1.5708,-1.5708,0],a=1.0,v=0.5)\n");
  tick(60);
  assert_true(g_bench.image().target_qd[0] > 0.3);
  g_bench.send(g_primary, "stop program\n");
  tick(30);
  assert_true(g_bench.image().target_qd.isZero(0.0));
  assert_true(g_bench.image().target_q[0] < 0.3);
}

void no_text_does_harm(void**) {
  connect();
  std::uint32_t state = 7;
  const auto next = [&] {
    state = state * 1664525u + 1013904223u;
    return state >> 24;
  };
  constexpr std::array<std::string_view, 14> kParts = {
      "def a():\n", "end\n",         "  movej(", "[0,1,2,3,4,5]", "p[",    ")",
      "\n",         "while True:\n", "\"",       "servoj(",       "1e309", "socket_open(\"x\",",
      "sec b():\n", "reverse_socket"};
  for (int trial = 0; trial < 400; ++trial) {
    for (int n = 0; n < 12; ++n) g_bench.send(g_primary, kParts[next() % kParts.size()]);
    g_bench.ticks(1);
    g_bench.take(g_primary);
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_of_splines_is_followed_and_its_result_sent),
      cmocka_unit_test(missing_points_fail_and_a_cancel_is_told_if_the_text_does),
      cmocka_unit_test(a_move_that_cannot_be_reached_fails_without_motion),
      cmocka_unit_test(the_register_program_shakes_hands),
      cmocka_unit_test(plain_lines_run_one_after_the_other),
      cmocka_unit_test(a_program_that_is_stopped_takes_its_motion_with_it),
      cmocka_unit_test(no_text_does_harm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
