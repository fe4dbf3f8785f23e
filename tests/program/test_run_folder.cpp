// Tests that the files of two runs cannot be mixed up, whatever ends a run.
#include <sys/stat.h>

#include <csignal>
#include <ctime>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kResults[] = {"log.csv", "summary.json", "scene.json", "pipeline.ini",
                                    "waypoints.csv"};

Line pipeline() {
  return write("p.ini", {kPipeline});
}

bool has_results(const char* folder) {
  for (const char* name : kResults)
    if (!exists((Line(folder) << "/" << name).c_str())) return false;
  return true;
}

/// A run with waypoints, a figure of it, and a file of the user.
void run_before(const char* folder) {
  const Line trajectory = write("t.csv", {kHeader, kReady});
  assert_int_equal(run_into(folder, pipeline().c_str(), "1", trajectory.c_str(), "0.2"), 0);
  write((Line(folder) << "/figure.png").c_str(), {"of the run before"});
  write((Line(folder) << "/notes.txt").c_str(), {"of the user"});
  assert_true(has_results(folder));
}

/// Starts a run without an end and waits until its log has rows.
pid_t endless_run(const char* folder) {
  const Line out = in_folder(folder), log = Line(folder) << "/log.csv";
  const Line begun = Line(folder) << "/incomplete.txt";
  std::remove(in_folder(begun.c_str()).c_str());  // of a run before
  const pid_t child = spawn(
      {"run", pipeline().c_str(), "--duration", "1000000", "--no-figure", "--out", out.c_str()});
  for (int i = 0; i < 60'000 && !(exists(begun.c_str()) && file_of(log.c_str()).size() > 10'000);
       ++i) {
    const timespec millisecond = {0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  return child;
}

// Proves RUN-10, RUN-21.

void a_run_that_is_killed_is_incomplete_and_the_run_before_it_is_set_aside_whole(void**) {
  run_before("k");
  const pid_t child = endless_run("k");
  assert_int_equal(kill(child, SIGKILL), 0);
  assert_int_equal(exit_code(child), -SIGKILL);
  assert_true(exists("k/log.csv") && exists("k/pipeline.ini"));
  for (const char* name : {"k/summary.json", "k/waypoints.csv", "k/figure.png"})
    assert_false(exists(name));
  assert_true(has(file_of("k/incomplete.txt"), "p.ini of "));
  assert_true(has(file_of("k/incomplete.txt"), "has not ended, or was killed.\n"));
  assert_true(has(file_of("k/incomplete.txt"), "is in earlier_run/.\n"));
  assert_true(has_results("k/earlier_run"));
  assert_true(file_of("k/earlier_run/figure.png") == "of the run before");
  assert_int_equal(shell("$R/scripts/report $S k"), 1);
  assert_true(has(errors(), "/k: incomplete: the run has ended without a summary.json"));
}

void the_next_run_removes_what_a_killed_one_left_and_at_its_end_the_run_set_aside(void**) {
  run_before("n");
  for (int i = 0; i < 2; ++i) {  // the second does not take the first for a run that has ended
    const pid_t child = endless_run("n");
    assert_int_equal(kill(child, SIGKILL), 0);
    exit_code(child);
    assert_true(has_results("n/earlier_run"));
  }
  assert_int_equal(run_into("n", pipeline().c_str()), 0);
  assert_true(exists("n/summary.json") && exists("n/log.csv"));
  for (const char* name :
       {"n/incomplete.txt", "n/waypoints.csv", "n/figure.png", "n/earlier_run", "n/refused.txt"})
    assert_false(exists(name));
  assert_true(file_of("n/notes.txt") == "of the user");
}

void a_refused_run_sets_the_run_before_it_aside_and_says_so(void**) {
  run_before("r");
  const Line bad = write("bad.ini", {kPipeline, "[pd]\n"}), bad_csv = write("bad.csv", {"x\n"});
  assert_int_equal(run_into("r", bad.c_str()), 2);
  assert_true(has(errors(), "/r: the run before this one is now in "));
  assert_false(exists("r/summary.json") || exists("r/log.csv") || exists("r/figure.png"));
  assert_true(has(file_of("r/refused.txt"), "bad.ini of "));
  assert_true(has(file_of("r/refused.txt"), "was refused before its first cycle.\n"));
  assert_true(has_results("r/earlier_run"));
  assert_true(file_of("r/notes.txt") == "of the user");
  assert_int_equal(shell("$R/scripts/report $S r"), 1);
  assert_true(has(errors(), "/r: refused: The run of "));
  assert_int_equal(run_into("r", pipeline().c_str(), "1", bad_csv.c_str()), 2);
  assert_true(has_results("r/earlier_run"));
  assert_int_equal(run_into("r", pipeline().c_str()), 0);
  assert_false(exists("r/refused.txt") || exists("r/earlier_run"));
}

void a_run_refused_by_the_robot_keeps_the_run_before_it(void**) {
  run_before("x");
  const Line far = write("far.ini", {kWithoutGenerator, "[plant]\ninitial_q = 1\n"});
  assert_int_equal(run_into("x", far.c_str()), 2);
  assert_true(has(file_of("x/summary.json"), "\"cycles\": 0,"));
  assert_true(has_results("x/earlier_run"));
}

void a_refused_run_leaves_a_folder_alone_into_which_another_one_writes(void**) {
  const pid_t child = endless_run("w");
  const Line bad = write("bad.ini", {kPipeline, "[pd]\n"});
  assert_int_equal(run_into("w", bad.c_str()), 2);
  assert_true(exists("w/log.csv") && !exists("w/refused.txt"));
  assert_int_equal(kill(child, SIGTERM), 0);
  assert_int_equal(exit_code(child), 1);
}

// Proves RUN-10.

void a_folder_may_be_a_link_the_present_one_or_in_a_parent_that_cannot_be_written(void**) {
  pipeline();
  assert_succeeds(
      "run() { $P run $S/p.ini --duration 0.05 --no-figure --out \"$@\" >$S/said || exit; }\n"
      "cd $S && mkdir -p real ro/out here && ln -sfn real link && chmod a-w ro && "
      "run link && run link && test -L link && test -f real/summary.json && "
      "run ro/out && run ro/out && test -f ro/out/summary.json && "
      "cd here && run . && run . && test -f summary.json && ! test -e earlier_run");
}

void the_inputs_of_a_run_are_not_taken_for_results(void**) {
  run_before("i");
  assert_succeeds(
      "cd $S/i && $P run pipeline.ini "
      "--duration 0.05 --no-figure --out . && cmp pipeline.ini ../p.ini");
  assert_succeeds(
      "cd $S/i && echo '[typing error' >>pipeline.ini && "
      "! $P run pipeline.ini --out . && grep -q typing pipeline.ini && "
      "test -f earlier_run/summary.json");
  run_before("i");
  assert_int_equal(shell("sed 's/jrg[.]q_d_/q/g; 1s/\\(q[1-7]\\)/\\1_rad/g' $S/i/waypoints.csv "
                         ">$S/w.csv && mv $S/w.csv $S/i/waypoints.csv && $P run $S/p.ini "
                         "--no-figure --trajectory $S/i/waypoints.csv --out $S/i"),
                   2);
  assert_true(has(errors(),
                  "/i/waypoints.csv: the run would replace this file, which it reads; choose "
                  "another --out\n"));
  assert_true(has_results("i"));
}

void files_that_no_run_has_written_are_not_replaced(void**) {
  pipeline();
  for (const char* name : {"waypoints.csv", "log.csv", "figure.pdf", "pipeline.ini"}) {
    Line make("rm -rf $S/own; mkdir $S/own && echo mine >$S/own/"), look("cd $S/own && grep mine ");
    make << name << " && $P run $S/p.ini --duration 0.05 --out $S/own";
    assert_int_equal(shell(make.c_str()), 2);
    assert_true(has(errors(), Line(name) << ": the run would replace this file, which no run has "
                                            "written; choose another --out\n"));
    look << name << " && test $(ls | wc -l) = 1";
    assert_succeeds(look.c_str());
  }
}

void a_run_does_not_remove_what_it_reads(void**) {
  run_before("e");
  assert_int_equal(shell("mkdir $S/e/earlier_run && mv $S/e/pipeline.ini $S/e/earlier_run && "
                         "$P run $S/e/earlier_run/pipeline.ini --out $S/e"),
                   2);
  assert_true(has(errors(), "which it reads; choose another --out\n"));
  assert_succeeds("test -s $S/e/earlier_run/pipeline.ini && test -s $S/e/summary.json");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_run_that_is_killed_is_incomplete_and_the_run_before_it_is_set_aside_whole),
      cmocka_unit_test(
          the_next_run_removes_what_a_killed_one_left_and_at_its_end_the_run_set_aside),
      cmocka_unit_test(a_refused_run_sets_the_run_before_it_aside_and_says_so),
      cmocka_unit_test(a_run_refused_by_the_robot_keeps_the_run_before_it),
      cmocka_unit_test(a_refused_run_leaves_a_folder_alone_into_which_another_one_writes),
      cmocka_unit_test(
          a_folder_may_be_a_link_the_present_one_or_in_a_parent_that_cannot_be_written),
      cmocka_unit_test(the_inputs_of_a_run_are_not_taken_for_results),
      cmocka_unit_test(files_that_no_run_has_written_are_not_replaced),
      cmocka_unit_test(a_run_does_not_remove_what_it_reads),
  };
  return run_program_tests(argv[0], tests);
}
