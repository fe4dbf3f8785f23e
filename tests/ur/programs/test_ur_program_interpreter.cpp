// Tests the interpreter of a program's lines: values, branches, loops, moves; and the functions of
// a program: arguments, results, and whose a variable is.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {
namespace {

// Proves URP-4.

void values_are_computed_in_the_order_of_the_manual(void**) {
  static ProgramBench bench;
  bench.machine().io.input.ints[4] = 7;
  bench.machine().io.input.doubles[5] = -0.25;
  bench.upload(
      "def values():\n"
      "  list = [1.5, 2*3, -(4+1)]\n"
      "  list[1] = list[1] / 4\n"
      "  write_output_float_register(0, 2 + 3 * 4 - 6 / 4)\n"
      "  write_output_float_register(1, list[0] + list[1] * list[2])\n"
      "  write_output_float_register(2, norm(read_input_float_register(5)) + d2r(180))\n"
      "  write_output_integer_register(0, read_input_integer_register(4) % 4)\n"
      "  write_output_boolean_register(64, not 1 > 2 and (2 == 2.0 or False))\n"
      "end\n");
  bench.run(2);
  ASSERT_NEAR(bench.float_output(0), 12.5, 0.0);
  ASSERT_NEAR(bench.float_output(1), -6.0, 0.0);
  ASSERT_NEAR(bench.float_output(2), 0.25 + std::acos(-1.0), 1e-15);
  assert_int_equal(bench.int_output(0), 3);
  assert_true(bench.machine().io.output.bit(64));
}

void branches_and_loops_are_followed(void**) {
  static ProgramBench bench;
  bench.upload(
      "def branches():\n"
      "  i = 0\n"
      "  odd = 0\n"
      "  while i < 10:\n"
      "    i = i + 1\n"
      "    if i == 8:\n"
      "      break\n"
      "    elif i % 2 == 0:\n"
      "      continue\n"
      "    else:\n"
      "      if i > 100:\n"
      "        odd = 1000\n"
      "      else:\n"
      "        odd = odd + i\n"
      "      end\n"
      "    end\n"
      "  end\n"
      "  write_output_integer_register(0, odd)\n"
      "  write_output_integer_register(1, i)\n"
      "end\n");
  bench.run(2);
  assert_int_equal(bench.int_output(0), 1 + 3 + 5 + 7);
  assert_int_equal(bench.int_output(1), 8);
}

void a_loop_that_never_waits_costs_a_bounded_time(void**) {
  static ProgramBench bench;
  bench.upload("def busy():\n  i = 0\n  while True:\n    i = i + 1\n  end\nend\n");
  bench.run(10);
  assert_true(bench.running());
  bench.upload("stop program\n");
  bench.run(2);
  assert_false(bench.running());
}

/// Runs lines in a loop for some cycles; returns how often they ran.
int loops(const char* lines, int cycles) {
  static ProgramBench bench;
  static std::array<char, 16384> text;
  const int size =
      std::snprintf(text.data(), text.size(),
                    "def busy():\n  n = 0\n  x = 0\n  while True:\n    %s\n    n = n + 1\n"
                    "    write_output_integer_register(0, n)\n  end\nend\n",
                    lines);
  bench.upload({text.data(), static_cast<std::size_t>(size)});
  bench.run(cycles);
  assert_true(bench.running());
  return bench.int_output(0);
}

void costly_lines_count_by_their_cost(void**) {
  const int plain = loops("x = 1", 20);
  const int searches = loops("x = get_inverse_kin(get_target_tcp_pose())", 20);
  assert_in_range(searches, 20, 2 * 20);
  assert_true(plain > 20 * searches);
  static std::array<char, 8192> sum;
  std::memcpy(sum.data(), "x = 1", 5);
  for (std::size_t i = 5; i + 2 < 5 + 2 * 3000; i += 2) std::memcpy(&sum[i], "+1", 2);
  assert_in_range(loops(sum.data(), 20), 6, 8);  // 3000 values of 1024 in a cycle
}

void a_stream_that_searches_joints_keeps_the_cycle(void**) {
  const int sent = loops("q = get_inverse_kin(get_target_tcp_pose())\n    servoj(q, t=0.008)", 300);
  assert_in_range(sent, 298, 300);
}

void brackets_without_end_are_no_value(void**) {
  static ProgramBench bench;
  for (const std::string_view text :
       {"x = ((((((((((((((((((((((((((((((((1))))))))))))))))))))))))))))))))\n", "x = [1, 2\n",
        "x = p[\n", "x = \"open\n", "set_tcp(\n", "x = -\n", "x = 1 +\n", "x[ = 3\n"}) {
    bench.upload(text);
    bench.run(2);
  }
  assert_int_equal(bench.said.count("compile_error_"), 8);
  assert_false(bench.said.has("PROGRAM_XXX_STARTED"));
}

// Proves URP-8.

void a_target_out_of_reach_moves_nothing(void**) {
  static ProgramBench bench;
  const Joints q = bench.target();
  bench.upload("movej([-123.0, -1.6, 0, 0, 0, 0])\n");
  bench.run(50);
  assert_false(bench.running());
  assert_joints(bench.target(), q, 0.0);
  assert_int_equal(bench.image().safety_mode, 1);
  bench.upload("movel(p[5.0, 0, 0, 0, 0, 0])\n");
  bench.run(5);
  assert_joints(bench.target(), q, 0.0);
  assert_int_equal(bench.image().safety_mode, 3);
}

// Proves URP-15.

void functions_of_the_programs_own_are_run(void**) {
  static ProgramBench bench;
  bench.upload(
      "def functions():\n"
      "  def add():\n"
      "    while True:\n"
      "      n = n + 1\n"
      "      if n % 2 == 0:\n"
      "        return\n"
      "      end\n"
      "    end\n"
      "  end\n"
      "  def twice():\n"
      "    add()\n"
      "    add() # and again\n"
      "  end\n"
      "  n = 1\n"
      "  twice()\n"
      "  write_output_integer_register(0, n)\n"
      "  sync()\n"
      "  add()\n"
      "  write_output_integer_register(0, n)\n"
      "end\n");
  bench.run(1);
  assert_int_equal(bench.int_output(0), 4);
  bench.run(3);
  assert_int_equal(bench.int_output(0), 6);
  assert_false(bench.running());
}

void arguments_belong_to_the_function_and_results_to_the_caller(void**) {
  static ProgramBench bench;
  bench.upload(
      "def functions():\n"
      "  x = 100\n"
      "  calls = 0\n"
      "  def half(x):\n"
      "    calls = calls + 1\n"
      "    return x / 2\n"
      "  end\n"
      "  def mean(a, b):\n"
      "    local calls = 7\n"
      "    c = a + b\n"
      "    x = half(c)\n"
      "    if x > 4:\n"
      "      sync()\n"
      "      return x\n"
      "    end\n"
      "    return 0\n"
      "  end\n"
      "  def swap(a, b):\n"
      "    global first = b\n"
      "    global second = a\n"
      "  end\n"
      "  write_output_float_register(0, x)\n"
      "  y = mean(4, 2 * 3)\n"
      "  z = mean(1, 2)\n"
      "  swap(y, p[1, 2, 3, 0, 0, 0])\n"
      "  write_output_float_register(1, y)\n"
      "  write_output_float_register(2, z)\n"
      "  write_output_float_register(3, x)\n"
      "  write_output_float_register(4, first[1] + second)\n"
      "  write_output_integer_register(0, calls)\n"
      "end\n");
  bench.run(5);
  assert_false(bench.said.has("_error"));
  ASSERT_NEAR(bench.float_output(0), 100.0, 0.0);
  ASSERT_NEAR(bench.float_output(1), 5.0, 0.0);
  ASSERT_NEAR(bench.float_output(2), 0.0, 0.0);
  ASSERT_NEAR(bench.float_output(3), 1.5, 0.0);  // x of the program, which mean() does not have
  ASSERT_NEAR(bench.float_output(4), 7.0, 0.0);
  assert_int_equal(bench.int_output(0), 2);
}

void a_function_that_moves_the_arm_returns_when_it_is_there(void**) {
  static ProgramBench bench;
  bench.upload(
      "def moves():\n"
      "  def turn(angle):\n"
      "    q = get_target_joint_positions()\n"
      "    q[0] = q[0] + angle\n"
      "    movej(q)\n"
      "    return q[0]\n"
      "  end\n"
      "  a = turn(0.2)\n"
      "  a = turn(0.1)\n"
      "  write_output_float_register(0, a)\n"
      "end\n");
  bench.run(1);
  bench.run_to_end();
  ASSERT_NEAR(bench.target()[0], 0.3, 1e-9);
  ASSERT_NEAR(bench.float_output(0), 0.3, 1e-9);
}

void a_function_without_a_result_ends_the_program_that_wants_one(void**) {
  static ProgramBench bench;
  bench.upload(
      "def wants():\n  def f():\n    sync()\n  end\n  x = f()\n  set_digital_out(0, True)\nend\n");
  bench.run(5);
  assert_true(bench.said.has("runtime_error:"));
  assert_int_equal(bench.machine().io.digital_outputs, 0);
}

void a_function_that_calls_itself_ends_the_program(void**) {
  static ProgramBench bench;
  bench.upload("def deep():\n  def again():\n    again()\n  end\n  again()\nend\n");
  bench.run(3);
  assert_true(bench.said.has("runtime_error:limit of 32 nested blocks and calls"));
  assert_false(bench.running());
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(values_are_computed_in_the_order_of_the_manual),
      cmocka_unit_test(branches_and_loops_are_followed),
      cmocka_unit_test(a_loop_that_never_waits_costs_a_bounded_time),
      cmocka_unit_test(costly_lines_count_by_their_cost),
      cmocka_unit_test(a_stream_that_searches_joints_keeps_the_cycle),
      cmocka_unit_test(brackets_without_end_are_no_value),
      cmocka_unit_test(a_target_out_of_reach_moves_nothing),
      cmocka_unit_test(functions_of_the_programs_own_are_run),
      cmocka_unit_test(arguments_belong_to_the_function_and_results_to_the_caller),
      cmocka_unit_test(a_function_that_moves_the_arm_returns_when_it_is_there),
      cmocka_unit_test(a_function_without_a_result_ends_the_program_that_wants_one),
      cmocka_unit_test(a_function_that_calls_itself_ends_the_program),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
