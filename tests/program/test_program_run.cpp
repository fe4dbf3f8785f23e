// Tests a run of the program: the files it leaves, and how it ends.
#include <dirent.h>
#include <sys/stat.h>

#include <csignal>
#include <ctime>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

bool same_files(const char* a, const char* b) {
  static Content text;
  const std::string_view other = content(in_folder(b).c_str(), text);
  return !other.empty() && file_of(a) == other;
}

int count_files(const char* path) {
  DIR* entries = opendir(path);
  int count = -2;  // "." and ".."
  while (entries != nullptr && readdir(entries) != nullptr) ++count;
  closedir(entries);
  return count;
}

// Proves RUN-2.

void check_says_accepted_moves_nothing_and_writes_nothing(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  const Line trajectory = write("t.csv", {kHeader, kReady});
  const Line empty = in_folder("empty");
  char root[PATH_MAX];
  assert_non_null(getcwd(root, sizeof root));
  assert_int_equal(mkdir(empty.c_str(), 0777) + chdir(empty.c_str()), 0);
  const int code = tactus_run({"check", pipeline.c_str()});
  const Line accepted = Line(pipeline) << ": accepted\n";
  assert_true(output() == std::string_view(accepted));
  const int with = tactus_run({"check", pipeline.c_str(), "--trajectory", trajectory.c_str()});
  assert_int_equal(chdir(root), 0);
  assert_int_equal(code, 0);
  assert_int_equal(with, 0);
  assert_true(has(output(), ": accepted, 1 waypoint, 0.02 s\n"));
  assert_true(has(errors(), "/p.ini: note: [guard] position_allowance, velocity_allowance: "));
  assert_int_equal(count_files(empty.c_str()), 0);
}

void run_and_check_refuse_the_same_start_in_the_same_words(void**) {
  const Line path = write("start.ini", {kWithoutGenerator, "[plant]\ninitial_q = 1\n"});
  const Line expected = Line(path) << ": refused: joint 4 (fer_joint4): measured position 1 rad "
                                      "exceeds 0.0402 rad (67)\n";
  assert_int_equal(tactus_run({"check", path.c_str()}), 2);
  assert_true(errors() == std::string_view(expected));
  assert_int_equal(run_into("start", path.c_str()), 2);
  assert_true(errors() == std::string_view(expected));
}

void a_trajectory_for_a_pipeline_without_generator_is_refused(void**) {
  const Line pipeline = write("none.ini", {kWithoutGenerator});
  const Line trajectory = write("t.csv", {kHeader, kReady});
  assert_int_equal(tactus_run({"check", pipeline.c_str(), "--trajectory", trajectory.c_str()}), 2);
  assert_true(has(errors(), "t.csv: refused: the pipeline has no reference generator\n"));
  assert_int_equal(run_into("none", pipeline.c_str(), "1", trajectory.c_str()), 2);
}

// Proves RUN-1.

void a_run_writes_a_log_with_a_header_and_a_row_for_every_recorded_cycle(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("a", pipeline.c_str()), 0);
  const Line compare = Line("seen and expected: scripts/report ") << scratch << "/ a\n";
  assert_true(has(output(), compare));
  const std::string_view log = file_of("a/log.csv");
  assert_true(log.substr(0, 36) == "time_s,robot.q_1,robot.q_2,robot.q_3");
  int lines = 0;
  for (const char c : log) lines += c == '\n';
  assert_int_equal(lines, 1 + 5);  // 50 cycles, every tenth of them
  assert_true(has(log, "\n0.04,"));
}

void a_run_writes_a_summary_that_is_json_with_every_key_that_is_promised(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("a", pipeline.c_str(), "7"), 0);
  assert_has_all(file_of("a/summary.json"),
                 {"\"pipeline\": \"p\"",
                  "\"robot\": \"fer\"",
                  "\"board\": \"",
                  "\"rate_hz\": 1000,",
                  "\"cycles\": 50,",
                  "\"seed\": 7,",
                  "\"config_hash\": \"",
                  "\"result\": {\"code\": 0, \"name\": \"succeeded\"}",
                  "\"tracking\": [",
                  "\"signal\": \"jrg.q_d - robot.q\"",
                  "\"unit\": \"rad\"",
                  "\"rms\": [",
                  "\"max\": [",
                  "\"signals\": [",
                  "{\"name\": \"robot.q\", \"type\": \"\", \"quantity\": \"joint position\", "
                  "\"unit\": \"rad\", \"columns\": [\"robot.q_1\", \"robot.q_2\", ",
                  "{\"name\": \"jrg.q_d\", \"type\": \"joint_reference_generator\", ",
                  "\"quantity\": \"pose\", \"unit\": \"m, quaternion\", \"columns\": "
                  "[\"model.x_x\", \"model.x_y\", \"model.x_z\", \"model.x_qw\", ",
                  "\"timing\": {",
                  "\"cycle\": {\"p50_ns\": ",
                  "\"p99_ns\": ",
                  "\"max_ns\": ",
                  "\"slips\": 0",
                  "\"overruns\": ",
                  "\"guard\": {\"limited\": 0, \"tripped\": 0}",
                  "\"heap_allocations_in_cycle\": 0",
                  "\"static_bytes\": ",
                  "\"realtime_factor\": "});
  Line command("python3 -m json.tool ");
  command << in_folder("a/summary.json") << " >" << in_folder("out");
  assert_int_equal(std::system(command.c_str()), 0);
}

void a_summary_is_json_whatever_the_pipeline_is_called(void**) {
  write("a\"b\\c\n\xc3\xa9\xff\xed\xa0\x80.ini", {kPipeline});
  assert_succeeds(
      "cd $S && $P run a*b*.ini --duration 0.05 --no-figure --out q && python3 -c \"import json"
      "; print(ascii(json.load(open('q/summary.json', encoding='utf-8'))['pipeline']))\"");
  assert_true(has(output(), "'a\"b\\\\c\\n\\xe9\\ufffd\\ufffd\\ufffd\\ufffd'\n"));
}

void the_signals_of_the_summary_have_the_columns_of_the_log(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("a", pipeline.c_str()), 0);
  Line command("cd ");
  command << in_folder("a")
          << " && python3 -c \"import json; columns = [c for s in json.load(open('summary.json'))"
             "['signals'] for c in s['columns']]; assert len(columns) > 30; assert "
             "open('log.csv').readline().strip() == ','.join(['time_s'] + columns)\"";
  assert_int_equal(std::system(command.c_str()), 0);
}

// Proves CSV-11.

/// Every output is recorded, every tenth cycle, so that the reference is joined between them.
void a_log_is_a_trajectory_with_the_same_reference(void**) {
  write("p.ini", {kPipeline});
  write("t.csv", {kHeader, "0.3,0.05,-0.785398,0,-2.4,0,1.6,0.785398\n",
                  "0.6,0,-0.785398,0,-2.356194,0,1.570796,0.785398\n"});
  assert_succeeds(
      "cd $S; $P run p.ini --no-figure --trajectory t.csv --set gateway.interpolation=monotone "
      "--out log1 "
      "&& $P run p.ini --no-figure --trajectory log1/log.csv --out log2 && "
      "$P run p.ini --no-log --trajectory log1/log.csv --out log3 && "
      "[ ! -e log3/log.csv -a -e log3/summary.json ] && "
      "python3 -c 'import csv; a, b = (list(csv.DictReader(open(f\"log{i}/log.csv\"))) for i in "
      "(1, 2)); "
      "names = [f\"jrg.q_d_{i}\" for i in range(1, 8)]; "
      "worst = max(abs(float(x[n]) - float(y[n])) for x, y in zip(a, b) for n in names); "
      "assert len(a) > 100 and worst < 1e-9, (len(a), worst)'");
}

// Proves RUN-1.

void a_trajectory_that_ends_in_time_succeeds_and_one_that_does_not_is_unfinished(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  const Line trajectory = write("t.csv", {kHeader, kReady});
  assert_int_equal(run_into("a", pipeline.c_str(), "1", trajectory.c_str(), "0.2"), 0);
  assert_true(has(file_of("a/summary.json"), "\"name\": \"succeeded\""));
  assert_true(has(file_of("a/waypoints.csv"), "time_s,jrg.q_d_1,"));
  assert_int_equal(run_into("b", pipeline.c_str(), "1", trajectory.c_str(), "0.01"), 1);
  assert_true(has(file_of("b/summary.json"), "{\"code\": 1, \"name\": \"unfinished\""));
}

void a_fault_ends_the_run_with_its_code_and_the_files_are_written(void**) {
  const Line pipeline =
      write("weak.ini", {"[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
                         "[pd]\ntype = pd_gravity\nq_d = robot.q\nq = robot.q\ndq = robot.dq\n"
                         "kp = 1\nkd = 1\n[guard]\nmax_velocity = 1e-3\n"});
  assert_int_equal(run_into("weak", pipeline.c_str()), 1);
  assert_true(has(errors(), "weak.ini: stopped: joint "));
  assert_true(has(errors(), " rad/s exceeds 0.0011 rad/s (68)\n"));
  assert_true(has(output(), ", 1000 Hz: measured velocity beyond its limit (68)\n"));
  assert_true(has(file_of("weak/summary.json"), "\"name\": \"kMeasuredVelocityLimit\""));
  assert_true(has(file_of("weak/log.csv"), "time_s,"));
}

// Proves RUN-1, RUN-10, RUN-23.

void a_folder_that_cannot_be_made_is_refused(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("p.ini/below", pipeline.c_str()), 2);
  assert_true(has(errors(), "p.ini/below: Not a directory; choose another --out\n"));
}

void a_folder_holds_one_run_and_what_is_needed_to_draw_it(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  const Line trajectory = write("t.csv", {kHeader, kReady});
  assert_int_equal(run_into("one", pipeline.c_str(), "1", trajectory.c_str(), "0.2"), 0);
  assert_true(exists("one/waypoints.csv"));
  write("one/figure.png", {"of an earlier run"});
  assert_int_equal(run_into("one", pipeline.c_str()), 0);
  for (const char* name : {"one/waypoints.csv", "one/figure.png"}) assert_false(exists(name));
  assert_true(file_of("one/pipeline.ini") == kPipeline);
  assert_has_all(file_of("one/scene.json"),
                 {"\"robot\": \"fer\"", "[0.0825, 0, 0, 1.57079633, 0, 0],",
                  "\"flange\": [0, 0, 0.107, 0, 0, 0]", "{\"link\": 7, ", "\"boxes\": [",
                  "\"tau_max\": [87, 87, 87, 87, 12, "});
}

void a_folder_is_of_one_run_until_an_interrupt_ends_it_with_its_files_written(void**) {
  const Line pipeline = write("p.ini", {kPipeline}), out = in_folder("c");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) {
    std::remove(in_folder("c/log.csv").c_str());
    const pid_t child = spawn(
        {"run", pipeline.c_str(), "--duration", "1000000", "--no-figure", "--out", out.c_str()});
    for (int i = 0; i < 60'000 && file_of("c/log.csv").empty(); ++i) {
      const timespec millisecond = {0, 1'000'000};
      nanosleep(&millisecond, nullptr);
    }
    assert_int_equal(run_into("c", pipeline.c_str()), 2);
    assert_true(has(
        errors(),
        "/c: another run writes into this folder; wait for its end, or choose another --out\n"));
    assert_int_equal(kill(child, signal), 0);
    assert_int_equal(exit_code(child), 1);
    assert_true(has(file_of("c/summary.json"), "{\"code\": 1, \"name\": \"interrupted\"}"));
    assert_true(has(file_of("c/summary.json"), "\"cause\": \"halt\""));  // it was braked
    assert_true(file_of("c/log.csv").size() > 4000);
    assert_true(has(output(), "written to"));
  }
}

// Proves SIM-3.

void the_same_seed_writes_the_same_bytes_and_another_does_not(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("a", pipeline.c_str(), "3"), 0);
  assert_int_equal(run_into("b", pipeline.c_str(), "3"), 0);
  assert_int_equal(run_into("c", pipeline.c_str(), "4"), 0);
  assert_true(same_files("a/log.csv", "b/log.csv"));
  assert_false(same_files("a/log.csv", "c/log.csv"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(check_says_accepted_moves_nothing_and_writes_nothing),
      cmocka_unit_test(run_and_check_refuse_the_same_start_in_the_same_words),
      cmocka_unit_test(a_trajectory_for_a_pipeline_without_generator_is_refused),
      cmocka_unit_test(a_run_writes_a_log_with_a_header_and_a_row_for_every_recorded_cycle),
      cmocka_unit_test(a_run_writes_a_summary_that_is_json_with_every_key_that_is_promised),
      cmocka_unit_test(a_summary_is_json_whatever_the_pipeline_is_called),
      cmocka_unit_test(the_signals_of_the_summary_have_the_columns_of_the_log),
      cmocka_unit_test(a_log_is_a_trajectory_with_the_same_reference),
      cmocka_unit_test(a_trajectory_that_ends_in_time_succeeds_and_one_that_does_not_is_unfinished),
      cmocka_unit_test(a_fault_ends_the_run_with_its_code_and_the_files_are_written),
      cmocka_unit_test(a_folder_that_cannot_be_made_is_refused),
      cmocka_unit_test(a_folder_holds_one_run_and_what_is_needed_to_draw_it),
      cmocka_unit_test(a_folder_is_of_one_run_until_an_interrupt_ends_it_with_its_files_written),
      cmocka_unit_test(the_same_seed_writes_the_same_bytes_and_another_does_not),
  };
  return run_program_tests(argv[0], tests);
}
