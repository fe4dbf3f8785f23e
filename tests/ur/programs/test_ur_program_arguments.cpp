// Tests that calls whose arguments do not fit are refused before anything is done, and that values
// out of range end a program before the motion.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

struct Row {
  const char* line;
  const char* message;
};

/// Runs a program that sets an output, then has the line; returns true if the output was set.
bool done(ProgramBench& bench, const char* line) {
  bench.said = {};
  bench.machine().io.digital_outputs = 0;
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(),
                "def a():\n  x = 1\n  set_digital_out(0, True)\n  %s\nend\n", line);
  bench.upload(text.data());
  bench.run(5);
  return bench.machine().io.digital_outputs != 0;
}

// Proves URP-14.

void arguments_that_do_not_fit_are_refused(void**) {
  constexpr Row kRows[] = {
      {"movej([1,0,0,0,0,0], vel=2)", "syntax:vel:is no parameter:"},
      {"movej([1,0,0,0,0,0], 1, 1, 0, 0, 0)", "syntax:movej:has too many arguments:"},
      {"movej()", "syntax:movej:lacks an argument:"},
      {"movej(v=1)", "syntax:movej:lacks an argument:"},
      {"movej([1,0,0,0,0,0], v=1, 1)", "syntax:movej:has an argument by position after one by"},
      {"movej([1,0,0,0,0,0], a=1, a=100)", "syntax:a:is given twice:"},
      {"movej([1,0,0,0,0,0], 1, a=100)", "syntax:a:is given twice:"},
      {"movej(\"abc\")", "syntax:movej:has an argument of another kind:"},
      {"movej([1, 2])", "syntax:movej:has an argument of another kind:"},
      {"movel(p[1, 2, 3])", "syntax:movel:has an argument of another kind:"},
      {"sleep(\"a\")", "syntax:sleep:has an argument of another kind:"},
      {"sleep()", "syntax:sleep:lacks an argument:"},
      {"sync(1)", "syntax:sync:has too many arguments:"},
      {"y = get_forward_kin()", "syntax:get_forward_kin:lacks an argument:"},
      {"y = 1 + sin(x, 2)", "syntax:sin:has too many arguments:"},
      {"y = get_actual_tcp_pose(1)", "syntax:get_actual_tcp_pose:has too many arguments:"},
  };
  static ProgramBench bench;
  for (const Row& row : kRows) {
    const bool began = done(bench, row.line);
    if (began || !bench.said.has(row.message)) print_error("%s\n", row.line);
    assert_false(began);
    assert_true(bench.said.has(row.message));
  }
}

void arguments_that_fit_are_taken_by_name_and_position(void**) {
  static ProgramBench bench;
  for (const char* line :
       {"servoj(get_actual_joint_positions(), 0, 0, t=0.008, gain=300)", "textmsg(\"x\", x)",
        "write_output_integer_register(address=3, value=7)", "set_tool_communication(True, 1, 2)",
        "y = get_inverse_kin(get_actual_tcp_pose(), qnear=get_actual_joint_positions())",
        "movej(get_actual_joint_positions(), a=0, v=0, t=0.1, r=0)"}) {
    assert_true(done(bench, line));
    if (bench.said.has("_error")) print_error("%s\n", line);
    assert_false(bench.said.has("_error"));
  }
  assert_int_equal(bench.machine().io.output.ints[3], 7);
}

void values_out_of_range_end_the_program_before_the_motion(void**) {
  constexpr Row kRows[] = {
      {"movej([1,0,0,0,0,0], v=0)", "runtime_error:v must be above 0:"},
      {"movej([1,0,0,0,0,0], -x)", "runtime_error:a must be above 0:"},
      {"movej([1,0,0,0,0,0], t=-x)", "runtime_error:t must not be negative:"},
      {"movej([1,0,0,0,0,0], r=-x)", "runtime_error:r must not be negative:"},
      {"movel(p[-0.7,-0.2,0.5,0,3,0], v=-1)", "runtime_error:v must be above 0:"},
      {"speedj([1,0,0,0,0,0], 0, 0.1)", "runtime_error:a must be above 0:"},
      {"stopj(-1)", "runtime_error:a must be above 0:"},
  };
  static ProgramBench bench;
  const Joints q = bench.target();
  for (const Row& row : kRows) {
    assert_true(done(bench, row.line));
    if (!bench.said.has(row.message)) print_error("%s\n", row.line);
    assert_true(bench.said.has(row.message));
    assert_false(bench.running());
    assert_joints(bench.target(), q, 0.0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(arguments_that_do_not_fit_are_refused),
      cmocka_unit_test(arguments_that_fit_are_taken_by_name_and_position),
      cmocka_unit_test(values_out_of_range_end_the_program_before_the_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
