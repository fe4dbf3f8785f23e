// Tests the clock of the cycle: wake-ups are on the grid, one per period, never in a burst.
#include "hal/os/cycle_clock.hpp"

#include <sys/time.h>

#include <csignal>
#include <ctime>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr unsigned kSeed = 20260307;
constexpr std::int64_t kStart = 1'000'000'007;

/// The first later point of the grid, by stepping.
std::int64_t first_ahead(std::int64_t planned, std::int64_t now, std::int64_t period) {
  do planned += period;
  while (planned <= now);
  return planned;
}

/// Delays as a host has them: mostly far below a period, sometimes several periods.
std::int64_t delay(std::mt19937_64& random, std::int64_t period) {
  const std::uint64_t kind = random() % 16;
  const std::int64_t longest = kind == 0 ? 7 * period : kind < 4 ? period : period / 8;
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(longest + 1));
}

// Proves RT-3.

void the_next_wake_up_is_the_first_point_of_the_grid_that_lies_ahead(void**) {
  constexpr std::int64_t kPeriod = 1000;
  assert_int_equal(next_wake_ns(5000, 5000, kPeriod), 6000);
  assert_int_equal(next_wake_ns(5000, 5999, kPeriod), 6000);
  assert_int_equal(next_wake_ns(5000, 6000, kPeriod), 7000);  // that point has passed already
  assert_int_equal(next_wake_ns(5000, 6001, kPeriod), 7000);
  assert_int_equal(next_wake_ns(5000, 9500, kPeriod), 10000);
  assert_int_equal(next_wake_ns(5000, 4000, kPeriod), 6000);  // asked too early
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 100'000; ++i) {
    const auto period = static_cast<std::int64_t>(1 + random() % 2'000'000);
    const std::int64_t planned = kStart + static_cast<std::int64_t>(random() % 1'000'000);
    const std::int64_t now = planned + delay(random, period);
    assert_int_equal(next_wake_ns(planned, now, period), first_ahead(planned, now, period));
  }
}

/// A cycle begins late by one delay and takes another.
void whatever_the_delays_no_period_has_two_wake_ups_and_no_two_follow_in_a_burst(void**) {
  std::mt19937_64 random(kSeed + 1);
  for (const std::int64_t period : {100'000, 999'983, 1'000'000, 8'000'000}) {
    std::int64_t planned = kStart, now = kStart, before = kStart - period, long_before = before;
    for (int k = 0; k < 20'000; ++k) {
      const std::int64_t next = next_wake_ns(planned, now, period);
      assert_int_equal((next - kStart) % period, 0);
      assert_true(next > planned && next > now && next - now <= period);
      const std::int64_t stamp = next + delay(random, period);
      assert_true((stamp - kStart) / period > (before - kStart) / period);
      if (k > 1) assert_true(stamp - long_before > period);  // else it is a burst
      long_before = before;
      before = stamp;
      planned = next;
      now = stamp + delay(random, period);
    }
  }
}

void a_clock_wakes_on_its_grid_and_never_before_its_time(void**) {
  constexpr std::int64_t kPeriod = 200'000;
  CycleClock clock;
  Wake first, wake;
  ASSERT_OK(clock.start(kPeriod));
  ASSERT_OK(clock.wait(first));
  std::int64_t planned = first.planned_ns;
  for (int k = 0; k < 50; ++k) {
    ASSERT_OK(clock.wait(wake));
    assert_true(wake.stamp_ns >= wake.planned_ns);
    assert_int_equal(wake.latency_ns(), wake.stamp_ns - wake.planned_ns);
    assert_int_equal(wake.planned_ns, planned + (1 + wake.missed) * kPeriod);
    planned = wake.planned_ns;
  }
}

void periods_that_passed_meanwhile_are_left_out_and_counted(void**) {
  constexpr std::int64_t kPeriod = 1'000'000;
  CycleClock clock;
  Wake before, wake;
  ASSERT_OK(clock.start(kPeriod));
  ASSERT_OK(clock.wait(before));
  const std::int64_t until = before.planned_ns + 5 * kPeriod;
  while (monotonic_ns() < until) {
    const timespec rest = {0, 100'000};
    nanosleep(&rest, nullptr);
  }
  ASSERT_OK(clock.wait(wake));
  assert_true(wake.missed >= 5);
  assert_true(wake.planned_ns > until);
  assert_int_equal(wake.planned_ns, before.planned_ns + (1 + wake.missed) * kPeriod);
}

volatile std::sig_atomic_t alarms = 0;

void a_signal_does_not_end_the_sleep(void**) {
  struct sigaction action {};
  action.sa_handler = [](int) { alarms = alarms + 1; };
  assert_int_equal(sigaction(SIGALRM, &action, nullptr), 0);
  const itimerval often = {{0, 1000}, {0, 1000}}, never = {};
  CycleClock clock;
  Wake wake;
  ASSERT_OK(clock.start(20'000'000));
  assert_int_equal(setitimer(ITIMER_REAL, &often, nullptr), 0);
  const Status status = clock.wait(wake);
  assert_int_equal(setitimer(ITIMER_REAL, &never, nullptr), 0);
  ASSERT_OK(status);
  assert_true(alarms > 0);
  assert_true(wake.stamp_ns >= wake.planned_ns);
}

void a_clock_without_a_period_is_refused(void**) {
  CycleClock clock;
  Wake wake;
  ASSERT_STATUS(clock.wait(wake), Status::kNotStarted);
  ASSERT_STATUS(clock.start(0), Status::kBadValue);
  ASSERT_STATUS(clock.start(-1000), Status::kBadValue);
  ASSERT_STATUS(clock.wait(wake), Status::kNotStarted);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_next_wake_up_is_the_first_point_of_the_grid_that_lies_ahead),
      cmocka_unit_test(whatever_the_delays_no_period_has_two_wake_ups_and_no_two_follow_in_a_burst),
      cmocka_unit_test(a_clock_wakes_on_its_grid_and_never_before_its_time),
      cmocka_unit_test(periods_that_passed_meanwhile_are_left_out_and_counted),
      cmocka_unit_test(a_signal_does_not_end_the_sleep),
      cmocka_unit_test(a_clock_without_a_period_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
