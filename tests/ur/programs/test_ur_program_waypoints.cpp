// Tests the low-bandwidth program: waypoints over a socket, each a line of text. The program's text
// is our own, with the relevant lines.
#include "tests/ur/programs/ur_control_computer.hpp"

namespace tactus::ur {
namespace {

// Proves URE-36.

/// The driver's name has 32 letters too.
constexpr const char* kWaypointProgram =
    "def a_name_as_long_as_the_drivers_is():\n"
    "    global TIME_INTERVAL           = 0.008000\n"
    "    global SERVOJ_TIME             = 0.008000\n"
    "    global SERVOJ_TIME_WAITING     = 0.001000\n"
    "    global MAX_WAITING_TIME        = 0.100000\n"
    "    global SERVOJ_GAIN             = 2000.000000\n"
    "    global SERVOJ_LOOKAHEAD_TIME   = 0.030000\n"
    "    global CONNECTION_NAME         = \"reverse_connection\"\n"
    "    global REVERSE_IP              = \"10.0.0.7\"\n"
    "    global REVERSE_PORT            = 50001\n"
    "    global MAX_JOINT_DIFFERENCE    = 0.010000\n"
    "    servoj(q, t=SERVOJ_TIME, lookahead_time=SERVOJ_LOOKAHEAD_TIME, gain=SERVOJ_GAIN)\n"
    "    waypoint = socket_read_ascii_float(14, CONNECTION_NAME)\n"
    "end\n";

Link& reverse_connection() {
  return *g_bench->links().find("reverse_connection");
}

/// The robot's requests since the last call.
std::string_view asked() {
  static std::array<char, 256> text;
  Outbox& out = reverse_connection().outbox();
  const std::size_t size = std::min(out.size(), text.size());
  if (size > 0) std::memcpy(text.data(), out.data(), size);
  out.sent(size);
  return {text.data(), size};
}

void answer(std::string_view text) {
  reverse_connection().receive(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// In the client's form, with the end of a line and of a string.
void answer(int number, const Joints& q, double dq5, double time_s) {
  std::array<char, 256> text{};
  const int size =
      std::snprintf(text.data(), text.size(), "(%d,%g,%g,%g,%g,%g,%g,0,0,0,0,0,%g,%g)\r\n", number,
                    q[0], q[1], q[2], q[3], q[4], q[5], dq5, time_s);
  answer({text.data(), static_cast<std::size_t>(size) + 1});
}

void start_waypoints() {
  connect();
  g_bench.send(g_primary, kWaypointProgram);
  tick(3);
  const Link& link = reverse_connection();
  assert_true(playing() && link.open());
  assert_string_equal(link.host(), "10.0.0.7");
  assert_int_equal(link.port(), 50001);
}

void waypoints_are_asked_for_and_followed_on_cubics(void**) {
  start_waypoints();
  assert_true(asked() == "0\n1\n2\n");
  const Joints home = g_bench.image().actual_q;
  Joints half = home, goal = home;
  half[5] += 0.2;
  goal[5] += 0.4;
  answer(0, home, 0.0, 0.0);
  answer(1, half, 0.6, 0.5);
  tick(2);
  assert_true(asked().empty());
  answer(2, goal, 0.0, 1.0);
  tick(1);
  assert_true(asked().empty());
  for (int k = 0; k < 120; ++k) {
    tick();
    if (k == 2) {
      assert_true(asked() == "3\n");
      answer(3, Joints::Zero(), 0.0, 0.0);
    }
    // Both cubics are the same: rest to rest in 1 s. servoj lags by its lookahead.
    const double s = std::max(0.0, kCycle_s * (k + 1) - 0.03);
    ASSERT_NEAR(g_bench.image().target_q[5] - home[5], 0.4 * s * s * (3.0 - 2.0 * s), 4e-3);
  }
  assert_true(asked().empty());
  tick(10);
  assert_false(playing() || reverse_connection().open());
  ASSERT_NEAR(g_bench.image().actual_q[5], goal[5], 0.01);
}

void waypoints_that_do_not_come_or_cannot_be_read_end_the_program(void**) {
  start_waypoints();
  const Joints home = g_bench.image().actual_q;
  answer(0, home, 0.0, 0.0);
  answer(1, home, 0.0, 0.1);
  answer(2, home, 0.0, 0.2);
  tick(90);
  assert_true(playing());  // it waits a hundred cycles for the fourth
  tick(60);
  assert_false(playing());

  for (const char* wrong : {"hello\r\n", "(0,1,2)\r\n", "(0,1,2,3,4,5,6,7,8,9,10,11,12,13,14)\n",
                            "(0,a,2,3,4,5,6,7,8,9,10,11,12,13)\n", "\n", "(\n"}) {
    start_waypoints();
    g_bench.take(g_primary);
    answer(wrong);
    tick(1);
    assert_true(g_bench.take(g_primary).find("wrong number of floats") != std::string_view::npos);
    for (int i = 0; i < 3; ++i) answer(i, home + Joints::Constant(0.1 * i), 0.0, 0.2 * i);
    tick(120);
    assert_false(playing());
    ASSERT_NEAR(g_bench.image().target_q[0], home[0], 1e-9);
  }
  assert_false(g_bench.image().protective_stopped);
}

/// The slots before the first waypoint are zeros: the arm would have to jump there.
void a_single_waypoint_is_come_to_from_zero(void**) {
  start_waypoints();
  answer(0, g_bench.image().actual_q, 0.0, 0.5);
  answer(1, Joints::Zero(), 0.0, 0.0);
  tick(3);
  assert_true(g_bench.image().protective_stopped);
}

void waypoints_with_numbers_of_any_size_do_no_harm(void**) {
  for (const char* line :
       {"(2147483647,0,0,0,0,0,0,0,0,0,0,0,0,0)\n", "(2147483647,1,1,1,1,1,1,1,1,1,1,1,1,-1)\n",
        "(-1e300,0,0,0,0,0,0,0,0,0,0,0,0,0)\n", "(2,1e300,1,1,1,1,1,1,1,1,1,1,1,1e-300)\n",
        "(9,0,-1.5,1.5,-1.5,-1.5,0,1e9,1e9,1e9,1e9,1e9,1e9,1)\n"}) {
    start_waypoints();
    for (int k = 0; k < 3; ++k) answer(line);
    for (int k = 0; k < 300; ++k) {
      tick();
      assert_true(g_bench.image().target_q.allFinite() && g_bench.image().actual_q.allFinite());
    }
    assert_false(playing());
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(waypoints_are_asked_for_and_followed_on_cubics),
      cmocka_unit_test(waypoints_that_do_not_come_or_cannot_be_read_end_the_program),
      cmocka_unit_test(a_single_waypoint_is_come_to_from_zero),
      cmocka_unit_test(waypoints_with_numbers_of_any_size_do_no_harm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
