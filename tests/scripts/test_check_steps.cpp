// Tests the steps of `make check`: each must fail on a violation, on a missing or failing tool, and
// where it has nothing to check. Each runs in a planted tree, without git.
#include <initializer_list>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// A tree without violations, and a folder of the commands that scripts/check needs. The clang
/// tools are fakes that report every file named bad or containing that word.
int plant_tree(void**) {
  return shell(
      "rm -rf $S/c && mkdir -p $S/c/bin $S/c/scripts $S/c/docs "
      "$S/c/build/fer_sim && cp scripts/check scripts/statements scripts/tidy $S/c/scripts && cp "
      ".clang-tidy $S/c && "
      "cd $S/c && "
      "for name in sh dirname grep sed tr xargs date find wc awk cat diff env; do "
      "ln -s $(command -v $name) bin; done && printf '#!/bin/sh\\n' > scripts/setup && "
      "printf '#!/bin/sh\\ncase \"$*\" in *bad*) exit 1 ;; esac\\n"
      "for f; do if [ -f \"$f\" ] && grep -q bad \"$f\"; then exit 1; fi; done\\n' | "
      "tee bin/clang-tidy > bin/clang-format && chmod +x bin/clang-* scripts/setup && "
      "printf '#!/bin/sh\\necho ports\\n' > build/fer_sim/tactus && "
      "chmod +x build/fer_sim/tactus && echo ports > docs/ports.md && "
      "for name in kernel gateway hal program sim_plant boards; do "
      "mkdir $name && touch $name/x.cpp || exit; done; mkdir kernel/core && touch "
      "kernel/core/build.hpp");
}

/// Runs a step of the planted tree's check after the command `before`.
int check(const char* step, const char* before = "true") {
  setenv("STEP", step, 1);
  return shell(
      (Line("cd $S/c && { ") << before << "; } && env PATH=$S/c/bin scripts/check $STEP").c_str());
}

// Proves CHK-3.

void a_tree_in_which_nothing_is_wrong_passes(void**) {
  assert_int_equal(check("formatted sizes lines statements tidy ports"), 0);
  for (const char* step :
       {"== formatted\n", "== sizes\n", "== statements\n", "== tidy\n", "== ports\n"})
    assert_true(has(output(), step));
}

void a_step_that_does_not_exist_is_refused(void**) {
  assert_int_equal(check("sizes size"), 2);
  assert_true(has(errors(), "check: no step is called 'size'; there are quick and formatted "));
  assert_true(output().empty());
}

void a_source_of_any_suffix_is_judged_whether_git_knows_it_or_not(void**) {
  for (const char* name : {"kernel/bad.hpp", "tests/bad.c", "bad.inl", "boards/new/bad.cpp"}) {
    setenv("NAME", name, 1);
    plant_tree(nullptr);
    const char* const plant = "mkdir -p $(dirname $NAME); seq 401 > $NAME";
    assert_true(check("formatted", plant) != 0);
    assert_true(has(errors(), "check: failed: formatted"));
    assert_int_equal(check("sizes"), 1);
    assert_true(has(errors(), (Line("401 ./") << name << "\n").c_str()));
  }
}

void long_scripts_are_found_and_what_make_writes_is_not_judged(void**) {
  for (const char* name : {"scripts/new", "tests/new.mk", "Makefile"}) {
    setenv("NAME", name, 1);
    plant_tree(nullptr);
    assert_int_equal(check("sizes", "mkdir -p tests; seq 401 > $NAME"), 1);
  }
  plant_tree(nullptr);
  assert_int_equal(check("sizes formatted", "seq 401 > build/bad.cpp"), 0);
  assert_true(check("formatted", "rm -r kernel gateway hal program sim_plant boards") != 0);
  assert_true(has(errors(), "no source below this folder"));
}

void a_long_line_of_a_page_is_found_but_not_one_of_a_table_or_of_code(void**) {
  constexpr const char* kPage =
      "long=$(seq -s o 1 60); { echo \"| $long |\"; echo '```'; echo $long; echo '```'; "
      "printf '%0140d\\n' 0 | sed 's/0/\u2192/g'; } > docs/x.md";
  assert_int_equal(check("lines", kPage), 0);
  assert_int_equal(check("lines", "printf '%0141d\\n' 0 >> docs/x.md"), 1);
  assert_true(has(errors(), "./docs/x.md:6: longer than 140 characters; break the line\n"));
}

void a_linter_that_is_missing_or_crashes_fails_with_its_reason(void**) {
  assert_true(check("tidy", "touch kernel/bad.cpp") != 0);
  assert_true(has(errors(), "kernel/bad.cpp: clang-tidy ended with 1\n"));
  assert_true(check("tidy", "rm kernel/bad.cpp; echo 'kill -SEGV $$' >> bin/clang-tidy") != 0);
  assert_true(has(errors(), "kernel/x.cpp: clang-tidy ended with 139\n"));
  assert_true(check("tidy", "rm bin/clang-tidy") != 0);
  assert_true(has(errors(), "clang-tidy is missing; scripts/setup check installs it\n"));
  plant_tree(nullptr);
  assert_true(check("tidy", "rm -r hal") != 0);
  assert_true(has(errors(), "hal"));
}

void a_linter_that_finds_something_or_has_no_rules_fails(void**) {
  if (shell("command -v clang-tidy") != 0) _skip(__FILE__, __LINE__);
  const char* const real = "ln -sf $(command -v clang-tidy) bin";
  assert_int_equal(check("tidy", real), 0);
  assert_true(check("tidy", "echo 'void f(int& a) { a = 1, ++a; }' > kernel/x.cpp") != 0);
  assert_true(has(errors(), "kernel/x.cpp:1:"));
  assert_true(has(errors(), "clang-diagnostic-comma"));
  assert_int_equal(check("tidy", ": > kernel/x.cpp"), 0);
  assert_true(check("tidy", "sed -i 's/^Checks/Chekcs/' .clang-tidy") != 0);
  assert_true(has(errors(), "unknown key 'Chekcs'"));
  assert_true(check("tidy", "rm .clang-tidy") != 0);
  assert_true(has(errors(), "No such file"));
}

void generated_documents_need_a_program_that_ends_well(void**) {
  assert_true(check("ports", "echo other > docs/ports.md") != 0);
  assert_true(has(errors(), "docs/ports.md: run make docs\n"));
  assert_true(check("ports", "echo ports > docs/ports.md; echo exit 1 >> build/fer_sim/tactus") !=
              0);
  assert_true(check("ports", ": > docs/ports.md; rm build/fer_sim/tactus") != 0);
  assert_true(has(errors(), "check: failed: ports"));
}

void a_fuzz_target_that_runs_nothing_is_a_finding(void**) {
  const char* const target =
      "cd $S/c && d=$(sed -n 's/^BUILD = .*\"\\(.*\\)\".*/\\1/p' $R/scripts/fuzz) && mkdir -p $d "
      "tests/fuzz/corpus && printf '=== one\\nx\\n' > tests/fuzz/corpus/fuzz_x.cases && "
      "printf '#!/bin/sh\\necho \"%s\" >&2\\n' \"$SAYS\" > $d/fuzz_x && chmod +x $d/fuzz_x && "
      "$R/scripts/fuzz fuzz_x";
  setenv("SAYS", "stat::number_of_executed_units: 7", 1);
  assert_succeeds(target);
  setenv("SAYS", "stat::number_of_executed_units: 0", 1);
  assert_int_equal(shell(target), 1);
  assert_true(has(output(), "nothing was run\n1 targets, 1 with findings"));
}

// Proves CHK-4.

/// The tree with one source more, whose second line is the statement.
int check_statement(const char* statement) {
  write("c/tests/y.hpp", {"int x;\n", statement});
  return check("statements");
}

void a_comma_that_joins_two_statements_is_found(void**) {
  shell("mkdir $S/c/tests");
  for (const char* statement : {
           "void f() { a = 1, b = 2; }\n",
           "void f() { if (x) return a = 1, b; }\n",
           "void f() { if (x) { g(); } else a[0] = 1, b = {1, 2}; }\n",
           "void f() { for (int i = 0; i < 3; ++i) g(), h(); }\n",
           "void f() { switch (x) { case 'a': g(), h(); } }\n",
           "auto f = [] { ++a, ++b; };\n",
           "template <class V> void f(V& visit) { visit.in(a), visit.out<A, B>(b); }\n",
           "struct A { int f() { return 1; } void g() { (void)a, (void)b; } };\n",
           "Text f() { for (;;) return text << a, text; }\n",
           "void f() { text << a, ++n; }\n",
           "void f() { m << a, b, n = 3; }\n",
           "void f() { a = x ? (g(), 1) : 2; }\n",
           "void f() { while (g(), h()) continue; }\n",
           "void f() { a = 1'0, /* ' */ b = 2; }\n",
       }) {
    if (check_statement(statement) != 1) print_error("%s", statement);
    assert_true(has(errors(), "tests/y.hpp:2: a comma joins two statements"));
  }
}

void a_comma_that_joins_no_statements_is_not_complained_of(void**) {
  shell("mkdir $S/c/tests");
  for (const char* statement : {
           "int f(int a, int b) { return g(a, b); }\n",
           "const long double a = 1, b[] = {2, 3};\nconst P<S, T>&c = a, &d = b;\n",
           "void f() { m << a, b, c; }\nvoid g() { for (; a < b; ++a, --b) h(); }\n",
           "template <class... A> void f(A... a) { (g(a), ...); }\n",
           "template <class A, class B> struct C;\nstd::array<char, 1 << 4> a;\n",
           "A::A(int a, int b) : a_(a), b_{b} {}\nstruct B : C<D, E>, F {};\n",
           "bool operator==(A a, B b) { return a < b; }\nusing F = int (*)(int, int);\n",
           "// a = 1, b = 2;\n#define X a = 1, \\\n  b = 2;\nchar c[] = \"a = 1, b = 2;\";\n",
           "char c[] = R\"(\"a = 1, b = 2;)\";\nint a = 1'000, b = 2'000;\n",
       }) {
    const int code = check_statement(statement);
    if (code != 0) print_error("%s", statement);
    assert_int_equal(code, 0);
  }
}

void sources_whose_statements_cannot_be_read_are_refused(void**) {
  const char* const step = "statements";
  assert_int_equal(check(step, "printf '// \\377\\n' > kernel/x.cpp"), 1);
  assert_true(has(errors(), "kernel/x.cpp:1: cannot be read: "));
  assert_int_equal(check(step, "rm -r kernel gateway hal program sim_plant boards"), 1);
  assert_true(has(errors(), "contains no source; run statements from the root"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_tree_in_which_nothing_is_wrong_passes, plant_tree),
      cmocka_unit_test_setup(a_step_that_does_not_exist_is_refused, plant_tree),
      cmocka_unit_test(a_source_of_any_suffix_is_judged_whether_git_knows_it_or_not),
      cmocka_unit_test(long_scripts_are_found_and_what_make_writes_is_not_judged),
      cmocka_unit_test_setup(a_long_line_of_a_page_is_found_but_not_one_of_a_table_or_of_code,
                             plant_tree),
      cmocka_unit_test_setup(a_linter_that_is_missing_or_crashes_fails_with_its_reason, plant_tree),
      cmocka_unit_test_setup(a_linter_that_finds_something_or_has_no_rules_fails, plant_tree),
      cmocka_unit_test_setup(generated_documents_need_a_program_that_ends_well, plant_tree),
      cmocka_unit_test_setup(a_fuzz_target_that_runs_nothing_is_a_finding, plant_tree),
      cmocka_unit_test_setup(a_comma_that_joins_two_statements_is_found, plant_tree),
      cmocka_unit_test_setup(a_comma_that_joins_no_statements_is_not_complained_of, plant_tree),
      cmocka_unit_test_setup(sources_whose_statements_cannot_be_read_are_refused, plant_tree),
  };
  return run_program_tests(argv[0], tests);
}
