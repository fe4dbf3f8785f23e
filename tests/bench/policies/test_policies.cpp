// The benchmark of policies: its metrics against values known without them, its scenarios, and a
// short run of the kernel inside its bounds. Runs from the root of the project.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

void check(const char* part) {
  const int code = shell((Line("$R/tests/bench/policies/policy_checks.py ") << part).c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
}

// Proves POL-1.

void smoothness_is_that_of_known_pulses(void**) {
  check("smoothness");
}
void derivatives_are_those_of_a_sine(void**) {
  check("derivatives");
}
void standstills_are_counted_and_short_rests_are_not(void**) {
  check("standstills");
}
void a_delay_is_found_between_samples(void**) {
  check("delay");
}
void the_delay_of_other_executors_is_as_told_beforehand(void**) {
  check("executors");
}
void real_time_chunking_keeps_what_is_committed_and_lets_go_as_published(void**) {
  check("real_time_chunks");
}

// Proves POL-2.

void a_seed_gives_the_same_chunks_and_each_cause_its_own_numbers(void**) {
  check("scenarios");
}
void a_file_of_chunks_is_read_as_it_was_written(void**) {
  check("files");
}
void the_time_without_chunks_is_known(void**) {
  check("coverage");
}
void a_row_that_is_none_is_refused_by_its_line(void**) {
  write("chunks.csv", {"t_obs_ns,t_arrival_ns,chunk_id,step,t_target_ns,q,gripper\n0,0,0,0,x\n"});
  assert_int_equal(shell("$P stream $S/chunks.csv 1000 1 $S/command"), 2);
  assert_true(has(errors(), "chunks.csv:2: expected"));
}

// Proves POL-3.

void a_result_beyond_a_bound_is_named(void**) {
  check("verdicts");
}
void the_kernel_keeps_its_bounds_on_chunks_that_agree_and_that_do_not(void**) {
  const int code = shell(
      "$R/scripts/policies/bench $P --ours --duration 8 --out $S/policies --scenario agree "
      "--scenario disagree --scenario 'loss 30 %'");
  if (code != 0) print_error("%.*s\n", static_cast<int>(output().size()), output().data());
  assert_int_equal(code, 0);
  assert_true(has(output(), "delay on chunks that agree, ms"));
  assert_true(exists("policies/figure.png"));
}
void a_replay_gives_the_same_bytes_again(void**) {
  for (const char* name : {"first", "again"})
    assert_int_equal(shell((Line("$P joint $S/policies/chunks/disagree-*-joint.csv 1000 8 $S/")
                            << name << " 0.3 0.03")
                               .c_str()),
                     0);
  assert_int_equal(shell("test -s $S/first && cmp $S/first $S/again"), 0);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(smoothness_is_that_of_known_pulses),
      cmocka_unit_test(derivatives_are_those_of_a_sine),
      cmocka_unit_test(standstills_are_counted_and_short_rests_are_not),
      cmocka_unit_test(a_delay_is_found_between_samples),
      cmocka_unit_test(the_delay_of_other_executors_is_as_told_beforehand),
      cmocka_unit_test(real_time_chunking_keeps_what_is_committed_and_lets_go_as_published),
      cmocka_unit_test(a_seed_gives_the_same_chunks_and_each_cause_its_own_numbers),
      cmocka_unit_test(a_file_of_chunks_is_read_as_it_was_written),
      cmocka_unit_test(the_time_without_chunks_is_known),
      cmocka_unit_test(a_row_that_is_none_is_refused_by_its_line),
      cmocka_unit_test(a_result_beyond_a_bound_is_named),
      cmocka_unit_test(the_kernel_keeps_its_bounds_on_chunks_that_agree_and_that_do_not),
      cmocka_unit_test(a_replay_gives_the_same_bytes_again),
  };
  return run_program_tests(argv[0], tests, "policy_replay");
}
