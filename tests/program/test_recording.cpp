// Tests the recordings of runs against their logs, by a reader that follows the specification of
// MCAP (judge_recording.py), and that they give their trajectories back.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Defines record() with the options of a run into $S/o, judge(), and csv().
int recorded(const char* script) {
  Line line("export PYTHONPATH=$R/build/python; cd $S; ");
  line << "record() { $P run --no-figure --out o --record r.mcap \"$@\" >said; }; "
       << "judge() { $R/tests/program/judge_recording.py r.mcap \"$@\"; }; "
       << "csv() { /usr/bin/python3 -m tactus.recording \"$@\"; }; " << script;
  const int code = shell(line.c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  return code;
}

// Proves RUN-34.

/// Poses, wrenches, twists, joints and a flag.
void a_recording_has_the_rows_of_the_log_and_what_happened(void**) {
  assert_int_equal(recorded("record $R/pipelines/fer_trg_ac_cpc_pid.ini --duration 1.5; "
                            "test $? = 1 && judge o/log.csv"),
                   0);
  assert_has_all(output(), {" rows, 2 chunks\n", "0.000 rung 84 disabled -> arming: arm: ",
                            "0.001 report 0 started\n", "0.002 phase 0 following\n",
                            "1.500 rung 82 nominal -> stop: halt: ", " report 82 aborted\n",
                            " result 0 unfinished: the run ended at 1.5 s, "});
}

void a_run_without_a_log_is_recorded_alike(void**) {
  write("p.ini", {kPipeline});
  assert_int_equal(recorded("record p.ini --duration 0.5 && judge o/log.csv && mv r.mcap one && "
                            "record p.ini --duration 0.5 --no-log && cmp r.mcap one && "
                            "test ! -e o/log.csv"),
                   0);
  assert_has_all(output(), {"50 rows, 1 chunks\n", "0.500 result 0 succeeded\n"});
}

void a_run_in_real_time_is_recorded_while_it_runs(void**) {
  write("p.ini", {kPipeline, kBusyHost});
  assert_int_equal(recorded("record p.ini --duration 0.5 --realtime && judge o/log.csv"), 0);
  assert_true(has(output(), " result 0 succeeded\n"));
}

// Proves RUN-35.

void a_recording_that_cannot_be_written_is_named(void**) {
  write("p.ini", {kPipeline});
  assert_int_equal(recorded("ulimit -f 64; record p.ini --no-log"), 1);
  assert_true(has(errors(), "r.mcap: File too large; make room or choose another --record\n"));
  assert_true(exists("o/incomplete.txt") && !exists("o/summary.json"));
  assert_int_equal(recorded("$P run p.ini --out o --record none/r.mcap"), 2);
  assert_true(has(errors(), "none/r.mcap: No such file or directory; make room or choose another"));
  assert_int_equal(recorded("$P run p.ini --record p.ini"), 2);
  assert_true(has(errors(), "'p.ini' does not end with .mcap"));
  assert_true(has(file_of("p.ini"), kPipeline));
}

void a_run_that_is_killed_leaves_a_recording_of_whole_chunks(void**) {
  write("p.ini", {kPipeline});
  assert_int_equal(
      recorded("rm -f r.mcap; $P run p.ini --duration 1000000 --no-log --out o --record "
               "r.mcap >said 2>&1 & n=0; "
               "until test $(stat -c %s r.mcap || echo 0) -gt 100000; do n=$((n+1)); "
               "test $n -lt 600 || exit 81; sleep 0.1; done; "
               "kill -KILL $!; wait $!; csv r.mcap >r.csv && wc -l <r.csv"),
      0);
  assert_true(number_after(output(), "") > 100);
  assert_true(has(errors(), "r.mcap: was cut off; its last second may be missing"));
}

// Proves PYT-16.

void the_trajectory_of_a_recording_is_that_of_its_log(void**) {
  assert_int_equal(
      recorded("record $R/pipelines/fer_jrg_pdgc.ini --duration 2; mv r.mcap one.mcap; "
               "csv one.mcap >one.csv && mv o/log.csv log.csv && "
               "for t in one.csv log.csv; do $P run $R/pipelines/fer_jrg_pdgc.ini --no-figure "
               "--trajectory $t --out of_$t >said || exit 81; done; cmp of_*/log.csv"),
      0);
}

void a_file_that_is_no_recording_is_refused_with_what_is_missing(void**) {
  write("a.csv", {kHeader, kReady});
  assert_int_equal(recorded("csv a.csv"), 1);
  assert_true(has(errors(), "a.csv: no MCAP file; give one of tactus run --record"));
  assert_int_equal(recorded("printf '\\211MCAP0\\r\\n' >empty.mcap; csv empty.mcap"), 1);
  assert_true(has(errors(), "empty.mcap: no trajectory: it has neither outputs of a run"));
  assert_int_equal(recorded("printf '\\211MCAP0\\r\\n\\4\\21\\0\\0\\0\\0\\0\\0\\0\\1\\0\\0\\0"
                            "\\1\\0\\0\\0a\\0\\0\\0\\0\\0\\0\\0\\0' >bare.mcap; csv bare.mcap"),
                   1);
  assert_true(has(errors(), "bare.mcap: a has no schema; only protobuf is read"));
  assert_int_equal(recorded("csv none.mcap"), 1);
  assert_true(has(errors(), "none.mcap: No such file or directory; give one of tactus run"));
  assert_int_equal(
      recorded(
          "record $R/pipelines/fer_jrg_pdgc.ini --duration 1; export LC_ALL=C; "
          "sed s/protobuf/flatbuff/ r.mcap >other.mcap; csv other.mcap; test $? = 1 || exit 81; "
          "printf '\\377' | dd of=r.mcap bs=1 seek=300000 conv=notrunc; csv r.mcap"),
      1);
  assert_true(has(errors(), "tactus.Event has a schema of flatbuff; only protobuf is read"));
  assert_true(has(errors(), "r.mcap: the check sum of a chunk is wrong"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_recording_has_the_rows_of_the_log_and_what_happened),
      cmocka_unit_test(a_run_without_a_log_is_recorded_alike),
      cmocka_unit_test(a_run_in_real_time_is_recorded_while_it_runs),
      cmocka_unit_test(a_recording_that_cannot_be_written_is_named),
      cmocka_unit_test(a_run_that_is_killed_leaves_a_recording_of_whole_chunks),
      cmocka_unit_test(the_trajectory_of_a_recording_is_that_of_its_log),
      cmocka_unit_test(a_file_that_is_no_recording_is_refused_with_what_is_missing),
  };
  return run_program_tests(argv[0], tests);
}
