// Tests rtde_set_watchdog: an input that is late, and the action that the program asked for.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr char kC207[] = {0, 0, 0, '\xcf', 0, 0, 0, 0};  // code 207, argument 0

void start(ProgramBench& bench, const char* arguments) {
  std::array<char, 512> text;
  const int size = std::snprintf(text.data(), text.size(),
                                 "def watched():\n  rtde_set_watchdog(%s)\n"
                                 "  while True:\n    sync()\n  end\nend\n",
                                 arguments);
  bench.upload({text.data(), static_cast<std::size_t>(size)});
  bench.run(2);
  assert_true(bench.running());
}

/// A client writes the register in this cycle.
void kick(ProgramBench& bench) {
  const InputField field = find_input("input_int_register_24", bench.machine().settings.version);
  bench.machine().io.written[field.variable()] = bench.machine().cycle;
}

// Proves URP-13.

void a_kick_in_time_keeps_the_program(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_24\", 10, \"stop\"");
  for (int k = 0; k < 250; ++k) {
    if (k % 12 == 0) kick(bench);
    bench.tick();
    assert_true(bench.running());
  }
  // 0.1 s is twelve cycles and a half.
  kick(bench);
  bench.run(12);
  assert_int_equal(bench.image().safety_mode, 1);
  bench.run(2);
  assert_int_equal(bench.image().safety_mode, 3);
  assert_false(bench.running());
  assert_true(bench.said.has({kC207, sizeof kC207}));
}

void pause_is_what_is_done_without_a_word(void**) {
  for (const char* arguments :
       {"\"input_int_register_24\", 10", "\"input_int_register_24\", 10, action=\"pause\""}) {
    static ProgramBench bench;
    bench.said.size = 0;
    start(bench, arguments);
    bench.run(30);
    assert_true(bench.image().program_paused && !bench.image().program_running);
    assert_int_equal(bench.image().safety_mode, 1);
    assert_int_equal(bench.said.count({kC207, sizeof kC207}), 1);
    // Resumed, it runs until the input has arrived and is late again.
    bench.controller.runner().resume();
    bench.run(30);
    assert_true(bench.running());
    kick(bench);
    bench.run(5);
    assert_true(bench.running());
    bench.run(30);
    assert_true(bench.image().program_paused);
    bench.upload("stop program\n");
    bench.run(2);
  }
}

void a_pause_brakes_the_arm_and_no_more(void**) {
  static ProgramBench bench;
  bench.upload(
      "def moves():\n  rtde_set_watchdog(\"input_int_register_24\", 2, \"pause\")\n"
      "  movej([1.0,-1.2,1.2,-0.1,1.57,0])\nend\n");
  bench.run_s(1.0);
  assert_true(bench.image().program_paused);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
  assert_true(bench.target()[0] > 0.05 && bench.target()[0] < 0.9);
}

void to_ignore_is_to_do_nothing(void**) {
  for (const char* arguments :
       {"\"input_int_register_24\", 10, \"ignore\"", "\"input_int_register_24\", 0, \"stop\""}) {
    static ProgramBench bench;
    start(bench, arguments);
    bench.run(100);
    assert_true(bench.running());
    assert_false(bench.said.has({kC207, sizeof kC207}));
  }
}

void it_ends_with_the_program(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_24\", 10, \"stop\"");
  bench.upload("def other():\n  while True:\n    sync()\n  end\nend\n");
  bench.run(100);
  assert_true(bench.running());
}

void an_input_that_does_not_exist_is_said(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_99\", 10, \"stop\"");
  bench.run(50);
  assert_true(bench.running());
  assert_true(bench.said.has("rtde_set_watchdog: there is no such input"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_kick_in_time_keeps_the_program),
      cmocka_unit_test(pause_is_what_is_done_without_a_word),
      cmocka_unit_test(a_pause_brakes_the_arm_and_no_more),
      cmocka_unit_test(to_ignore_is_to_do_nothing),
      cmocka_unit_test(it_ends_with_the_program),
      cmocka_unit_test(an_input_that_does_not_exist_is_said),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
