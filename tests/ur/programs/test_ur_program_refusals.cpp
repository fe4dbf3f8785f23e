// Tests that a program which the interpreter does not understand, or a call whose arguments do not
// fit, is refused as a whole, with line and name, before anything moves; and that a value that does
// not exist or is out of range ends a program before the motion.
#include "kernel/core/text.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {
namespace {

/// The message of a runtime exception: line and column as big-endian integers, then the text.
bool told(const ProgramBench& bench, int line, int column, const char* text) {
  std::array<char, 256> bytes{};
  bytes[3] = static_cast<char>(line);
  bytes[7] = static_cast<char>(column);
  const std::size_t size = std::strlen(text);
  std::memcpy(bytes.data() + 8, text, size);
  return bench.said.has({bytes.data(), 8 + size});
}

struct Row {
  const char* text;
  int line, column;
  const char* message;
};

// Each would move the arm or set an output if its known lines were run.
constexpr Row kRows[] = {
    {"def a():\n  movej([1,0,0,0,0,0])\n  b = f(1)\n  def f(x):\n    sync()\n  end\nend\n", 3, 7,
     "compile_error_not_emulated:f:"},
    {"def a():\n  set_digital_out(0, True)\n  def f():\n    sync()\n  end\n  f()\nend\n", 3, 3,
     "compile_error_not_emulated:def:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  h = run T()\n  thread T():\n    sync()\n  end\nend\n", 3,
     7, "compile_error_not_emulated:run:"},
    {"def a():\n  thread T():\n    sync()\n  end\n  h = run T()\n  movel(p[0,0,0,0,0,0])\nend\n", 2,
     3, "compile_error_not_emulated:thread:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  kill h\nend\n", 3, 3, "compile_error_not_emulated:kill:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  x = get_joint_torques()\nend\n", 3, 7,
     "compile_error_not_emulated:get_joint_torques:"},
    {"def a():\n  set_digital_out(0, True)\n  if get_flag(3):\n    sync()\n  end\nend\n", 3, 6,
     "compile_error_not_emulated:get_flag:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  x = 3 + unknown\nend\n", 3, 11,
     "compile_error_name_not_found:unknown:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  textmsg(\"a\", foo(1))\nend\n", 3, 16,
     "compile_error_name_not_found:foo:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  x = [[1, 2], [3, 4]]\nend\n", 3, 3,
     "compile_error_syntax:x = [[1, 2], [3, 4]]:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  set_payload((1, 2, 3))\nend\n", 3, 3,
     "compile_error_syntax:set_payload((1, 2, 3)):"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  track_conveyor_linear(p[1,0,0,0,0,0], 500)\nend\n", 3, 3,
     "compile_error_not_emulated:track_conveyor_linear:"},
    {"def a():\n  set_digital_out(0, True)\n  while 1 < 2\n    sync()\n  end\nend\n", 3, 3,
     "compile_error_syntax:while 1 < 2:"},
    {"sec s():\n  set_digital_out(0, True)\n  x = get_flag(1)\nend\n", 3, 7,
     "compile_error_not_emulated:get_flag:"},
};

// Each has a line that stands where it may not, or a name that is taken. The second would move the
// arm if the lines before it were run.
constexpr Row kBlocks[] = {
    {"def a():\n  if True:\n    set_digital_out(0, True)\nend\n", 1, 1,
     "compile_error_syntax:def a()::has no end:"},
    {"def a():\n  set_digital_out(0, True)\n  while True:\n    if True:\n  end\nend\n", 1, 1,
     "compile_error_syntax:def a()::has no end:"},
    {"if True:\n", 1, 1, "compile_error_syntax:if True::has no end:"},
    {"def a():\n  set_digital_out(0, True)\n  end\n  sync()\nend\n", 4, 3,
     "compile_error_syntax:sync():stands after the end of the program:"},
    {"end\n", 1, 1, "compile_error_syntax:end:ends no block:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  else:\n    sync()\n  end\nend\n", 3, 3,
     "compile_error_syntax:else::belongs to no if:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  while True:\n  else:\n  end\nend\n", 4, 3,
     "compile_error_syntax:else::belongs to no if:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  if True:\n  else:\n  else:\n  end\nend\n", 5, 3,
     "compile_error_syntax:else::stands after else:"},
    {"def a():\n  movej([1,0,0,0,0,0])\n  if True:\n  else:\n  elif True:\n  end\nend\n", 5, 3,
     "compile_error_syntax:elif True::stands after else:"},
    {"def a():\n  set_digital_out(0, True)\n  if True:\n    break\n  end\nend\n", 4, 5,
     "compile_error_syntax:break:stands outside of a loop:"},
    {"def a():\n  set_digital_out(0, True)\n  True = 5\nend\n", 3, 3,
     "compile_error_syntax:True:is a name of the language:"},
    {"def a():\n  set_digital_out(0, True)\n  global movej = 5\nend\n", 3, 10,
     "compile_error_syntax:movej:is a name of the language:"},
    {"def a():\n  set_digital_out(0, True)\n  a()\nend\n", 3, 3, "compile_error_name_not_found:a:"},
};

void assert_refused(const Row& row) {
  static ProgramBench bench;
  bench.said = {};
  const Joints q = bench.target();
  bench.upload(row.text);
  bench.run(10);
  if (!told(bench, row.line, row.column, row.message)) print_error("%s\n", row.text);
  assert_true(told(bench, row.line, row.column, row.message));
  assert_false(bench.running());
  assert_int_equal(bench.machine().io.digital_outputs, 0);
  assert_joints(bench.target(), q, 0.0);
  assert_false(bench.said.has("PROGRAM_XXX_STARTED"));
}

// Proves URP-14.

void what_is_not_understood_is_refused_before_anything_is_done(void**) {
  for (const Row& row : kRows) assert_refused(row);
}

void blocks_and_names_that_do_not_fit_are_refused(void**) {
  for (const Row& row : kBlocks) assert_refused(row);
}

/// Nests `count` branches around an output.
const char* nested(int count, Text<4095>& text) {
  text << "def deep():\n  set_digital_out(1, True)\n";
  for (int i = 0; i < count; ++i) text << "  if True:\n";
  text << "  set_digital_out(0, True)\n";
  for (int i = 0; i < count; ++i) text << "  end\n";
  text << "end\n";
  return text.c_str();
}

void nesting_is_run_or_refused_as_a_whole(void**) {
  static Text<4095> most, beyond;
  static ProgramBench bench;
  assert_refused(
      {nested(33, beyond), 35, 3, "compile_error_limit:if True::limit of 32 nested blocks:"});
  bench.upload(nested(32, most));
  bench.run(5);
  assert_int_equal(bench.machine().io.digital_outputs, 3);
}

void what_is_understood_is_not_refused(void**) {
  static ProgramBench bench;
  bench.upload(
      "def good():\n"
      "  # a comment: f(x)\n"
      "  global q = get_actual_joint_positions()\n"
      "  local pose = p[0.1, -0.2, d2r(30), 0, 0, q[5]]\n"
      "  ok = socket_open(\"127.0.0.1\", 50001, \"s\")\n"
      "  n = 0\n"
      "  while n < 3 and not False:\n"
      "    n = n + 1\n"
      "  end\n"
      "  if (n == 3):\n"
      "    digital_out[1] = True\n"
      "  elif n == 4:\n"
      "    halt\n"
      "  else:\n"
      "    textmsg(\"foo(1)\", pose)\n"
      "  end\n"
      "  set_analog_inputrange(0, 1)\n"
      "  q[0] = q[0] + norm(get_tcp_force()) * 0\n"
      "  write_output_integer_register(1, n)\n"
      "end\n");
  bench.run(5);
  assert_false(bench.said.has("compile_error"));
  assert_false(bench.said.has("runtime_error"));
  assert_int_equal(bench.machine().io.output.ints[1], 3);
  assert_int_equal(bench.machine().io.digital_outputs, 2);
}

void a_value_that_does_not_exist_ends_the_program(void**) {
  for (const char* line : {"list[7] = 1", "x = list[7]", "x = \"a\" + 1",
                           "x = get_inverse_kin(p[9,0,0,0,0,0])", "movej([1, 0, 0])"}) {
    static ProgramBench bench;
    bench.said = {};
    std::array<char, 256> text;
    std::snprintf(text.data(), text.size(),
                  "def ends():\n  list = [1, 2]\n  set_digital_out(0, False)\n  %s\n"
                  "  set_digital_out(0, True)\nend\n",
                  line);
    bench.upload(text.data());
    bench.run(5);
    assert_false(bench.running());
    assert_int_equal(bench.machine().io.digital_outputs, 0);
    assert_true(bench.said.has("runtime_error:") || bench.said.has("compile_error_syntax:"));
  }
}

void a_value_that_is_not_finite_ends_the_program(void**) {
  static ProgramBench bench;
  for (const char* value : {"1/0", "0/0", "5%0", "-zero/0", "sqrt(-1)", "pow(10, 400)", "1e308*10",
                            "1e308 + 1e308", "[1, 1/zero]", "pose_trans(far, far)"}) {
    bench.said = {};
    std::array<char, 256> text;
    std::snprintf(
        text.data(), text.size(),
        "def ends():\n  zero = 0\n  far = p[1e308,1e308,1e308,0,0,0]\n"
        "  write_output_integer_register(1, 1)\n  x = %s\n  set_digital_out(0, True)\nend\n",
        value);
    bench.upload(text.data());
    bench.run(5);
    if (!bench.said.has("runtime_error:not finite:x = ")) print_error("%s\n", value);
    assert_true(bench.said.has("runtime_error:not finite:x = "));
    assert_int_equal(bench.machine().io.output.ints[1], 1);
    assert_int_equal(bench.machine().io.digital_outputs, 0);
  }
}

void limits_of_a_line_are_named(void**) {
  constexpr Row kLimits[] = {
      {"def a():\n  set_digital_out(0, True)\n  x = [1,2,3,4,5,6,7,8,9]\nend\n", 3, 3,
       "compile_error_limit:x = [1,2,3,4,5,6,7,8,9]:limit of 8 elements:"},
      {"def a():\n  set_digital_out(0, True)\n  x = ((((((((((((((((1))))))))))))))))\nend\n", 3, 3,
       "compile_error_limit:x = ((((((((((((((((1)))))))))))))))):limit of 16 nested values:"},
      {"def a():\n  set_digital_out(0, True)\n  textmsg(1,2,3,4,5,6,7,8,9,10,11)\nend\n", 3, 3,
       "compile_error_limit:textmsg(1,2,3,4,5,6,7,8,9,10,11):limit of 10 arguments:"},
  };
  for (const Row& row : kLimits) assert_refused(row);
}

void more_variables_than_there_is_room_for_are_refused(void**) {
  static Text<4095> text("def many():\n  set_digital_out(0, True)\n");
  for (int i = 0; i < 70; ++i) text << "  v" << i << " = 1\n";
  text << "end\n";
  assert_refused({text.c_str(), 67, 3, "compile_error_limit:v64 = 1:limit of 64 variables:"});
}

struct LineRow {
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
  constexpr LineRow kLines[] = {
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
  for (const LineRow& row : kLines) {
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
  constexpr LineRow kLines[] = {
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
  for (const LineRow& row : kLines) {
    assert_true(done(bench, row.line));
    if (!bench.said.has(row.message)) print_error("%s\n", row.line);
    assert_true(bench.said.has(row.message));
    assert_false(bench.running());
    assert_joints(bench.target(), q, 0.0);
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_is_not_understood_is_refused_before_anything_is_done),
      cmocka_unit_test(blocks_and_names_that_do_not_fit_are_refused),
      cmocka_unit_test(nesting_is_run_or_refused_as_a_whole),
      cmocka_unit_test(what_is_understood_is_not_refused),
      cmocka_unit_test(a_value_that_does_not_exist_ends_the_program),
      cmocka_unit_test(a_value_that_is_not_finite_ends_the_program),
      cmocka_unit_test(limits_of_a_line_are_named),
      cmocka_unit_test(more_variables_than_there_is_room_for_are_refused),
      cmocka_unit_test(arguments_that_do_not_fit_are_refused),
      cmocka_unit_test(arguments_that_fit_are_taken_by_name_and_position),
      cmocka_unit_test(values_out_of_range_end_the_program_before_the_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
