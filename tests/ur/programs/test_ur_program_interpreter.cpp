// Tests the interpreter of a program's lines: values, branches, loops and moves.
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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
