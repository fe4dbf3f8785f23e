// Tests programs as text: how the text is divided, and which program runs.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

/// A text that counts in a register, to show how often it was run.
constexpr std::string_view kCounting =
    "def counting():\n"
    "  # end of nothing\n"
    "  if read_output_integer_register(3) >= 0:\n"
    "    write_output_integer_register(3, read_output_integer_register(3) + 1)\n"
    "  end\n"
    "end\n";

// Proves URP-4.

/// What comes after has its number: the value of line 9 does not exist.
void a_line_goes_on_while_its_brackets_are_open(void**) {
  static ProgramBench bench;
  bench.upload(
      "def lines():\n"
      "  q = [0, # of the shoulder ]\n"
      "       -1.25,\n"
      "    1.2, -0.1, 1.57, 0]\n"
      "  write_output_float_register(\n"
      "    2, # \"(\"\n"
      "q[\n"
      "1])\n"
      "  x = q[9]\n"
      "end\n");
  bench.run(2);
  assert_true(bench.machine().io.output.doubles[2] == -1.25);
  assert_false(bench.running());
  const std::string_view said(bench.said.bytes.data(), bench.said.size);
  const std::size_t at = said.find("runtime_error:");
  assert_true(at != std::string_view::npos && at > 8);
  assert_int_equal(said[at - 5], 9);  // before a column of four bytes
}

void a_bracket_that_nothing_closes_is_refused(void**) {
  static ProgramBench bench;
  bench.upload("def lines():\n  q = [0,\n  sync()\nend\n");
  bench.run(2);
  assert_false(bench.running());
  assert_true(bench.said.has("compile_error_syntax:"));
}

// Proves URP-1.

void a_program_is_run_wherever_its_bytes_are_cut(void**) {
  static ProgramBench bench;
  for (std::size_t cut = 0; cut <= kCounting.size(); ++cut) {
    bench.upload(kCounting.substr(0, cut));
    bench.run(1);
    bench.upload(kCounting.substr(cut));
    bench.run(2);
    assert_int_equal(bench.int_output(3), cut + 1);
  }
}

void a_program_without_its_end_is_not_run(void**) {
  static ProgramBench bench;
  bench.upload(kCounting.substr(0, kCounting.size() - 1));
  bench.run(5);
  assert_false(bench.running());
  assert_int_equal(bench.int_output(3), 0);
  bench.upload("\n");
  bench.run(2);
  assert_int_equal(bench.int_output(3), 1);
}

void a_text_longer_than_a_program_may_be_is_dropped_with_a_message(void**) {
  static ProgramBench bench;
  bench.upload("def long():\n");
  for (int i = 0; i < 12000; ++i) bench.upload("  textmsg(\"a line of a long text\")\n");
  bench.upload("end\n");
  bench.run(5);
  assert_false(bench.running());
  assert_true(bench.said.has("too long"));
  assert_false(bench.said.has("a line of a long text"));
  bench.upload(kCounting);
  bench.run(2);
  assert_int_equal(bench.int_output(3), 1);
}

void a_line_by_itself_is_a_program(void**) {
  static ProgramBench bench;
  bench.upload("set_digital_out(2, True)\n");
  bench.run(2);
  assert_int_equal(bench.machine().io.digital_outputs, 4);
  assert_int_equal(bench.said.count("PROGRAM_XXX_STARTED"), 1);
  assert_int_equal(bench.said.count("PROGRAM_XXX_STOPPED"), 1);
}

// Proves URP-2.

void a_program_replaces_the_one_that_runs(void**) {
  static ProgramBench bench;
  bench.upload("def first():\n  while True:\n    sync()\n  end\nend\n");
  bench.run(10);
  assert_true(bench.running());
  assert_true(bench.said.has("PROGRAM_XXX_STARTEDfirst"));
  bench.upload("def second():\n  sleep(0.5)\nend\n");
  bench.run(2);
  assert_true(bench.said.has("PROGRAM_XXX_STOPPEDfirst"));
  assert_true(bench.said.has("PROGRAM_XXX_STARTEDsecond"));
  assert_in_range(bench.run_to_end(), 59, 64);
  assert_true(bench.said.has("PROGRAM_XXX_STOPPEDsecond"));
}

void the_arm_decelerates_when_its_program_is_replaced(void**) {
  static ProgramBench bench;
  bench.upload(
      "def first():\n  speedj([0.5,0,0,0,0,0], 2.0)\n  while True:\n    sync()\n  end\nend\n");
  bench.run_s(1.0);
  ASSERT_NEAR(bench.image().target_qd[0], 0.5, 1e-9);
  bench.upload("def second():\n  sleep(1)\nend\n");
  double before = 0.5;
  for (int k = 0; k < 60; ++k) {
    bench.tick();
    const double now = bench.image().target_qd[0];
    assert_true(now <= before && before - now <= 4.0 * kCycle_s + 1e-9);
    before = now;
  }
  ASSERT_NEAR(before, 0.0, 1e-12);
  assert_true(bench.running());
  assert_int_equal(bench.image().safety_mode, 1);
}

void a_secondary_program_runs_beside_and_moves_nothing(void**) {
  static ProgramBench bench;
  bench.upload("def first():\n  while True:\n    sync()\n  end\nend\n");
  bench.run(5);
  const Joints q = bench.target();
  bench.upload("sec beside():\n  set_digital_out(0, True)\n  movej([1,0,0,0,0,0])\nend\n");
  bench.run(50);
  assert_true(bench.running());
  assert_int_equal(bench.machine().io.digital_outputs, 1);
  assert_joints(bench.target(), q, 0.0);
  assert_false(bench.said.has("PROGRAM_XXX_STOPPEDfirst"));
}

void of_a_longer_name_31_characters_are_told(void**) {
  static ProgramBench bench;
  for (const std::string_view text : {"def a2345678901234567890123456789012():\n  sync()\nend\n",
                                      "sec a2345678901234567890123456789012():\n  sync()\nend\n"}) {
    bench.upload(text);
    bench.run(5);
  }
  assert_int_equal(bench.said.count("PROGRAM_XXX_STARTEDa234567890123456789012345678901"), 2);
  assert_int_equal(bench.said.count("a2345678901234567890123456789012"), 0);
}

void a_stopped_program_takes_its_motion_with_it(void**) {
  static ProgramBench bench;
  bench.upload("movej([1,-1.2,1.2,-0.1,1.57,0],a=1.0,v=0.5)\n");
  bench.run(60);
  assert_true(bench.running() && bench.image().target_qd[0] > 0.3);
  bench.upload("stop program\n");
  bench.run(30);
  assert_false(bench.running());
  assert_true(bench.image().target_qd.isZero(0.0));
  assert_true(bench.target()[0] < 0.3);
}

// Proves URP-3.

void an_unknown_name_is_told_with_its_place_and_nothing_runs(void**) {
  static ProgramBench bench;
  bench.upload("def wrong():\n  foo()\n  set_digital_out(0, True)\nend\n");
  bench.run(5);
  assert_true(bench.said.has("compile_error_name_not_found:foo:"));
  constexpr char kPlace[] = "\0\0\0\2\0\0\0\3compile_error";
  assert_true(bench.said.has({kPlace, sizeof kPlace - 1}));
  assert_int_equal(bench.machine().io.digital_outputs, 0);
  assert_false(bench.said.has("PROGRAM_XXX_STARTED"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_goes_on_while_its_brackets_are_open),
      cmocka_unit_test(a_bracket_that_nothing_closes_is_refused),
      cmocka_unit_test(a_program_is_run_wherever_its_bytes_are_cut),
      cmocka_unit_test(a_program_without_its_end_is_not_run),
      cmocka_unit_test(a_text_longer_than_a_program_may_be_is_dropped_with_a_message),
      cmocka_unit_test(a_line_by_itself_is_a_program),
      cmocka_unit_test(a_program_replaces_the_one_that_runs),
      cmocka_unit_test(the_arm_decelerates_when_its_program_is_replaced),
      cmocka_unit_test(a_secondary_program_runs_beside_and_moves_nothing),
      cmocka_unit_test(of_a_longer_name_31_characters_are_told),
      cmocka_unit_test(a_stopped_program_takes_its_motion_with_it),
      cmocka_unit_test(an_unknown_name_is_told_with_its_place_and_nothing_runs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
