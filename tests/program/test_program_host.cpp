// A run that asks more of the host: all of real time or nothing, and the machine's watchdog.
#include <signal.h>

#include <ctime>

#include "program/heap_count.hpp"
#include "program/results/realtime_result.hpp"
#include "tests/hal/os/host_tree.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

RealtimeReport granted() {
  RealtimeReport report;
  for (RealtimeStep& step : report.steps) step = {"step", StepOutcome::kOk, 0, "none"};
  return report;
}

bool complains(const RealtimeReport& steps, const HostTree& tree, std::string_view expected) {
  const Complaint said = complain(steps, inspect_host({tree.root(), 2, 80}));
  if (std::string_view(said) == expected) return true;
  print_error("%s\n", said.c_str());
  return false;
}

/// A pipeline that goes on on a busy host, with a watchdog of this name.
Line pipeline(const Line& device, const char* timeout) {
  return write("watched.ini", {kPipeline, kBusyHost, "[realtime]\n", "watchdog = ", device.c_str(),
                               "\nwatchdog_timeout_s = ", timeout, "\n"});
}

/// The watchdog's driver, before that of the system: it takes every timeout up to 60 s of any file.
constexpr const char* kDriver =
    "#include <errno.h>\n#include <stdarg.h>\n#include <linux/watchdog.h>\n"
    "int ioctl(int file, unsigned long request, ...) {\n"
    "  va_list more;\n  va_start(more, request);\n  void* argument = va_arg(more, void*);\n"
    "  va_end(more);\n  (void)file;\n  errno = ENOTTY;\n"
    "  if (request == WDIOC_GETSUPPORT)\n"
    "    return ((struct watchdog_info*)argument)->options = WDIOF_MAGICCLOSE, 0;\n"
    "  if (request != WDIOC_SETTIMEOUT) return -1;\n  errno = EINVAL;\n"
    "  return *(int*)argument <= 60 ? 0 : -1;\n}\n";

/// Starts a run with that driver; null: with the system's.
pid_t spawn_run(const Line& file, const char* name, const char* duration) {
  return spawn({"run", file.c_str(), "--realtime", "--duration", duration, "--no-figure", "--out",
                in_folder(name).c_str()});
}

bool build_driver() {
  write("driver.c", {kDriver});
  if (shell("gcc -shared -fPIC -o $S/driver.so $S/driver.c") != 0) return false;
  return setenv("LD_PRELOAD", in_folder("driver.so").c_str(), 1) == 0;
}

int restore(void**) {
  return unsetenv("LD_PRELOAD");
}

// Proves RT-6.

void a_fit_host_that_grants_everything_gives_no_reason_to_complain(void**) {
  HostTree tree;
  assert_true(complains(granted(), tree, ""));
  tree.put("/proc/swaps", "Filename\n/swapfile file 1\n");       // better without
  tree.put("/proc/self/limits", "Max realtime priority 0 0\n");  // the step has the last word
  assert_true(complains(granted(), tree, ""));
  tree.remove_all();
}

void a_required_setting_that_hurts_or_is_not_known_is_named_with_its_remedy(void**) {
  constexpr const char* kRemedy = "boot a PREEMPT_RT kernel (Debian: linux-image-rt-amd64))";
  HostTree tree;
  tree.put("/proc/sys/kernel/version", "#1 SMP\n");
  assert_true(complains(granted(), tree, Line("kernel (#1 SMP: ") << kRemedy));
  RealtimeReport steps = granted();
  steps.steps[0] = {"cpu", StepOutcome::kRefused, 22, "name one"};
  assert_true(complains(steps, tree,
                        Line("cpu (Invalid argument: name one), kernel (#1 SMP: ") << kRemedy));
  tree.remove("/proc/sys/kernel/version");
  assert_true(complains(granted(), tree,
                        Line("kernel (not readable: No such file or directory: ") << kRemedy));
  tree.remove_all();
}

// Proves RT-9.

void a_watchdog_that_is_none_ends_the_start_and_its_file_is_left_alone(void**) {
  const Line file = write("none", {"text"});
  assert_int_equal(exit_code(spawn_run(pipeline(file, "5"), "n", "0.01")), 2);
  assert_true(has(errors(), "[realtime] watchdog: refused: "));
  assert_true(has(errors(), "/none is no watchdog: Inappropriate ioctl for device\n"));
  assert_true(file_of("none") == "text");
  assert_int_equal(exit_code(spawn_run(pipeline(in_folder("missing"), "5"), "n", "0.01")), 2);
  assert_true(has(errors(), "/missing cannot be opened: No such file or directory\n"));
}

void a_run_kicks_the_watchdog_and_stops_it_when_it_has_ended(void**) {
  if (!kHeapIsCounted) _skip(__FILE__, __LINE__);  // a sanitizer must be the first library
  assert_true(build_driver());
  const Line device = write("device", {""});
  assert_int_equal(exit_code(spawn_run(pipeline(device, "60"), "k", "0.5")), 0);
  const std::string_view bytes = file_of("device");
  assert_true(bytes.size() >= 2);
  assert_int_equal(bytes.find_first_not_of('\0'), bytes.size() - 1);
  assert_int_equal(bytes.back(), 'V');
  assert_int_equal(exit_code(spawn_run(pipeline(device, "61"), "k", "0.5")), 2);
  assert_true(has(errors(), "/device does not take watchdog_timeout_s = 61: Invalid argument;"));
}

void a_run_that_is_killed_leaves_the_watchdog_running(void**) {
  if (!kHeapIsCounted) _skip(__FILE__, __LINE__);
  assert_true(build_driver());
  const pid_t child = spawn_run(pipeline(write("device", {""}), "60"), "q", "1000000");
  for (int i = 0; i < 60'000 && file_of("device").empty(); ++i) {
    const timespec millisecond = {0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  assert_int_equal(kill(child, SIGKILL), 0);
  assert_int_equal(exit_code(child), -SIGKILL);
  assert_false(file_of("device").empty());
  assert_true(file_of("device").find('V') == std::string_view::npos);
}

void virtual_time_has_no_watchdog(void**) {
  const Line file = pipeline(in_folder("missing"), "5");
  assert_int_equal(tactus::run_into("v", file.c_str()), 0);
}

// Proves RT-10.

void the_unit_gives_the_rights_and_does_not_restart(void**) {
  assert_succeeds("cat program/tactus@.service");
  for (const char* line :
       {"\nRestart=no\n", "\nCPUSchedulingPolicy=fifo\n", "\nCPUSchedulingPriority=80\n",
        "\nLimitRTPRIO=98\n", "\nLimitMEMLOCK=infinity\n", "\nAllowedCPUs="})
    assert_true(has(output(), line));
  assert_true(output().find("\n[Install]") == std::string_view::npos);
}

void systemd_has_no_complaint_about_the_unit(void**) {
  assert_succeeds("command -v systemd-analyze || { echo as root: scripts/setup test >&2; false; }");
  constexpr const char* kVerify =
      "sed \"s|^ExecStart=[^ ]*|ExecStart=$P|; s|^WorkingDirectory=.*|WorkingDirectory=$R|%s\" "
      "program/tactus@.service >$S/tactus@.service && systemd-analyze verify $S/tactus@arm.service";
  char command[512];
  std::snprintf(command, sizeof command, kVerify, "");
  assert_succeeds(command);
  assert_true(output().empty() && errors().empty());
  std::snprintf(command, sizeof command, kVerify, "; s/^Restart=/Restarts=/");
  shell(command);
  assert_true(has(errors(), "Restarts"));  // it does look
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_fit_host_that_grants_everything_gives_no_reason_to_complain),
      cmocka_unit_test(a_required_setting_that_hurts_or_is_not_known_is_named_with_its_remedy),
      cmocka_unit_test(a_watchdog_that_is_none_ends_the_start_and_its_file_is_left_alone),
      cmocka_unit_test_teardown(a_run_kicks_the_watchdog_and_stops_it_when_it_has_ended, restore),
      cmocka_unit_test_teardown(a_run_that_is_killed_leaves_the_watchdog_running, restore),
      cmocka_unit_test(virtual_time_has_no_watchdog),
      cmocka_unit_test(the_unit_gives_the_rights_and_does_not_restart),
      cmocka_unit_test(systemd_has_no_complaint_about_the_unit),
  };
  return run_program_tests(argv[0], tests);
}
