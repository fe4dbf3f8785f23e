// How often a loop runs is read from the image; what its header says is not believed. Each planted
// function runs more often than it seems to, and is bounded rightly or refused by its place.
#include "tests/scripts/planted_bench.hpp"

namespace tactus {
namespace {

struct Bounded {
  const char* function;
  int least, most;  ///< instructions; the first is a count by hand
};
struct Refused {
  const char *function, *why;
};

/// Bounds a function of $NAME; the exit code.
int bound_of(const char* function) {
  setenv("FUNCTION", function, 1);
  return shell("scripts/wcet_bound $S/$NAME/planted.elf --function ^$FUNCTION'$' --dof 7");
}

void expect_bounded(const Bounded& each) {
  print_message("%s\n", each.function);
  assert_int_equal(bound_of(each.function), 0);
  assert_in_range(instructions(each.function), each.least, each.most);
}

void expect_refused(const Refused& each) {
  print_message("%s\n", each.function);
  assert_int_equal(bound_of(each.function), 1);
  assert_true(has(errors(), each.why));
}

// Proves BND-5.

void a_counter_of_the_image_is_believed_not_the_header(void**) {
  build("turns");
  for (const Bounded& each : {Bounded{"shadowed_constant", 5000, 5300},
                              {"downward", 4000, 4200},
                              {"by_lambda", 2000, 2100},
                              {"floating", 1000, 1100},
                              {"interchanged", 30 * 70 * 4, 30 * 70 * 6}})
    expect_bounded(each);
}

void a_loop_whose_counter_is_changed_otherwise_is_refused(void**) {
  build("turns");
  for (const Refused& each :
       {Refused{"second_change", "(int i = 0; i < kFew; ++i): it has no counter"},
        {"changed_by_reference", "(int i = 0; i < kFew; ++i): it has no counter"},
        {"changed_by_pointer", "(chosen = 0; chosen < kFew; ++chosen): it has no counter"},
        {"changed_by_lambda", "(i = 0; i < kFew; ++i): it has no counter"},
        {"continued", "(int i = 0; i < kFew; ++i): it has no counter"},
        {"moving_end", "i < end; ++i): it has no counter"},
        {"narrow", "(std::uint8_t i = 0; i < end; ++i): it has no counter"},
        {"steps_of_three", "i != 0; i = static_cast<std::uint8_t>(i + 3)): it has no counter"},
        {"wraps", "(unsigned i = 3; i >= 0U; --i): it has no counter"},
        {"in_a_comment", "(*x > 0): it has no counter and no LoopBound"},
        {"until", "(*x > 0): it has no counter and no LoopBound"}})
    expect_refused(each);
}

void two_loops_on_a_line_are_refused(void**) {
  build("turns");
  expect_refused({"two_on_a_line", ": 2 loops begin on this line; give each its own\n"});
}

// Proves BND-6.

void a_loop_bound_that_may_not_hold_is_refused(void**) {
  build("turns");
  for (const Refused& each : {Refused{"ticks_at_times", "its tick() is not first in its body"},
                              {"ticks_in_an_inner_loop", "its tick() is not first in its body"},
                              {"another_bound_of_that_name", "its tick() is not first in its body"},
                              {"two_bounds_in_sight", "2 declarations of turns in sight"},
                              {"bound_that_wraps", "a part of it is -2"},
                              {"bound_of_a_template", "kFew is declared 3 times"}})
    expect_refused(each);
}

void lines_that_a_preprocessor_moves_are_refused(void**) {
  build("lines");
  expect_refused({"planted", "lines.cpp:7: # 12: lines do not tell which loop they belong to"});
  build("macro");
  expect_refused({"planted", "macro.cpp:4: a loop made by the preprocessor"});
}

void code_whose_equal_functions_may_be_merged_is_refused(void**) {
  build("fine", "");
  assert_int_equal(shell("scripts/wcet_bound $S/fine/planted.elf --function planted --dof 7"), 1);
  assert_true(has(errors(), "compile tests/wcet/planted/fine.cpp with -fno-ipa-icf"));
}

// Proves BND-7.

void a_copy_counts_by_its_size(void**) {
  build("copies");
  for (const Bounded& each : {Bounded{"copy_of_an_object", 3200, 3300}, {"zeros", 2400, 2500}})
    expect_bounded(each);
  for (const Refused& each :
       {Refused{"copy_of_any_size", "memcpy of an unknown size at tests/wcet/planted/copies.cpp:"},
        {"copy_of_two_sizes", "memcpy of an unknown size at tests/wcet/planted/copies.cpp:"},
        {"move", "memmove: boards/bare_metal/memory.cpp:"}})
    expect_refused(each);
}

void all_cases_of_a_jump_table_are_seen(void**) {
  build("copies");
  expect_bounded({"cases", 103, 110});
  expect_refused({"jump", "without known targets at tests/wcet/planted/copies.cpp:"});
}

// Proves BND-8.

void a_fact_that_the_image_does_not_need_is_refused_by_its_line(void**) {
  build("fine");
  const char* const command =
      "scripts/wcet_bound $S/fine/planted.elf --function planted --dof 7 --facts $S/facts";
  shell("echo 'loop  planted  i < count  5' > $S/facts");
  assert_succeeds(command);
  shell("echo 'targets  planted  visit\\(  ^visitor$' >> $S/facts");
  assert_int_equal(shell(command), 1);
  assert_true(has(errors(), "facts that the image does not need; delete them:"));
  assert_true(has(errors(), "/facts:2: targets planted visit\\( ^visitor$\n"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_counter_of_the_image_is_believed_not_the_header),
      cmocka_unit_test(a_loop_whose_counter_is_changed_otherwise_is_refused),
      cmocka_unit_test(two_loops_on_a_line_are_refused),
      cmocka_unit_test(a_loop_bound_that_may_not_hold_is_refused),
      cmocka_unit_test(lines_that_a_preprocessor_moves_are_refused),
      cmocka_unit_test(code_whose_equal_functions_may_be_merged_is_refused),
      cmocka_unit_test(a_copy_counts_by_its_size),
      cmocka_unit_test(all_cases_of_a_jump_table_are_seen),
      cmocka_unit_test(a_fact_that_the_image_does_not_need_is_refused_by_its_line),
  };
  return run_program_tests(argv[0], tests);
}
