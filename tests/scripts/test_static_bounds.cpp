// Tests that the static bound and the memory certificate refuse code without a bound and name its
// place. Each source of tests/wcet/planted has one fault; the scripts are started as by the
// Makefile.
#include "tests/scripts/planted_bench.hpp"

namespace tactus {
namespace {

int certificate(const char* name) {
  build(name);
  return shell("scripts/certificate $NAME --objects $S/$NAME --roots planted --stack-budget 2048");
}

// Proves BND-1.

void a_loop_that_says_how_often_it_runs_is_bounded(void**) {
  assert_int_equal(bound("fine"), 0);
  assert_true(has(output(), "\nplanted "));
}

void a_loop_whose_body_may_return_runs_as_often_as_it_says_and_no_more(void**) {
  assert_int_equal(bound("returns"), 0);
  assert_in_range(instructions(), 10'000, 10'999);
}

void a_loop_counted_by_an_address_runs_as_often_as_that_moves(void**) {
  assert_int_equal(bound("moves"), 0);
  assert_in_range(instructions(), 3'000, 3'999);
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
  assert_true(has(errors(), "without known targets at tests/wcet/planted/pointer.cpp:4"));
}

// Proves BND-3.

void an_address_outside_the_graph_is_named(void**) {
  build("fine");
  shell("arm-none-eabi-nm $S/fine/planted.elf | awk '$3 == \"planted\" {print $1}' > $S/cover");
  const char* const command =
      "scripts/wcet_bound $S/fine/planted.elf --function '^planted$' --dof 7 --cover $S/cover";
  assert_succeeds(command);
  assert_succeeds("sed -i 's/.$/1/' $S/cover");  // the middle of an instruction
  assert_int_equal(shell(command), 1);
  assert_true(has(errors(), "executed, but not in the graph: tests/wcet/planted/fine.cpp:"));
  assert_succeeds("echo ffff > $S/cover");
  assert_int_equal(shell(command), 1);
  assert_true(
      has(errors(), "/cover: no address is in a function of the cycle; was the cycle executed?"));
}

// Proves MEM-2.

void recursion_has_no_worst_stack(void**) {
  assert_int_equal(certificate("recursion"), 1);
  assert_true(has(errors(), "recursion: double planted(double, int) (tests/wcet/planted/recurs"));
}

void a_pointer_without_targets_has_no_worst_stack(void**) {
  assert_int_equal(certificate("pointer"), 1);
  assert_true(has(errors(), "tests/wcet/planted/pointer.cpp:4:"));
  assert_true(has(errors(), "a call through a pointer without known targets"));
}

void a_frame_of_four_kilobytes_is_over_the_budget(void**) {
  assert_int_equal(certificate("stack"), 1);
  assert_true(has(errors(), "planted: 4096 bytes of stack exceed the budget of 2048; "));
  assert_true(has(errors(), "(tests/wcet/planted/stack.cpp:7:"));
}

void a_stack_that_was_not_painted_is_no_certificate(void**) {
  build("fine");
  const char* const command =
      "scripts/certificate fine --objects $S/fine --roots planted --painted ";
  assert_int_equal(shell((Text<1023>(command) << "/bin/true").c_str()), 1);
  assert_true(has(errors(), "/bin/true painted no stack; "));
}

// Proves MEM-1.

void a_call_of_the_heap_is_refused_by_its_place(void**) {
  assert_int_equal(certificate("heap"), 1);
  assert_true(has(errors(), "tests/wcet/planted/heap.cpp:4:"));
  assert_true(has(errors(), " calls operator new[](unsigned int)\n"));
}

// Proves MEM-3.

void ram_and_flash_over_the_budget_are_refused(void**) {
  build("fine");
  const char* const command =
      "scripts/certificate fine --objects $S/fine --image $S/fine/planted.elf --tools "
      "arm-none-eabi- --roots planted ";
  assert_succeeds((Text<1023>(command) << "--static-budget 0").c_str());
  assert_int_equal(shell((Text<1023>(command) << "--static-budget -1").c_str()), 1);
  assert_true(has(errors(), "0 bytes of RAM exceed the budget of -1"));
  assert_succeeds((Text<1023>(command) << "--flash-budget 65536").c_str());
  assert_int_equal(shell((Text<1023>(command) << "--flash-budget 16").c_str()), 1);
  assert_true(has(errors(), " bytes of flash exceed the budget of 16"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_loop_that_says_how_often_it_runs_is_bounded),
      cmocka_unit_test(a_loop_whose_body_may_return_runs_as_often_as_it_says_and_no_more),
      cmocka_unit_test(a_loop_counted_by_an_address_runs_as_often_as_that_moves),
      cmocka_unit_test(a_loop_without_a_bound_is_refused_by_its_place),
      cmocka_unit_test(a_loop_that_is_entered_at_several_places_is_refused),
      cmocka_unit_test(recursion_is_refused_by_its_way),
      cmocka_unit_test(a_call_through_a_pointer_needs_targets),
      cmocka_unit_test(an_address_outside_the_graph_is_named),
      cmocka_unit_test(recursion_has_no_worst_stack),
      cmocka_unit_test(a_pointer_without_targets_has_no_worst_stack),
      cmocka_unit_test(a_frame_of_four_kilobytes_is_over_the_budget),
      cmocka_unit_test(a_stack_that_was_not_painted_is_no_certificate),
      cmocka_unit_test(a_call_of_the_heap_is_refused_by_its_place),
      cmocka_unit_test(ram_and_flash_over_the_budget_are_refused),
  };
  return run_program_tests(argv[0], tests);
}
