// The machine's watchdog, with a file in place of the device and a driver that a test chooses: the
// file holds every byte that was written.
#include "hal/os/watchdog.hpp"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// What the driver offers, and what it was asked for.
struct Driver {
  bool magic_close = true;
  int least_s = 2, most_s = 600, step_s = 1;
  int timeout_s = 0;
} driver;

int drive(int, unsigned long request, void* argument) {
  if (request == WDIOC_GETSUPPORT) {
    static_cast<watchdog_info*>(argument)->options = driver.magic_close ? WDIOF_MAGICCLOSE : 0;
    return 0;
  }
  assert_int_equal(request, WDIOC_SETTIMEOUT);
  int& timeout_s = *static_cast<int*>(argument);
  errno = EINVAL;
  if (timeout_s < driver.least_s || timeout_s > driver.most_s) return -1;
  timeout_s -= timeout_s % driver.step_s;
  driver.timeout_s = timeout_s;
  return 0;
}

char device[] = "/tmp/tactus-watchdog-XXXXXX";

int make_device(void**) {
  const int file = mkstemp(device);
  return file < 0 ? -1 : close(file);
}
int remove_device(void**) {
  return unlink(device);
}
/// An empty device and a driver that takes everything.
int renew(void**) {
  driver = {};
  return truncate(device, 0);
}

/// The bytes that were written, a kick as a dot.
std::string_view written() {
  static char bytes[64];
  std::FILE* file = std::fopen(device, "rb");
  assert_non_null(file);
  const std::size_t size = std::fread(bytes, 1, sizeof bytes, file);
  std::fclose(file);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = bytes[i] == '\0' ? '.' : bytes[i];
  return {bytes, size};
}

void refused(const char* path, int timeout_s, const char* why) {
  Watchdog watchdog(drive);
  Message said, expected(path);
  expected << " " << why;
  const bool armed = watchdog.arm(path, timeout_s, said) || watchdog.armed();
  if (armed || std::string_view(said) != std::string_view(expected))
    print_error("%s\n", said.c_str());
  assert_true(!armed && std::string_view(said) == std::string_view(expected));
}

// Proves RT-9.

void only_a_cycle_that_has_completed_kicks(void**) {
  static Watchdog watchdog(drive);
  Message why;
  watchdog.cycle_completed();
  watchdog.kick();  // before it is armed
  assert_true(watchdog.arm(device, 5, why));
  assert_int_equal(driver.timeout_s, 5);
  watchdog.kick();
  assert_true(written() == ".");
  for (int i = 0; i < 3; ++i) watchdog.kick();
  assert_true(written() == ".");
  for (int i = 0; i < 100; ++i) watchdog.cycle_completed();
  watchdog.kick();
  watchdog.kick();
  assert_true(written() == "..");
  assert_true(watchdog.disarm(why) && !watchdog.armed() && why.empty());
  assert_true(written() == "..V");
  watchdog.cycle_completed();
  watchdog.kick();
  assert_true(watchdog.disarm(why));
  assert_true(written() == "..V");
}

void a_watchdog_that_is_not_disarmed_gets_no_magic_close(void**) {
  {
    Watchdog watchdog(drive);
    Message why;
    assert_true(watchdog.arm(device, 5, why));
    watchdog.cycle_completed();
    watchdog.kick();
  }
  assert_true(written() == ".");
}

void a_device_that_cannot_be_opened_is_refused(void**) {
  refused("/dev/there_is_no_watchdog", 5, "cannot be opened: No such file or directory");
  refused("/tmp", 5, "cannot be opened: Is a directory");
}

void a_file_that_is_no_watchdog_is_refused_and_not_written(void**) {
  Watchdog watchdog;
  Message why;
  assert_false(watchdog.arm(device, 5, why));
  assert_true(std::string_view(why).find(" is no watchdog: Inappropriate ioctl") !=
              std::string_view::npos);
  assert_true(written().empty());
}

void a_timeout_that_the_driver_has_not_is_refused_and_the_timer_stopped(void**) {
  refused(device, 1,
          "does not take watchdog_timeout_s = 1: Invalid argument; choose one that the driver "
          "offers");
  assert_true(written() == "V");
  refused(device, 601,
          "does not take watchdog_timeout_s = 601: Invalid argument; choose one that the driver "
          "offers");
  driver.step_s = 10;
  refused(device, 25, "makes 20 of watchdog_timeout_s = 25; write that");
  assert_true(written().back() == 'V');
}

void a_driver_that_a_crash_would_stop_is_refused(void**) {
  driver.magic_close = false;
  refused(device, 5, "has no magic close: a crash would stop it; load another driver");
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(only_a_cycle_that_has_completed_kicks, renew),
      cmocka_unit_test_setup(a_watchdog_that_is_not_disarmed_gets_no_magic_close, renew),
      cmocka_unit_test_setup(a_device_that_cannot_be_opened_is_refused, renew),
      cmocka_unit_test_setup(a_file_that_is_no_watchdog_is_refused_and_not_written, renew),
      cmocka_unit_test_setup(a_timeout_that_the_driver_has_not_is_refused_and_the_timer_stopped,
                             renew),
      cmocka_unit_test_setup(a_driver_that_a_crash_would_stop_is_refused, renew),
  };
  return cmocka_run_group_tests(tests, make_device, remove_device);
}
