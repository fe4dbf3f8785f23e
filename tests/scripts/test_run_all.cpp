// Tests what `make run` repeats and what it refuses to begin.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// A tree in the scratch folder with two pipelines, one with a trajectory, and a pipeline that
/// fails.
int plant(void**) {
  shell("mkdir -p $S/t/pipelines/trajectories && cp $P $S/t/tactus");
  write("t/pipelines/one.ini", {kPipeline, "[gateway]\ntrajectory = trajectories/t.csv  # its\n"});
  write("t/pipelines/two.ini", {kPipeline});
  write("t/pipelines/weak.ini", {kPipeline, "[guard]\nmax_velocity = 1e-3\n"});
  for (const char* name : {"t/pipelines/trajectories/t.csv", "t/pipelines/trajectories/u.csv"})
    write(name, {kHeader, kReady});
  return 0;
}

/// Runs one, two and two:u with a copy of the program, which finds no script that draws figures.
int run_all(const char* options) {
  Line line("cd $S/t && $R/scripts/run_all --no-pictures ");
  return shell((line << options << " -- ./tactus one two two:u").c_str());
}

/// Whether exactly these of the three are said to be unchanged.
bool unchanged(bool one, bool two, bool two_u) {
  const auto said = [](const char* line) { return output().find(line) != std::string_view::npos; };
  return said("  RUN   one: unchanged, run of ") == one &&
         said("  RUN   two: unchanged, run of ") == two &&
         said("  RUN   two:u: unchanged, run of ") == two_u &&
         has(output(), "\n3 of 3 runs as expected\n");
}

// Proves RUN-11.

void only_what_has_changed_is_run_again(void**) {
  assert_int_equal(run_all(""), 0);
  assert_true(unchanged(false, false, false));
  assert_int_equal(run_all(""), 0);
  assert_true(unchanged(true, true, true));
  const char* changes[] = {"echo '# x' >>pipelines/two.ini",
                           "echo '# x' >>pipelines/trajectories/t.csv",
                           "echo '# x' >>pipelines/trajectories/u.csv", "rm out/two/log.csv",
                           "printf ' ' >>out/one/summary.json"};
  const bool repeated[][3] = {{false, true, true},
                              {true, false, false},
                              {false, false, true},
                              {false, true, false},
                              {true, false, false}};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Line line("cd $S/t && ");
    assert_succeeds((line << changes[i]).c_str());
    assert_int_equal(run_all(""), 0);
    assert_true(unchanged(!repeated[i][0], !repeated[i][1], !repeated[i][2]));
  }
  assert_succeeds("printf x >>$S/t/tactus");
  assert_int_equal(run_all(""), 0);
  assert_true(unchanged(false, false, false));
  assert_int_equal(run_all("--always"), 0);
  assert_true(unchanged(false, false, false));
}

void a_script_is_repeated_when_a_program_it_names_has_changed(void**) {
  assert_succeeds(
      "mkdir -p $S/t/build/b && cp $S/t/tactus $S/t/build/b/tactus && "
      "printf '#!/bin/sh\\nexec build/b/tactus \"$@\"\\n' >$S/t/beside && chmod "
      "+x $S/t/beside");
  constexpr const char* kRun = "cd $S/t && $R/scripts/run_all --no-pictures -- ./beside two";
  assert_succeeds(kRun);
  assert_succeeds(kRun);
  assert_true(has(output(), "  RUN   two: unchanged, run of "));
  assert_succeeds("printf x >>$S/t/build/b/tactus");
  assert_succeeds(kRun);
  assert_true(has(output(), "  RUN   two: succeeded\n"));
}

void a_run_that_was_not_as_expected_is_always_repeated(void**) {
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(shell("cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus weak"), 1);
    assert_true(has(output(), "  RUN   weak: measured velocity limit (68)\n"));
  }
}

void the_last_good_run_is_kept_when_the_next_is_refused(void**) {
  assert_int_equal(run_all("--always"), 0);
  assert_succeeds(
      "cd $S/t && cp pipelines/one.ini one.ini && echo '[typing error' "
      ">>pipelines/one.ini");
  assert_int_equal(run_all("--only one"), 1);
  assert_true(has(output(), "  RUN   one: refused"));
  assert_succeeds(
      "cd $S/t && mv one.ini pipelines/one.ini; test -f out/one/refused.txt && "
      "test -f out/one/earlier_run/summary.json && ! test -e "
      "out/one/summary.json");
}

// Proves RUN-28.

void a_run_that_this_computer_cannot_do_is_named_counted_and_no_success(void**) {
  write("t/skips", {"#!/bin/sh\necho 'this needs a machine' >&2\nexit 77\n"});
  assert_int_equal(shell("cd $S/t && chmod +x skips && rm -rf out && "
                         "$R/scripts/run_all --no-pictures -- ./tactus one -- ./skips two"),
                   1);
  assert_true(has(output(), "  RUN   two: SKIPPED\n"));
  assert_true(has(errors(), "this needs a machine\n"));
  assert_true(has(output(), "  skipped\n\n1 of 2 runs as expected, 1 skipped\n"));
  assert_true(has(errors(), "report: out/two: skipped: this needs a machine\n"));
  assert_true(has(file_of("t/out/report.html"), "1 of 2 runs as expected, 1 skipped"));
  assert_true(has(file_of("t/out/report.html"), "No real robot moved: 1 run of a robot arm"));
  assert_int_equal(
      shell(
          "cd $S/t && $R/scripts/run_all --no-pictures --only two -- ./tactus one -- ./skips two"),
      1);
  assert_succeeds(
      "cd $S/t && $R/scripts/run_all --no-pictures --only one -- ./tactus one -- ./skips two");
  assert_true(has(output(), "\n1 of 1 runs as expected\n"));
}

/// Its results are set aside, so that nobody takes them for this run's.
void a_skipped_run_shows_no_earlier_run_and_is_forgotten_when_it_is_possible(void**) {
  assert_succeeds("cd $S/t && rm -rf out && $R/scripts/run_all --no-pictures -- ./tactus two");
  assert_int_equal(shell("cd $S/t && $R/scripts/run_all --no-pictures --always -- ./skips two"), 1);
  assert_true(has(output(), "\n0 of 1 runs as expected, 1 skipped\n"));
  assert_succeeds(
      "cd $S/t/out/two && test -f earlier_run/summary.json && ! test -e "
      "summary.json && grep -q 'needs a machine' output.txt");
  assert_succeeds(
      "cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus two && ! test -e "
      "out/two/skipped.txt");
  assert_true(has(output(), "\n1 of 1 runs as expected\n"));
}

// Proves RUN-11.

/// Whatever its summary says.
void a_program_that_fails_after_its_summary_has_not_succeeded(void**) {
  for (const char* end : {"exit 1", "exit 77", "kill -SEGV $$"}) {
    write("t/late", {"#!/bin/sh\n./tactus \"$@\"\n", end, "\n"});
    assert_int_equal(shell("cd $S/t && chmod +x late && rm -rf out && "
                           "$R/scripts/run_all --no-pictures -- ./late one"),
                     1);
    assert_succeeds("cd $S/t/out/one && ! test -e stamp.json && ! test -e summary.json");
  }
}

void a_program_that_does_not_start_shows_no_earlier_run(void**) {
  assert_int_equal(run_all("--always"), 0);
  assert_succeeds("cd $S/t && mv tactus away; mkdir tactus");
  assert_int_equal(run_all("--only one"), 1);
  assert_succeeds(
      "cd $S/t && rmdir tactus && mv away tactus && ! test -e "
      "out/one/summary.json && test -f out/one/earlier_run/summary.json");
}

void the_runs_that_are_named_are_run_and_the_report_has_all_there_are(void**) {
  assert_int_equal(run_all(""), 0);
  assert_succeeds("rm -r $S/t/out/one");
  assert_int_equal(run_all("--always --only 'two:u'"), 0);
  assert_true(has(output(), "  RUN   two:u: succeeded\n"));
  assert_true(output().find("  RUN   two: ") == std::string_view::npos);
  assert_true(has(output(), "\n2 of 2 runs as expected\n"));  // two is there, one is not
  assert_int_equal(run_all("--only 'one, two'"), 0);
  assert_true(unchanged(false, true, false));
  assert_int_equal(run_all("--only three"), 1);
  assert_true(has(errors(), "run_all: there is no run 'three'; there are one, two, two:u\n"));
}

// Proves RUN-12.

void runs_that_would_write_into_one_folder_or_into_none_are_refused(void**) {
  assert_int_equal(
      shell("cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus a:b -- ./other a_b"), 1);
  assert_true(has(errors(), "run_all: a:b and a_b would both be written to out/a_b; rename a "));
  write("t/summary.json", {"not of a run"});
  for (const char* name : {"..", ".", "''", "../t/pipelines/one", "one:", "one:../t"}) {
    Line line("cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus ");
    assert_int_equal(shell((line << name).c_str()), 1);
    assert_true(has(errors(), "' is not the name of a pipeline, or of pipeline:trajectory; "));
  }
  assert_true(exists("t/summary.json"));
}

void a_pipeline_whose_name_gives_no_folder_is_refused(void**) {
  for (const char* name : {"t/.ini", "t/..ini", "t/...ini"}) {
    const Line path = write(name, {kPipeline});
    assert_int_equal(tactus_run({"run", path.c_str(), "--duration", "0.05", "--no-figure"}), 2);
    assert_true(has(errors(),
                    "ini: refused: its name gives no folder for the results; rename it, "
                    "or give --out\n"));
    assert_int_equal(run_into("named", path.c_str()), 0);
  }
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(only_what_has_changed_is_run_again),
      cmocka_unit_test(a_script_is_repeated_when_a_program_it_names_has_changed),
      cmocka_unit_test(a_run_that_was_not_as_expected_is_always_repeated),
      cmocka_unit_test(the_last_good_run_is_kept_when_the_next_is_refused),
      cmocka_unit_test(a_run_that_this_computer_cannot_do_is_named_counted_and_no_success),
      cmocka_unit_test(a_skipped_run_shows_no_earlier_run_and_is_forgotten_when_it_is_possible),
      cmocka_unit_test(a_program_that_fails_after_its_summary_has_not_succeeded),
      cmocka_unit_test(a_program_that_does_not_start_shows_no_earlier_run),
      cmocka_unit_test(the_runs_that_are_named_are_run_and_the_report_has_all_there_are),
      cmocka_unit_test(runs_that_would_write_into_one_folder_or_into_none_are_refused),
      cmocka_unit_test(a_pipeline_whose_name_gives_no_folder_is_refused),
  };
  if (!find_program(argv[0], "tactus")) return 1;
  return cmocka_run_group_tests(tests, plant, remove_folder);
}
