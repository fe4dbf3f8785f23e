// Every run of `make run`, by the program itself: it must succeed, and without touching a limit.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "kernel/model/robot.hpp"
#include "tests/testing.hpp"

namespace {

struct Run {
  const char *robot, *arguments;
};
constexpr Run kRuns[] = {
    {"fer", "pipelines/fer_jrg_pdgc.ini"},
    {"fer",
     "pipelines/fer_jrg_pdgc.ini --trajectory pipelines/trajectories/fer_five_waypoints.csv"},
    {"fer", "pipelines/fer_trg_cpc.ini"},
    {"fer", "pipelines/fer_trg_ac_cpc_pid.ini"},
    {"ur10", "pipelines/ur10_jrg_pdgc.ini"},
    {"ur10", "pipelines/ur10_jrg_pid.ini"},
    {"ur10",
     "pipelines/ur10_jrg_pid.ini --trajectory pipelines/trajectories/"
     "ur10_five_waypoints_quintic.csv"},
    {"ur10", "pipelines/ur10_trg_cpc.ini"},
    {"ur10",
     "pipelines/ur10_trg_cpc.ini --trajectory pipelines/trajectories/ur10_square_at_rest.csv"},
    {"ur10", "pipelines/ur10_trg_cpc_125.ini"},
    {"ur10", "pipelines/ur10_trg_ac_cpc.ini"},
    {"ur10", "pipelines/ur10_trg_ac_cpc_pid.ini"},
};

char program[512];

/// Runs one pipeline into a fresh folder and leaves its summary in `summary`; the exit code.
int run(const char* arguments, char (&summary)[8192]) {
  char folder[] = "/tmp/tactus-run-XXXXXX", command[2048], path[256];
  assert_non_null(mkdtemp(folder));
  std::snprintf(command, sizeof command, "%s run %s --no-figure --out %s >/dev/null", program,
                arguments, folder);
  const int code = std::system(command);
  std::snprintf(path, sizeof path, "%s/summary.json", folder);
  std::FILE* file = std::fopen(path, "r");
  assert_non_null(file);
  summary[std::fread(summary, 1, sizeof summary - 1, file)] = '\0';
  std::fclose(file);
  std::snprintf(command, sizeof command, "rm -r %s", folder);
  assert_int_equal(std::system(command), 0);
  return code;
}

void assert_has(const char* summary, const char* text) {
  if (std::strstr(summary, text) == nullptr) print_error("no %s in\n%s\n", text, summary);
  assert_non_null(std::strstr(summary, text));
}

void assert_flawless(const char* arguments) {
  print_message("%s\n", arguments);
  static char summary[8192];
  assert_int_equal(run(arguments, summary), 0);
  assert_has(summary, "\"result\": {\"code\": 0, \"name\": \"succeeded\"}");
  assert_has(summary, "\"guard\": {\"limited\": 0, \"tripped\": 0}");
  assert_has(summary, "\"heap_allocations_in_cycle\": 0");
  assert_has(summary, "\"slips\": 0");
  assert_has(summary, "\"recorder_dropped\": 0");
}

// Proves LOOP-3, EXE-8.

void every_run_succeeds_within_all_limits(void**) {
  for (const Run& run : kRuns)
    if (std::strcmp(run.robot, tactus::Robot::kName) == 0) assert_flawless(run.arguments);
}

}  // namespace

int main(int, char** argv) {
  // The program stands beside the folder of the tests: build/<board>/tests/test_pipelines.
  std::snprintf(program, sizeof program, "%.480s", argv[0]);
  for (int i = 0; i < 2; ++i) *std::strrchr(program, '/') = '\0';
  std::strcat(program, "/tactus");
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_run_succeeds_within_all_limits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
