// Tests the option --set, which gives keys of the pipeline file on the command line: a run with it
// is the run of the edited file, and what is refused is refused with the same words.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves RUN-32.

void a_run_with_overrides_is_that_of_the_edited_file(void**) {
  write("a.ini", {kPipeline});
  assert_succeeds(
      "cd $S; sed 's/^kp = .*/kp = 600 400 400 300 20 20 10/; s/^kd = .*/kd = 40/' a.ini >b.ini; "
      "run=\"$P run --duration 0.05 --no-figure --seed 3\"; "
      "$run a.ini --out a --set 'pd.kp=600 400 400 300 20 20 10' --set 'pd . kd = 40' && "
      "$run b.ini --out b && cmp a/log.csv b/log.csv && grep -q '^kd = 40$' a/pipeline.ini && "
      "$run a/pipeline.ini --out c && cmp a/log.csv c/log.csv && ! cmp -s a.ini a/pipeline.ini && "
      "$run a.ini --out d && ! cmp -s a/log.csv d/log.csv");
  assert_has_all(file_of("a/summary.json"),
                 {"\"overrides\": [\"pd.kp=600 400 400 300 20 20 10\", \"pd . kd = 40\"],"});
  assert_has_all(file_of("d/summary.json"), {"\"overrides\": [],"});
}

void keys_and_sections_that_the_file_does_not_have_are_added(void**) {
  write("a.ini", {kPipeline});
  assert_succeeds(
      "cd $S; $P run a.ini --out e --duration 0.05 --no-figure --set plant.delay_cycles=2 "
      "--set guard.position_margin=0.02 --set guard.max_stretch=3 --set plant.delay_cycles=3 && "
      "grep -q '^delay_cycles = 3$' e/pipeline.ini && ! grep -q 'delay_cycles = 2' e/pipeline.ini "
      "&& "
      "sed -n '/^.guard.$/,$p' e/pipeline.ini | tr '\\n' ' ' | "
      "grep -q '^.guard. max_stretch = 3 position_margin = 0.02'");
}

/// Each mistake in the file, and as an override: the words behind the place are the same.
void a_mistake_is_refused_with_the_option_and_the_words_of_the_file(void**) {
  write("a.ini", {kPipeline});
  assert_succeeds(
      "cd $S; try() { ! $P check a.ini --set \"$1.$2=$3\" 2>said || return 1; "
      "sed \"$4\" a.ini >c.ini; ! $P check c.ini 2>expected || return 1; "
      "sed -i \"s/^--set $1.$2=$3: //\" said; sed -i 's/^c.ini:[0-9]*: //' expected; "
      "cmp said expected; }; "
      "try pd kp banana 's/^kp = .*/kp = banana/' && "
      "try pd kp -1 's/^kp = .*/kp = -1/' && "
      "try pd kp '1 2' 's/^kp = .*/kp = 1 2/' && "
      "try pd q_d robot.dq 's/^q_d = .*/q_d = robot.dq/' && "
      "try pd kpp 3 's/^kd = .*/&\\nkpp = 3/' && "
      "try robot period_us 1 's/^period_us = .*/period_us = 1/' && "
      "try nothing key 3 '$ a [nothing]\\nkey = 3' && "
      "try plant seed 7 's/^position_noise_rad.*/&\\nseed = 7/'");
}

void a_mistake_of_the_file_keeps_its_line(void**) {
  write("d.ini", {kPipeline, "offset = x\n"});
  assert_int_equal(shell("cd $S; $P check d.ini"), 2);
  const std::string expected(errors());
  assert_int_equal(shell("cd $S; $P check d.ini --set plant.delay_cycles=1 --set jrg.exact=yes "
                         "--set guard.max_stretch=3"),
                   2);
  assert_true(has(errors(), "--set jrg.exact=yes: [jrg] exact: "));
  assert_int_equal(
      shell("cd $S; $P check d.ini --set plant.delay_cycles=1 --set robot.period_us=2000 "
            "--set pd.kp=3 --set guard.max_stretch=3"),
      2);
  assert_true(errors() == expected);
}

void what_is_no_assignment_is_refused(void**) {
  for (const char* text : {"pd.kp", "kp=3", "=", "", "a.b=1\n[c]", "pd.#kp=3", "[pd.kp=3"}) {
    assert_int_equal(tactus_run({"check", "a.ini", "--set", text}), 2);
    assert_true(has(errors(), "--set: '"));
    assert_true(has(errors(), "' is not section.key=value"));
  }
  assert_int_equal(shell("$P check a.ini $(for i in $(seq 33); do echo --set pd.kp=$i; done)"), 2);
  assert_true(has(errors(), "--set is given 33 times, at most 32"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_run_with_overrides_is_that_of_the_edited_file),
      cmocka_unit_test(keys_and_sections_that_the_file_does_not_have_are_added),
      cmocka_unit_test(a_mistake_is_refused_with_the_option_and_the_words_of_the_file),
      cmocka_unit_test(a_mistake_of_the_file_keeps_its_line),
      cmocka_unit_test(what_is_no_assignment_is_refused),
  };
  return run_program_tests(argv[0], tests);
}
