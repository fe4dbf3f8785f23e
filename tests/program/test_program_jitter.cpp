// `jitter`: both measurements, without and with load. The programs that it runs are scripts in a
// folder of their own.
#include <signal.h>
#include <sys/stat.h>

#include <ctime>

#include "program/host/cyclictest.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Runs jitter where no program is installed but a cyclictest that is this script (null: not even
/// that) and what else is in the folder.
int jitter_beside(const char* script, const char* duration, const char* load = nullptr) {
  const Line before = std::string_view(std::getenv("PATH"));
  std::remove(in_folder("cyclictest").c_str());
  if (script != nullptr)
    assert_int_equal(chmod(write("cyclictest", {"#!/bin/sh\n", script}).c_str(), 0755), 0);
  assert_int_equal(setenv("PATH", scratch, 1), 0);
  const int code = load == nullptr ? tactus_run({"jitter", "--duration", duration})
                                   : tactus_run({"jitter", "--duration", duration, "--load", load});
  assert_int_equal(setenv("PATH", before.c_str(), 1), 0);
  return code;
}

// Proves RT-7.

void jitter_shows_its_own_latencies_beside_those_of_cyclictest(void**) {
  constexpr const char* kScript =
      "echo '# /dev/cpu_dma_latency set to 0us'\n"
      "echo '000003 000006'; echo '000008 000014'; echo '000009 000000'\n"
      "echo '# Max Latencies: 00030'; echo '# Histogram Overflows: 00001'\n";
  assert_int_equal(jitter_beside(kScript, "0.02"), 0);
  assert_true(has(output(), "  tactus            20 "));
  // 6 times 3 us, 14 times 8 us, once 30 us: the mean of 21 is 160 / 21
  assert_true(has(output(), "  cyclictest        21       3.0       7.6       8."));
  assert_true(has(output(), "      30.0\n"));
}

void jitter_says_why_there_is_no_cyclictest(void**) {
  assert_int_equal(jitter_beside(nullptr, "0.01"), 0);
  assert_true(has(output(), "cyclictest: not installed (Debian: rt-tests)\n"));
  constexpr const char* kScript = "echo 'Unable to change scheduling policy!' >&2; exit 1\n";
  assert_int_equal(jitter_beside(kScript, "0.01"), 0);
  assert_true(has(output(), "cyclictest: failed: Unable to change scheduling policy!\n"));
  assert_true(has(output(), "  tactus            10 "));
}

void cyclictest_is_asked_for_the_same_period_priority_and_cpu(void**) {
  const Text<255> both = cyclictest_command({500, 4000, 80, 3});
  assert_true(has(both, "cyclictest -q -m -t1 "));
  assert_true(has(both, " -i 500 -l 4000 -p 80 -a 3 2>&1"));
  const Text<255> neither = cyclictest_command({1000, 10, 0, -1});
  assert_true(has(neither, " -i 1000 -l 10 2>&1"));
}

/// A stress-ng that says what it was asked for and then does this.
void plant_stress_ng(const char* then) {
  const Line said = in_folder("load"), process = in_folder("process");
  const Line path = write("stress-ng", {"#!/bin/sh\n[ $1 = --version ] && exit\necho $@ >",
                                        said.c_str(), "\necho $$ >", process.c_str(), "\n", then});
  assert_int_equal(chmod(path.c_str(), 0755), 0);
}

void jitter_measures_without_and_with_load_in_one_run(void**) {
  plant_stress_ng("exec /bin/sleep 600\n");
  assert_int_equal(jitter_beside("echo '000003 000006'\n", "0.02", "cpu,disk"), 0);
  assert_true(has(file_of("load"), "--quiet --timeout 0 --cpu 0 --hdd 1 --hdd-bytes 128m\n"));
  const std::string_view said = output();
  const std::size_t loaded = said.find("The same under load by stress-ng (cpu, disk):\n");
  assert_true(loaded != std::string_view::npos);
  for (const std::string_view half : {said.substr(0, loaded), said.substr(loaded)}) {
    assert_true(has(half, "  tactus            20 "));
    assert_true(has(half, "  cyclictest         6 "));
  }
  assert_int_not_equal(kill(std::atoi(file_of("process").data()), 0), 0);  // nothing is left
  assert_int_equal(jitter_beside(nullptr, "0.01", "memory"), 0);
  assert_true(has(file_of("load"), " --vm 1 --vm-bytes 10%\n"));
}

void a_load_ends_with_a_measurement_that_is_killed(void**) {
  const Line before = std::string_view(std::getenv("PATH"));
  std::remove(in_folder("process").c_str());
  plant_stress_ng("exec /bin/sleep 600\n");
  assert_int_equal(setenv("PATH", scratch, 1), 0);
  const pid_t child = spawn({"jitter", "--duration", "0.01", "--load", "cpu"});
  const timespec millisecond = {0, 1'000'000};
  for (int i = 0; i < 60'000 && file_of("process").empty(); ++i) nanosleep(&millisecond, nullptr);
  assert_int_equal(kill(child, SIGKILL), 0);
  assert_int_equal(setenv("PATH", before.c_str(), 1), 0);
  assert_int_equal(exit_code(child), -SIGKILL);
  const pid_t process = std::atoi(file_of("process").data());
  assert_true(process > 0);
  bool runs = true;
  for (int i = 0; i < 60'000 && runs; ++i) {
    nanosleep(&millisecond, nullptr);
    const Line stat = Line("/proc/") << process << "/stat";
    static Content text;
    const std::string_view state = content(stat.c_str(), text);
    runs = !state.empty() && state.find(") Z ") == std::string_view::npos;
  }
  assert_false(runs);
}

void a_load_that_is_missing_or_breaks_off_is_an_error(void**) {
  std::remove(in_folder("stress-ng").c_str());
  assert_int_equal(jitter_beside(nullptr, "0.01", "cpu"), 2);
  assert_true(has(errors(), "jitter: --load: stress-ng is not there: install stress-ng"));
  assert_true(output().empty());
  plant_stress_ng("exit 3\n");
  assert_int_equal(jitter_beside(nullptr, "0.01", "cpu"), 1);
  assert_true(has(errors(), "--load: stress-ng ended before the measurement: exit code 3\n"));
  assert_true(output().empty());
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(jitter_shows_its_own_latencies_beside_those_of_cyclictest),
      cmocka_unit_test(jitter_says_why_there_is_no_cyclictest),
      cmocka_unit_test(cyclictest_is_asked_for_the_same_period_priority_and_cpu),
      cmocka_unit_test(jitter_measures_without_and_with_load_in_one_run),
      cmocka_unit_test(a_load_ends_with_a_measurement_that_is_killed),
      cmocka_unit_test(a_load_that_is_missing_or_breaks_off_is_an_error),
  };
  return run_program_tests(argv[0], tests);
}
