// Tests every run of `make run` with the program itself: it must succeed without touching a limit.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/support/testing.hpp"

namespace {

char program[512];

/// Runs one pipeline into a fresh folder and leaves its summary in `summary`; returns the exit
/// code.
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

/// RUNS lists the runs of the board, each as PIPELINE or PIPELINE:TRAJECTORY.
void every_run_succeeds_within_all_limits(void**) {
  char runs[] = RUNS, arguments[256];
  int count = 0;
  for (const char* run = std::strtok(runs, " "); run != nullptr; run = std::strtok(nullptr, " ")) {
    const char* colon = std::strchr(run, ':');
    const int size = colon == nullptr ? -1 : static_cast<int>(colon - run);
    std::snprintf(arguments, sizeof arguments, "pipelines/%.*s.ini%s%s%s", size, run,
                  colon == nullptr ? "" : " --trajectory pipelines/trajectories/",
                  colon == nullptr ? "" : colon + 1, colon == nullptr ? "" : ".csv");
    assert_flawless(arguments);
    ++count;
  }
  assert_true(count > 0);
}

}  // namespace

int main(int, char** argv) {
  // The program is in the parent folder of the tests, build/<board>/tests.
  std::snprintf(program, sizeof program, "%.480s", argv[0]);
  *std::strstr(program, "/tests/") = '\0';
  std::strcat(program, "/tactus");
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_run_succeeds_within_all_limits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
