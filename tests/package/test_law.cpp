// Laws in C that see nothing of Tactus but tactus_law.h, linked into a board: the one of the
// examples gives the bits of ours, and those that break the rules stop nothing but themselves.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Compiles the laws in a folder that has nothing but them and the header, and links the board.
int link_laws(void**) {
  assert_succeeds(
      "cp kernel/core/tactus_law.h examples/law/pd_law.c tests/package/laws.c $S && cd $S && "
      "gcc -std=c99 -O2 -Wall -Wextra -Wpedantic -Werror -I. -c pd_law.c laws.c && cd $R && "
      "laws=pd_law=$S/pd_law.o; for law in good_law nan_law status_law jump_law other_version "
      "twin_outputs unknown_quantity large_state slow_law; do laws=\"$laws $law=$S/laws.o\"; done; "
      "make -s BOARD=fer_sim LAWS=\"$laws\" build/fer_sim-laws/tactus && "
      "realpath build/fer_sim-laws/tactus >$S/path");
  return 0;
}

/// Runs a pipeline whose block [own] is one of the laws; the exit code.
int run_law(const char* type, const char* command = "tau_c = own.tau", const char* keys = "",
            const char* q_d = "q_d = jrg.q_d\n") {
  write("own.ini", {"[robot]\nname = fer\nperiod_us = 1000\n", command,
                    "\n[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
                    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n[own]\ntype = ",
                    type, "\ng = model.g\n", q_d, keys});
  return shell(
      "rm -rf $S/own; $(cat $S/path) run $S/own.ini --duration 0.1 --no-figure --out $S/own");
}

void is_refused(int code, const char* reason) {
  assert_int_equal(code, 2);
  assert_true(has(errors(), reason));
}

// Proves KER-8.

/// 22 000 cycles of an excitation trajectory: commands, states and references in every digit.
void the_law_of_the_example_gives_the_bits_of_ours(void**) {
  assert_succeeds(
      "for law in pd_gravity pd_law; do "
      "sed \"s/= pd_gravity/= $law/; s,= [.][.]/build,= $R/build,\" pipelines/fer_jrg_pdgc.ini "
      ">$S/same.ini; $(cat $S/path) run $S/same.ini --no-figure --out $S/$law || exit; done; "
      "test $(wc -l <$S/pd_law/log.csv) = 22001 && cmp $S/pd_gravity/log.csv $S/pd_law/log.csv");
}

void its_ports_are_printed_and_checked_as_those_of_ours(void**) {
  assert_succeeds("$(cat $S/path) ports");
  assert_has_all(output(),
                 {"## type = pd_law\n", "| `kp` | number per joint | N m/rad | required |",
                  "| `q_d` | input: joint position | rad | required | |",
                  "| `g` | input: joint effort | N m | neutral | |",
                  "| `tau` | output: joint effort | N m |  | |",
                  "| `gain` | number | 1/s | 1 | in [0, 10] |"});
  assert_int_equal(run_law("good_law"), 0);
  is_refused(run_law("good_law", "tau_c = own.tau", "gain = 11\n"),
             "own.ini:16: [own] gain: 11 1/s is out of range; it must be in [0, 10]\n");
  is_refused(run_law("good_law", "tau_c = own.tau", "gian = 1\n"),
             "[own] gian: the section has no such key; it has type, gain, g, q_d\n");
  is_refused(run_law("good_law", "tau_c = own.tau", "", ""),
             "[own] q_d: the input is not connected; it takes a joint position\n");
  is_refused(run_law("good_law", "tau_c = own.tau", "", "q_d = model.g\n"),
             "model.g is a joint effort, but the input takes a joint position; wire one\n");
}

/// Who links a law may have its symbols judged as those of the kernel, which it becomes part of.
void its_object_is_judged_with_the_kernel(void**) {
  assert_succeeds("scripts/no_heap build/fer_sim-laws/libkernel.a");
  write("heap.c", {"#include <stdlib.h>\nvoid* heap(void) { return malloc(8); }\n"});
  assert_true(shell("gcc -c $S/heap.c -o $S/heap.o && cp build/fer_sim-laws/libkernel.a $S/k.a && "
                    "ar r $S/k.a $S/heap.o && scripts/no_heap $S/k.a") != 0);
  assert_true(has(errors(), "  malloc\n"));
}

// Proves KER-9.

void a_law_that_describes_itself_wrongly_is_refused_at_load(void**) {
  is_refused(run_law("other_version"),
             "own.ini:13: [own] type: the law has version 7 of tactus_law.h, the board version 1; "
             "compile the law with the header of the board\n");
  is_refused(run_law("twin_outputs"),
             "[own] type: output 2 of the law has the name 'tau', which is taken; rename it\n");
  is_refused(run_law("unknown_quantity"),
             "[own] type: port 'q_c' of the law has quantity 99; it must be one of tactus_law.h");
  is_refused(run_law("large_state"), " bytes; of the board's 65536 for blocks ");
  is_refused(run_law("slow_law"),
             "[executive] budget_us: 500 us; the laws of LAWS alone state 501 us for a cycle; "
             "raise the budget, or the period\n");
  assert_int_equal(run_law("slow_law", "tau_c = own.tau", "[executive]\nbudget_us = 600\n"), 0);
  is_refused(run_law("good_law", "tau_c = own.tau",
                     "[too]\ntype = good_law\ng = own.tau\nq_d = own.q_c\n"),
             "state 600 us for a cycle");
}

/// A torque cannot be braked without its law: the drives are disabled in the same cycle.
void a_law_of_torques_that_fails_disables_the_drives(void**) {
  assert_int_equal(run_law("nan_law"), 1);
  assert_true(has(output(), "0.019 s: nominal -> disabled: stage: command not finite (66)\n"));
  assert_true(has(errors(), "own.ini: stopped: command not finite (66): block [own]\n"));
  assert_int_equal(run_law("status_law"), 1);
  assert_true(has(output(), "0.019 s: nominal -> disabled: stage: a value is malformed"));
  assert_true(has(errors(), "own.ini: stopped: a value is malformed or out of range (3): block"));
}

/// Positions can: the guard brakes and holds the arm, and every cycle is in the log.
void a_law_of_positions_that_fails_is_braked_by_the_guard(void**) {
  for (const char* law : {"nan_law", "status_law"}) {
    assert_int_equal(run_law(law, "q_c = own.q_c"), 1);
    assert_has_all(output(), {"0.019 s: nominal -> stop: stage: ",
                              "0.119 s: stop -> disabled: at_rest", "119 cycles, 0 slips"});
    assert_succeeds("test $(wc -l <$S/own/log.csv) = 120");
  }
}

void the_guard_limits_a_torque_that_jumps(void**) {
  assert_int_equal(run_law("jump_law"), 0);
  assert_true(number_after(output(), "rung nominal, ") >= 1.0);
}

void a_name_of_ours_and_a_word_without_an_object_are_refused_by_the_build(void**) {
  assert_true(shell("make -s BOARD=fer_sim LAWS=pd_law build/x") != 0);
  assert_true(has(errors(), "LAWS: 'pd_law' is not NAME=OBJECT"));
  write("laws.hpp", {"#include \"kernel/control/c_law.hpp\"\nextern \"C\" const tactus_law pid;\n"
                     "namespace tactus { inline constexpr char pid_word[] = \"pid\"; }\n"
                     "#define TACTUS_LAW_KINDS , CLaw<::pid, pid_word>\n"});
  assert_true(shell("g++ -std=c++17 -fsyntax-only -DEIGEN_DONT_VECTORIZE -DTACTUS_ROBOT=Fer "
                    "-DTACTUS_ROBOT_TABLES='\"kernel/robots/fer_capsules.hpp\"' "
                    "-DTACTUS_LAWS=\"\\\"$S/laws.hpp\\\"\" -include kernel/core/build.hpp -I. "
                    "-isystem /usr/include/eigen3 kernel/pipeline/pipeline_tuning.cpp") != 0);
  assert_true(has(errors(), "two kinds have the same word"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(the_law_of_the_example_gives_the_bits_of_ours, link_laws),
      cmocka_unit_test(its_ports_are_printed_and_checked_as_those_of_ours),
      cmocka_unit_test(its_object_is_judged_with_the_kernel),
      cmocka_unit_test(a_law_that_describes_itself_wrongly_is_refused_at_load),
      cmocka_unit_test(a_law_of_torques_that_fails_disables_the_drives),
      cmocka_unit_test(a_law_of_positions_that_fails_is_braked_by_the_guard),
      cmocka_unit_test(the_guard_limits_a_torque_that_jumps),
      cmocka_unit_test(a_name_of_ours_and_a_word_without_an_object_are_refused_by_the_build),
  };
  return run_program_tests(argv[0], tests);
}
