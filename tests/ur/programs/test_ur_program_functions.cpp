// Tests functions of a plain program: arguments, results, and whose a variable is.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

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

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(functions_of_the_programs_own_are_run),
      cmocka_unit_test(arguments_belong_to_the_function_and_results_to_the_caller),
      cmocka_unit_test(a_function_that_moves_the_arm_returns_when_it_is_there),
      cmocka_unit_test(a_function_without_a_result_ends_the_program_that_wants_one),
      cmocka_unit_test(a_function_that_calls_itself_ends_the_program),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
