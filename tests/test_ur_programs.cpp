// Programs in the field, known by their shape: texts of our own with the lines that matter, and the
// control computer's end of their sockets.
#include <cstdio>

#include "tests/ur_bench.hpp"
#include "tests/testing.hpp"

namespace tactus::ur {
namespace {

Bench g_bench;
int g_primary = -1, g_rtde = -1;

void connect() {
  g_bench.start();
  assert_true(g_bench.started());
  g_primary = g_bench->open(Service::kPrimary);
  g_rtde = g_bench->open(Service::kRtde);
}

/// Connects every link that a program wants.
void answer_calls() {
  for (Link& link : g_bench->links().all())
    if (link.state() == Link::State::kWanted) link.connected();
}

void tick(int count = 1) {
  for (int i = 0; i < count; ++i) {
    g_bench.ticks(1);
    answer_calls();
  }
}

void send_ints(std::string_view socket, std::initializer_list<double> values) {
  std::array<std::uint8_t, 128> bytes{};
  ByteWriter writer(bytes.data(), bytes.size());
  for (const double value : values) writer.i32(static_cast<std::int32_t>(std::lround(value)));
  g_bench->links().find(socket)->receive(bytes.data(), writer.size());
}

constexpr double kMillion = 1e6;

/// A message over the reverse socket.
void reverse(double timeout_ms, const Joints& values, ControlMode mode) {
  send_ints("reverse_socket", {timeout_ms, values[0] * kMillion, values[1] * kMillion,
                               values[2] * kMillion, values[3] * kMillion, values[4] * kMillion,
                               values[5] * kMillion, static_cast<double>(mode)});
}
void forward_command(double command, double count) {
  send_ints("reverse_socket", {200, command, count, 0, 0, 0, 0, 3});
}
/// Cycles with the keep-alive that a trajectory needs.
void keep_alive(int count) {
  for (int i = 0; i < count; ++i) {
    forward_command(kForwardNothing, 0);
    tick();
  }
}

bool playing() {
  return g_bench.image().runtime_state == 2;
}

/// The result that came back over the trajectory socket; -1: none.
std::int32_t result() {
  Outbox& out = g_bench->links().find("trajectory_socket")->outbox();
  if (out.size() < 4) return -1;
  const std::int32_t value = ByteReader(out.data(), 4).i32();
  out.sent(4);
  return value;
}

constexpr const char* kExternalControl =
    "def external():\n"
    "  def connect_socket_with_retry(host, port, name, max_attempts=5, dt=0.2):\n"
    "    return socket_open(host, port, name)\n"
    "  end\n"
    "  a = connect_socket_with_retry(\"10.0.0.7\", 50003, \"trajectory_socket\")\n"
    "  b = connect_socket_with_retry(\"10.0.0.7\", 50004, \"script_command_socket\")\n"
    "  c = connect_socket_with_retry(\"10.0.0.7\", 50001, \"reverse_socket\")\n"
    "  servoj(q, t=steptime, lookahead_time=0.03, gain=2000)\n"
    "  write_output_float_register(1, splineTimerTraveled)\n"
    "  socket_send_int(TRAJECTORY_RESULT_CANCELED, \"trajectory_socket\")\n"
    "  socket_close(\"script_command_socket\")\n"
    "  write_output_integer_register(5, 77)\n"
    "  sleep(0.5)\n"
    "end\n";

void start_external(std::string_view text = kExternalControl) {
  connect();
  g_bench.send(g_primary, text);
  tick(6);
  assert_true(playing());
}

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
  assert_true(playing());  // the first read waits for ever
  for (int k = 0; k < 125; ++k) {
    q[5] += 0.004;
    reverse(20.0, q, ControlMode::kServoJ);
    tick();
  }
  // Late by the lookahead of 30 ms, at half a radian per second.
  ASSERT_NEAR(q[5] - g_bench.image().target_q[5], 0.5 * (0.03 - 0.004), 1e-3);
  tick(2);
  assert_true(playing());  // carried on at the present speed
  ASSERT_NEAR(g_bench.image().target_qd[5], 0.5, 0.02);
  tick(40);
  assert_false(playing());
  assert_true(g_bench.image().target_qd.isZero(0.0));
  assert_int_equal(g_bench.image().safety_mode, 1);
  assert_int_equal(g_bench.image().output.ints[5], 0);  // halted: nothing behind the loop
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

// Proves URE-31.

void spline_point(const Joints& q, double time_s) {
  send_ints("trajectory_socket", {q[0] * kMillion, q[1] * kMillion, q[2] * kMillion,
                                  q[3] * kMillion, q[4] * kMillion, q[5] * kMillion, 0, 0, 0, 0, 0,
                                  0, 0, 0, 0, 0, 0, 0, time_s * kMillion, 2, 51});
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
  send_ints("trajectory_socket", {-123e6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.05e6, 1.4e6, 0, 0, 0, 0, 0, 0, 0});
  tick(10);
  assert_int_equal(result(), kFailed);
  assert_true(g_bench.image().target_q == before);
}

// Proves URE-32.

void the_driver_program_brakes_without_set_points_and_stays_alive(void**) {
  connect();
  g_bench.send(g_primary,
               "def driverProg():\n\tMULT_jointstate = 1000000\n"
               "\tthread servoThread():\n\t\tservoj(q, t=0.0080, lookahead_time=0.0300, gain=300)\n"
               "\tend\n  socket_open(\"10.0.0.7\", 50001)\n"
               "\tparams_mult = socket_read_binary_integer(6+1)\nend\n");
  tick(3);
  assert_true(playing());
  Joints q = g_bench.image().actual_q;
  const auto send_q = [&](double keep_alive) {
    send_ints("socket_0", {q[0] * kMillion, q[1] * kMillion, q[2] * kMillion, q[3] * kMillion,
                           q[4] * kMillion, q[5] * kMillion, keep_alive});
  };
  for (int k = 0; k < 50; ++k) {
    q[5] += 0.002;
    send_q(1);
    tick();
  }
  assert_true(g_bench.image().target_qd[5] > 0.1);
  tick(60);
  assert_true(playing() && g_bench.image().target_qd.isZero(0.0));
  send_q(0);
  tick(2);
  assert_false(playing());
}

// Proves URE-33.

/// Writes RTDE's input registers as the client would: the command, and doubles from 0.
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
  constexpr std::string_view kBody("\0\0\0\2\0\0\0\3compile_error_name_not_found:calldoesntexist:", 53);
  assert_true(got.find(kBody) != std::string_view::npos);
  assert_true(got.find("PROGRAM_XXX_STARTEDwrong") == std::string_view::npos);
}

void no_text_does_harm(void**) {
  connect();
  std::uint32_t state = 7;
  const auto next = [&] { return state = state * 1664525u + 1013904223u, state >> 24; };
  constexpr std::array<std::string_view, 14> kParts = {
      "def a():\n", "end\n", "  movej(", "[0,1,2,3,4,5]", "p[", ")", "\n", "while True:\n", "\"",
      "servoj(", "1e309", "socket_open(\"x\",", "sec b():\n", "reverse_socket"};
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
      cmocka_unit_test(external_control_connects_out_in_its_order_to_the_address_in_the_text),
      cmocka_unit_test(set_points_move_the_arm_and_silence_ends_the_program),
      cmocka_unit_test(stopped_ends_the_loop_and_the_program_goes_on_behind_it),
      cmocka_unit_test(a_set_point_too_far_away_is_ignored),
      cmocka_unit_test(speeds_are_ramped_and_held),
      cmocka_unit_test(a_trajectory_of_splines_is_followed_and_its_result_sent),
      cmocka_unit_test(missing_points_fail_and_a_cancel_is_told_if_the_text_does),
      cmocka_unit_test(a_move_that_cannot_be_reached_fails_without_motion),
      cmocka_unit_test(the_driver_program_brakes_without_set_points_and_stays_alive),
      cmocka_unit_test(the_register_program_shakes_hands),
      cmocka_unit_test(plain_lines_run_one_after_the_other),
      cmocka_unit_test(no_text_does_harm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
