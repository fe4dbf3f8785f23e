// Tests the emulated controller with hostile texts that a client may send.
#include <cmath>

#include "sim_plant/ur/script/script_expression.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

// Proves FUZ-1.
void what_is_no_number_shows_on_no_port(void**) {
  static ProgramBench bench;
  const Vector6 tcp = bench.image().actual_tcp_pose;
  bench.upload("set speed nan\n");
  bench.upload("set speed inf\n");
  ASSERT_NEAR(bench.machine().io.speed_fraction, 1.0, 0.0);
  bench.upload("set_standard_analog_out(0, 0 * pow(10, 400))\n");
  bench.run(4);
  assert_true(bench.said.has("runtime_error:not finite:"));
  bench.machine().io.set_analog(0, std::nan(""));
  bench.run(4);
  ASSERT_NEAR(bench.image().standard_analog_output0, 0.004, 1e-12);
  bench.upload("write_output_integer_register(3, 0 * pow(10, 400))\n");
  bench.run(4);
  assert_int_equal(bench.image().output.ints[3], 0);
  bench.upload("set_payload(pow(10, 400), [0, 0, 0])\n");
  bench.run(4);
  assert_false(bench.image().protective_stopped);
  bench.machine().set_payload(HUGE_VAL, Vector3::Zero());
  bench.run(4);
  assert_true(bench.image().protective_stopped);
  ASSERT_NEAR(bench.image().payload, 0.0, 0.0);
  assert_joints(bench.image().actual_tcp_pose, tcp, 1e-3);
}

// Proves FUZ-1.
void a_tool_that_is_none_stops_the_arm(void**) {
  static ProgramBench bench;
  Vector6 tool = Vector6::Zero();
  tool[2] = std::nan("");
  bench.machine().set_tcp(tool);
  bench.run(4);
  assert_true(bench.image().protective_stopped);
  assert_int_equal(static_cast<int>(bench.machine().last_stop.code), 204);
  assert_int_equal(bench.machine().last_stop.argument, 5);
  assert_true(bench.image().actual_tcp_pose.allFinite());
  assert_true(bench.image().tcp_offset.isZero(0.0));
}

// Proves FUZ-1.
void a_servo_law_that_is_none_stops_the_arm(void**) {
  for (const bool gain : {false, true}) {
    static ProgramBench bench;
    ServoLaw law;
    (gain ? law.gain : law.lookahead_s) = gain ? HUGE_VAL : std::nan("");
    bench.machine().motion.servo_j(bench.target(), 0.1, law);
    bench.run(4);
    assert_true(bench.image().protective_stopped);
    assert_int_equal(static_cast<int>(bench.machine().last_stop.code), 204);
    assert_true(bench.image().actual_q.allFinite() && bench.target().allFinite());
    bench.machine().safety.restart();
    bench.run(2);
  }
}

// Proves FUZ-1.
void a_motion_at_the_ends_of_arithmetic_is_finite(void**) {
  const double infinity = HUGE_VAL;
  const Joints q = ProgramBench::settings().initial_q, to = q + Joints::Constant(2.5);
  Frame target = forward(q);
  target.p[2] -= 0.05;
  for (const double x : {5e-324, 1e-300, 1e300, 1.7e308, infinity, -infinity, std::nan("")})
    for (int kind = 0; kind < 9; ++kind) {
      Motion motion;
      motion.rest(q);
      if (kind < 3) motion.move_j(to, kind == 0 ? x : 1.4, kind == 1 ? x : 1.0, kind == 2 ? x : 0);
      if (kind >= 3 && kind < 6)
        motion.move_l(target, kind == 3 ? x : 1.2, kind == 4 ? x : 0.2, kind == 5 ? x : 0);
      if (kind == 6) motion.servo_j(q, x, {});
      if (kind == 7) motion.speed_j(Joints::Constant(0.1), x, x);
      if (kind == 8) motion.speed_l(Vector6::Constant(0.01), x, x);
      for (int i = 0; i < 10; ++i) motion.advance(kCycle_s);
      assert_true(motion.q().allFinite() && motion.dq().allFinite());
    }
}

// Proves FUZ-1.
void nothing_is_near_to_what_is_no_number(void**) {
  const Joints q = ProgramBench::settings().initial_q;
  for (int joint = 0; joint < 6; ++joint) {
    Joints near = q, found = q;
    near[joint] = std::nan("");
    assert_false(inverse(forward(q), {}, near, found));
    assert_true(found == q);
  }
}

// Proves FUZ-1.
void a_number_beyond_an_integer_is_its_end(void**) {
  assert_int_equal(integer(1e300), 2147483647);
  assert_int_equal(integer(-1e300), -2147483648LL);
  assert_int_equal(integer(std::nan("")), 0);
  assert_int_equal(integer(-7.9), -7);
}

// Proves FUZ-2.
void a_reply_always_ends_its_line(void**) {
  static ProgramBench bench;
  std::array<char, 1024> line;
  line.fill('x');
  std::memcpy(line.data(), "load ", 5);
  Reply reply;
  assert_false(bench.controller.dashboard().run({line.data(), line.size()}, reply));
  const std::string_view said = reply;
  assert_true(said.size() <= 512);
  assert_int_equal(said.find('\n'), said.size() - 1);
}

// Proves FUZ-3.
void nots_do_not_nest_without_end(void**) {
  static std::array<char, kLongestScript> text;
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = "not "[i % 4];
  std::string_view rest(text.data(), text.size());
  ScriptValue value;
  assert_false(evaluate(rest, {}, value));
  rest = "not not not 1 == 2 or not (not True)";
  assert_true(evaluate(rest, {}, value));
  ASSERT_NEAR(value.number, 1.0, 0.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_is_no_number_shows_on_no_port),
      cmocka_unit_test(a_tool_that_is_none_stops_the_arm),
      cmocka_unit_test(a_servo_law_that_is_none_stops_the_arm),
      cmocka_unit_test(a_motion_at_the_ends_of_arithmetic_is_finite),
      cmocka_unit_test(nothing_is_near_to_what_is_no_number),
      cmocka_unit_test(a_number_beyond_an_integer_is_its_end),
      cmocka_unit_test(a_reply_always_ends_its_line),
      cmocka_unit_test(nots_do_not_nest_without_end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
