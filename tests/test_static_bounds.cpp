// The static bound and the memory certificate refuse what has no bound, by its place. Each planted
// source of tests/wcet/planted has one fault; the scripts are started as the Makefile does.
#include <cstdlib>

#include "tests/program_bench.hpp"

namespace tactus {
namespace {

/// Runs a command of the shell with the scratch folder as $S; the exit code.
int shell(const char* command) {
  setenv("S", scratch, 1);
  Text<4095> line("{ ");
  line << command << "; } >" << in_folder("out") << " 2>" << in_folder("err");
  return WEXITSTATUS(std::system(line.c_str()));
}

/// Builds a planted source for the Cortex-M7; without a compiler for it there is nothing to test.
void build(const char* name) {
  if (shell("command -v arm-none-eabi-g++ glpsol") != 0) _skip(__FILE__, __LINE__);
  setenv("NAME", name, 1);
  setenv("M7", "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -O3 -g", 1);
  const int code = shell(
      "mkdir -p $S/$NAME && arm-none-eabi-g++ $M7 -std=c++17 -I. -DNDEBUG -fstack-usage "
      "-fcallgraph-info=su -c tests/wcet/planted/$NAME.cpp -o $S/$NAME/planted.o && "
      "arm-none-eabi-g++ $M7 -nostdlib -nostartfiles -Wl,--entry=planted "
      "-Wl,--unresolved-symbols=ignore-all -o $S/$NAME/planted.elf $S/$NAME/planted.o");
  assert_int_equal(code, 0);
}

int bound(const char* name) {
  build(name);
  return shell("scripts/wcet_bound $S/$NAME/planted.elf --function '^planted$' --dof 7");
}

int certificate(const char* name) {
  build(name);
  return shell(
      "scripts/certificate $NAME --callgraph $S/$NAME --roots planted --stack-budget 2048");
}

// Proves BND-1.

void a_loop_that_says_how_often_it_runs_is_bounded(void**) {
  assert_int_equal(bound("fine"), 0);
  assert_true(has(output(), "\nplanted "));
}

// Proves BND-2.

void a_loop_without_a_bound_is_refused_by_its_place(void**) {
  assert_int_equal(bound("loop"), 1);
  assert_true(has(errors(), "planted: tests/wcet/planted/loop.cpp:5: a loop without a bound: "));
}

void a_loop_that_is_entered_at_several_places_is_refused(void**) {
  assert_int_equal(bound("jump"), 1);
  assert_true(has(errors(), "planted: a loop that is entered at several places: "));
  assert_true(has(errors(), "tests/wcet/planted/jump.cpp:"));
}

void recursion_is_refused_by_its_way(void**) {
  assert_int_equal(bound("recursion"), 1);
  assert_true(has(errors(), "recursion: planted > other(double, int) > planted"));
  assert_true(has(errors(), "tests/wcet/planted/recursion.cpp:6"));
}

void a_call_through_a_pointer_needs_targets(void**) {
  assert_int_equal(bound("pointer"), 1);
  assert_true(has(errors(), "without targets, at tests/wcet/planted/pointer.cpp:4"));
}

// Proves BND-3.

void an_address_outside_the_graph_is_named(void**) {
  build("fine");
  shell("arm-none-eabi-nm $S/fine/planted.elf | awk '$3 == \"planted\" {print $1}' > $S/cover");
  const char* const command =
      "scripts/wcet_bound $S/fine/planted.elf --function '^planted$' --dof 7 --cover $S/cover";
  assert_int_equal(shell(command), 0);
  assert_int_equal(shell("sed -i 's/.$/1/' $S/cover"), 0);  // the middle of an instruction
  assert_int_equal(shell(command), 1);
  assert_true(has(errors(), "executed, but not in the graph: tests/wcet/planted/fine.cpp:"));
}

// Proves MEM-2.

void recursion_has_no_worst_stack(void**) {
  assert_int_equal(certificate("recursion"), 1);
  assert_true(has(errors(), "recursion: double planted(double, int) (tests/wcet/planted/recurs"));
}

void a_pointer_without_targets_has_no_worst_stack(void**) {
  assert_int_equal(certificate("pointer"), 1);
  assert_true(has(errors(), "tests/wcet/planted/pointer.cpp:4:"));
  assert_true(has(errors(), "a call through a pointer, without targets"));
}

void a_frame_of_four_kilobytes_is_over_the_budget(void**) {
  assert_int_equal(certificate("stack"), 1);
  assert_true(has(errors(), "planted: 4096 bytes of stack, the budget is 2048; "));
  assert_true(has(errors(), "(tests/wcet/planted/stack.cpp:7:"));
}

// Proves MEM-1.

void a_call_of_the_heap_is_refused_by_its_place(void**) {
  assert_int_equal(certificate("heap"), 1);
  assert_true(has(errors(), "tests/wcet/planted/heap.cpp:4:"));
  assert_true(has(errors(), " calls operator new[](unsigned int)\n"));
}

// Proves MEM-3.

void static_bytes_over_the_budget_are_refused(void**) {
  build("fine");
  const char* const command =
      "scripts/certificate fine --callgraph $S/fine --image $S/fine/planted.elf --tools "
      "arm-none-eabi- --roots planted --static-budget ";
  assert_int_equal(shell((Text<1023>(command) << "0").c_str()), 0);
  assert_int_equal(shell((Text<1023>(command) << "-1").c_str()), 1);
  assert_true(has(errors(), "0 static bytes, the budget is -1"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_loop_that_says_how_often_it_runs_is_bounded),
      cmocka_unit_test(a_loop_without_a_bound_is_refused_by_its_place),
      cmocka_unit_test(a_loop_that_is_entered_at_several_places_is_refused),
      cmocka_unit_test(recursion_is_refused_by_its_way),
      cmocka_unit_test(a_call_through_a_pointer_needs_targets),
      cmocka_unit_test(an_address_outside_the_graph_is_named),
      cmocka_unit_test(recursion_has_no_worst_stack),
      cmocka_unit_test(a_pointer_without_targets_has_no_worst_stack),
      cmocka_unit_test(a_frame_of_four_kilobytes_is_over_the_budget),
      cmocka_unit_test(a_call_of_the_heap_is_refused_by_its_place),
      cmocka_unit_test(static_bytes_over_the_budget_are_refused),
  };
  return run_program_tests(argv[0], tests);
}
