// Tests that the checks of the tests, and `make test` itself, can fail: each gets a planted
// violation. They are started as a user starts them.
#include <initializer_list>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// The output of scripts/requirements for one requirement, A-1, and one test file: the text
/// `above`, a test `proving` that proves it, and the list of the tests that are run.
int requirements(const char* above, const char* run, const char* rows = "") {
  shell("mkdir -p $S/r/docs $S/r/tests");
  write("r/docs/requirements.md",
        {"| number | requirement |\n|---|---|\n| **Part** | |\n| A-1 | x |\n", rows});
  write("r/tests/test_x.cpp", {above, "\n// Proves A-1.\n\nvoid proving(void**) {}\n", run});
  return shell("scripts/requirements $S/r");
}

/// A program of three tests; the environment decides the result of the last one.
int plant_program(void**) {
  write("x.cpp", {"#include <csignal>\n#include <cstdlib>\n#include \"tests/support/testing.hpp\"\n"
                  "void passes(void**) {}\n"
                  "void may_skip(void**) { if (std::getenv(\"SKIP\")) _skip(\"\", 1); }\n"
                  "void may_fail(void**) {\n"
                  "  if (std::getenv(\"FAIL\")) assert_true(false);\n"
                  "  if (std::getenv(\"LEAVE\")) std::exit(0);\n"
                  "  if (std::getenv(\"KILL\")) std::raise(SIGKILL);\n"
                  "}\n"
                  "int main() {\n"
                  "  const CMUnitTest tests[] = {cmocka_unit_test(passes),\n"
                  "    cmocka_unit_test(may_skip), cmocka_unit_test(may_fail)};\n"
                  "  cmocka_set_test_filter(std::getenv(\"ONLY\"));\n"
                  "  return cmocka_run_group_tests(tests, nullptr, nullptr);\n"
                  "}\n"});
  return shell("g++ -std=c++17 -I. -o $S/x $S/x.cpp -lcmocka");
}

/// A tree with the Makefile and scripts/run_tests, two boards that run the program above, and one
/// board without tests.
int plant_boards(void**) {
  return shell(
      "mkdir -p $S/m/tests/oracles/fcl $S/m/tests/core $S/m/scripts $S/m/build && "
      "cp --parents Makefile $(sed -n 's/^include \\([^$]*\\.mk\\)$/\\1/p' Makefile) "
      "scripts/run_tests scripts/times kernel/core/build.hpp kernel/core/precompiled.hpp "
      "tests/support/testing.hpp gateway/tactus.proto gateway/tactus.options $S/m && "
      "cp $S/x.cpp $S/m/tests/core/test_x.cpp && cd $S/m && "
      "for board in none one two; do mkdir -p boards/$board && "
      "echo 'int main() {}' > boards/$board/main.cpp && "
      "printf 'ROBOT := Fer\\nSRCS := boards/%s/main.cpp\\nTESTS := tests/core/test_x.cpp\\n' "
      "$board "
      "> boards/$board/board.mk; done && sed -i 's,tests/core.*,,' boards/none/board.mk && "
      "printf '#!/bin/sh\\n' | tee scripts/setup > scripts/excitation && chmod +x scripts/* && "
      "touch tests/oracles/fcl/fcl.cpp tests/oracles/fcl/fcl.hpp build/libfcl_oracle.so");
}

/// Runs `make` with the settings those boards need, separate from the variables of the make that
/// runs this test; output() is its last line.
int make(const char* arguments, const char* environment = "X=1") {
  setenv("WITH", arguments, 1);
  setenv("WAY", environment, 1);
  return shell(
      "(cd $S/m && env -i PATH=\"$PATH\" $WAY make BOARD=one SHARED= TESTLIBS=-lcmocka $WITH) > "
      "$S/made; "
      "code=$?; tail -n 1 $S/made; (exit $code)");
}

// Proves CHK-1.

void a_test_is_seen_however_it_is_registered(void**) {
  for (const char* run : {
           "cmocka_unit_test(proving), cmocka_unit_test(\n    other)",
           "cmocka_unit_test(proving), cmocka_unit_test_setup(\n    other, begin)",
           "cmocka_unit_test(proving), cmocka_unit_test_setup_teardown(other, begin, end)",
           "cmocka_unit_test(proving), cmocka_unit_test_prestate(\n    other, &state)",
       })
    for (const char* other :
         {"void other(void**) {}\n", "static void other(void** state) {\n}\n"}) {
      assert_int_equal(requirements(other, run), 1);
      assert_true(has(errors(), "test_x.cpp: other names no requirement\n"));
    }
}

void a_test_that_is_never_run_is_named(void**) {
  const char* const other = "// Proves A-1.\nvoid other(void**) {}\n";
  for (const char* run :
       {"cmocka_unit_test(proving)", "cmocka_unit_test(proving)  // cmocka_unit_test(other)",
        "/* cmocka_unit_test(other) */ cmocka_unit_test(proving)",
        "cmocka_unit_test(proving) \"cmocka_unit_test(other)\""}) {
    assert_int_equal(requirements(other, run), 1);
    assert_true(has(errors(), "test_x.cpp: other is never run; register it with cmocka_unit_test"));
  }
}

void a_test_a_row_and_a_line_that_cannot_be_read_are_refused(void**) {
  const char* const run = "cmocka_unit_test(proving)";
  assert_int_equal(requirements("void other(void* state[]) {}", "cmocka_unit_test(other)"), 1);
  assert_true(has(errors(), "other is run, but not found; define it as void other(void**)"));
  assert_int_equal(requirements("// Proves A-1 and A-1", run), 1);
  assert_true(
      has(errors(), "// Proves A-1 and A-1: cannot be read; write // Proves CFG-1, CFG-2."));
  assert_int_equal(requirements("// Proves A-2.\n", run), 1);
  assert_true(has(errors(), "A-2 is not a requirement"));
  assert_int_equal(requirements("", run, "|A-2| y |\n"), 1);
  assert_true(has(errors(), "|A-2| y |: not a row; write | CFG-1 | text |"));
  assert_int_equal(requirements("", run, "| A-1 | y |\n"), 1);
  assert_true(has(errors(), "A-1 is given twice"));
  assert_int_equal(requirements("", run, "| A-2 | y |\n"), 1);
  assert_true(has(errors(), "A-2 has no test"));
  assert_int_equal(requirements("", ""), 1);
  assert_true(has(errors(), "test_x.cpp: no test"));
}

void what_only_looks_like_a_test_is_not_complained_of(void**) {
  const char* const above = "// void other(void**) {}\nconst char* x = \"void other(void**) {\";\n";
  assert_int_equal(requirements(above, "cmocka_unit_test(\n    proving)"), 0);
}

// Proves CHK-2.

void programs_and_tests_are_counted_and_what_is_skipped_is_named(void**) {
  assert_succeeds("SKIP=1 scripts/run_tests $S/x $S/x");
  assert_true(has(output(), "/x: 2 tests passed, 1 skipped: may_skip\n"));
  assert_true(
      has(output(), "\nprograms: 2 passed, 0 failed; tests: 4 passed, 0 failed, 2 skipped\n"));
}

void a_program_that_fails_in_any_way_is_told_with_all_that_it_said(void**) {
  const char* ways[][2] = {{"FAIL=1", ": exit code 1; 2 tests passed\n"},
                           {"LEAVE=1", ": a test has no result; 2 tests passed\n"},
                           {"KILL=1", ": ended by signal 9, Killed; 2 tests passed\n"},
                           {"ONLY=none", ": no test was run; 0 tests passed\n"}};
  for (const auto& [way, why] : ways) {
    setenv("WAY", way, 1);
    assert_int_equal(shell("env $WAY scripts/run_tests $S/x"), 1);
    assert_true(has(output(), "[==========] Running "));
    assert_true(has(output(), why));
    assert_true(has(output(), "\nprograms: 0 passed, 1 failed; tests: "));
  }
}

void a_program_that_is_missing_and_no_program_at_all_fail(void**) {
  assert_int_equal(shell("scripts/run_tests $S/x $S/missing"), 1);
  assert_true(has(output(), "/missing: No such file or directory\n"));
  assert_true(
      has(output(), "\nprograms: 1 passed, 1 failed; tests: 3 passed, 0 failed, 0 skipped\n"));
  assert_int_equal(shell("scripts/run_tests"), 1);
  assert_true(has(errors(), "run_tests: no test program; name at least one"));
}

/// On one processor; a program that is in no row comes first, then what took longest.
void the_longest_begins_first_and_the_times_of_the_last_run_are_kept(void**) {
  assert_succeeds(
      "mkdir -p $S/w/build && cd $S/w && for p in a b c d; do ln -sf ../x $p; done && printf "
      "'unit,a,7.5\ntest,./a,1.500,1,1\ntest,./b,2.5,1.0,1.0\nsmall\n' "
      ">build/times.csv && printf 'test,./c,10.000,1.000,0.250\ntest,./a,3.5,1.0,1.0\n' "
      ">>build/times.csv && taskset -c $(($(nproc) - 1)) $R/scripts/run_tests ./a ./b ./c ./d "
      "$S/x | grep -o '/[a-d]: 3' | tr -d '\n'");
  assert_true(output() == "/d: 3/c: 3/a: 3/b: 3");
  const std::string_view times = file_of("w/build/times.csv");
  assert_true(has(times, "unit,a,7.5\nsmall\ntest,./a,"));
  for (const char* program : {"./a", "./b", "./c", "./d"})
    assert_succeeds((Line("test 1 = $(grep -cE '^test,")
                     << program << "(,[0-9]+[.][0-9]{3}){3}$' $S/w/build/times.csv)")
                        .c_str());
  assert_true(times.find(scratch) == std::string_view::npos);
}

/// Only a child of the program computes, for a moment.
void the_processor_time_of_a_program_includes_that_of_its_children(void**) {
  write("w/busy", {"#!/bin/sh\nwork() { i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done; }\n",
                   "(work)\necho '[==========] Running 1 test'\n", "echo '[       OK ] x'\n"});
  assert_succeeds("cd $S/w && chmod +x busy && $R/scripts/run_tests ./busy");
  assert_succeeds("grep '^test,./busy,' $S/w/build/times.csv");
  double wall_s = 0.0, user_s = 0.0, sys_s = 0.0;
  assert_int_equal(
      std::sscanf(Line(output()).c_str(), "test,./busy,%lf,%lf,%lf", &wall_s, &user_s, &sys_s), 3);
  assert_true(user_s + sys_s > 0.03);  // the program alone takes 0.003 s
}

void make_test_ends_with_one_line_of_totals_over_all_boards(void**) {
  assert_int_equal(make("test"), 0);
  assert_true(output() == "programs: 2 passed, 0 failed; tests: 6 passed, 0 failed, 0 skipped\n");
  assert_succeeds("grep programs: $S/made | wc -l");
  assert_true(output() == "1\n");
  assert_int_equal(make("BOARD=none tests"), 0);
  assert_true(output().find("programs:") == std::string_view::npos);
}

void make_test_fails_if_a_test_of_any_board_fails_and_runs_the_others(void**) {
  assert_int_equal(make("test", "FAIL=1"), 2);
  assert_true(
      has(output(), "programs: 0 passed, 2 failed; tests: 4 passed, 2 failed, 0 skipped\n"));
  assert_succeeds("sed -i 's/test_x/test_y/' $S/m/boards/one/board.mk");
  assert_int_equal(make("test"), 2);
  assert_true(has(errors(), "test_y"));
  assert_int_equal(make("test BOARDS=none"), 2);
  assert_true(has(errors(), "run_tests: no test program"));
  assert_int_equal(make("test ONLY=core,nonsense"), 2);
  assert_true(has(errors(), "ONLY: there is no folder tests/nonsense; name folders of tests/"));
  assert_int_equal(make("BOARD=none tests/core"), 2);
  assert_true(has(errors(), "tests/core: none has no tests there"));
  make("-pn BOARD=one");
  assert_succeeds("grep -qx '.DEFAULT_GOAL := all' $S/made");
  assert_int_equal(make("test BOARDS="), 2);
  assert_true(has(errors(), "BOARDS is empty"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_test_is_seen_however_it_is_registered),
      cmocka_unit_test(a_test_that_is_never_run_is_named),
      cmocka_unit_test(a_test_a_row_and_a_line_that_cannot_be_read_are_refused),
      cmocka_unit_test(what_only_looks_like_a_test_is_not_complained_of),
      cmocka_unit_test_setup(programs_and_tests_are_counted_and_what_is_skipped_is_named,
                             plant_program),
      cmocka_unit_test(a_program_that_fails_in_any_way_is_told_with_all_that_it_said),
      cmocka_unit_test(a_program_that_is_missing_and_no_program_at_all_fail),
      cmocka_unit_test(the_longest_begins_first_and_the_times_of_the_last_run_are_kept),
      cmocka_unit_test(the_processor_time_of_a_program_includes_that_of_its_children),
      cmocka_unit_test_setup(make_test_ends_with_one_line_of_totals_over_all_boards, plant_boards),
      cmocka_unit_test(make_test_fails_if_a_test_of_any_board_fails_and_runs_the_others),
  };
  return run_program_tests(argv[0], tests);
}
