// Tests that the report says of every folder which run it holds, and whose output.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves RUN-10, RUN-21.

/// Both have no log: the first was killed at its beginning.
void a_folder_without_a_log_is_listed_too(void**) {
  assert_int_equal(
      shell("mkdir -p $S/none/killed $S/none/refused $S/none/other && cd $S/none && "
            "echo began >killed/incomplete.txt && echo 'The run of x' >refused/refused.txt && "
            "echo text >other/notes.txt && $R/scripts/report ."),
      1);
  assert_true(has(output(), "  incomplete\nrefused"));
  assert_true(has(output(), "  refused\n\n0 of 2 runs as expected\n"));
  assert_true(has(errors(), "report: refused: refused: The run of x\n"));
}

void a_folder_without_a_summary_is_incomplete(void**) {
  assert_int_equal(
      shell("mkdir -p $S/part/out/half && cd $S/part && echo time_s >out/half/log.csv && "
            "$R/scripts/report out half"),
      1);
  assert_true(has(errors(), "report: out/half: incomplete: the run has ended without a summary"));
  assert_true(has(output(), "  incomplete\n\n0 of 1 runs as expected\n"));
}

void output_that_is_older_than_the_run_is_not_shown_as_its_own(void**) {
  const Line weak = write("weak.ini", {"[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
                                       "[pd]\ntype = pd_gravity\nq_d = robot.q\nq = robot.q\n"
                                       "dq = robot.dq\nkp = 1\nkd = 1\n"
                                       "[guard]\nmax_velocity = 1e-3\n"});
  for (const char* folder : {"old/a", "old/b"}) assert_int_equal(run_into(folder, weak.c_str()), 1);
  write("old/a/output.txt", {"of this run"});
  write("old/b/output.txt", {"of another run"});
  assert_int_equal(
      shell("touch -d '1 hour ago' $S/old/b/output.txt && $R/scripts/report --no-pictures $S/old"),
      1);
  assert_true(has(file_of("old/report.html"), "<pre>of this run</pre>"));
  assert_true(file_of("old/report.html").find("of another run") == std::string_view::npos);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_folder_without_a_log_is_listed_too),
      cmocka_unit_test(a_folder_without_a_summary_is_incomplete),
      cmocka_unit_test(output_that_is_older_than_the_run_is_not_shown_as_its_own),
  };
  return run_program_tests(argv[0], tests);
}
