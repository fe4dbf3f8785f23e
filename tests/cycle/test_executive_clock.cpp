// Tests the executive's clock: a late cycle, missed periods, and a cycle that comes too early.
#include <limits>

#include "tests/cycle/executive_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

/// At rest, the drives are disabled after the number of cycles that count as rest.
void assert_stops(Bench& b, Status status) {
  assert_true(b.executive.rung() == Rung::kStop);
  for (int i = 1; i < RestWatch::kCycles; ++i) {
    assert_int_equal(b.hal.stops, 0);
    ASSERT_STATUS(b.cycle(), status);
  }
  assert_stopped(b, status);
}

// Proves EXE-3.

void after_any_number_of_missed_periods_the_reference_moves_on_by_one(void**) {
  Bench& b = started_bench();
  b.pipeline.executive.late_window = 1;  // they may come for ever
  ASSERT_OK(b.start());
  assert_true(b.send_line());
  for (int i = 0; i < 5; ++i) ASSERT_OK(b.cycle());
  std::int64_t slips = 0;
  for (int missed = 1; missed <= 50; ++missed) {
    for (const double periods : {1.0 + missed, 1.0}) {  // late, then on time again
      const double before = b.reference();
      ASSERT_OK(b.cycle(periods));
      ASSERT_NEAR(b.reference() - before, 0.5 * Bench::kPeriod_s, 1e-12);  // at 0.5 rad/s
    }
    slips += missed;
    assert_int_equal(b.executive.telemetry().slips, slips);
  }
  assert_int_equal(b.cycles(), 5 + 2 * 50);
  assert_int_equal(b.hal.writes, 5 + 2 * 50);
}

void less_than_half_a_period_of_jitter_is_no_slip(void**) {
  Bench& b = started_bench();
  for (const double periods : {1.49, 1.49, 0.51, 0.01, 1.49}) ASSERT_OK(b.cycle(periods));
  assert_int_equal(b.executive.telemetry().slips, 0);
  ASSERT_OK(b.cycle(1.51));
  assert_int_equal(b.executive.telemetry().slips, 1);
}

// Proves EXE-4, EXE-5.

void more_missed_periods_than_are_bridged_brake_the_robot(void**) {
  for (const int allowed : {0, 3, 50}) {
    Bench& b = started_bench();
    b.pipeline.executive.max_slip = allowed;
    ASSERT_OK(b.start());
    ASSERT_OK(b.cycle());
    ASSERT_OK(b.cycle(1.0 + allowed));
    ASSERT_STATUS(b.cycle(2.0 + allowed), Status::kSlip);
    assert_int_equal(b.executive.telemetry().slips, 2 * allowed + 1);
    assert_true(b.executive.rung() == (allowed > 0 ? Rung::kHold : Rung::kStop));
    Bench& longer = started_bench();
    longer.pipeline.executive.max_slip = allowed;
    ASSERT_OK(longer.start());
    ASSERT_OK(longer.cycle());
    ASSERT_STATUS(longer.cycle(2.0 + 2 * allowed), Status::kSlip);
    assert_true(longer.executive.rung() == Rung::kStop);
  }
}

void a_clock_that_stands_or_runs_backwards_stops_the_robot(void**) {
  for (const double periods : {0.0, -0.001, -1.0, -1e9}) {
    Bench& b = started_bench();
    for (int i = 0; i < 3; ++i) ASSERT_OK(b.cycle());
    ASSERT_STATUS(b.cycle(periods), Status::kClock);
    assert_stops(b, Status::kClock);
  }
}

void one_early_cycle_follows_a_late_one_but_a_burst_stops_the_robot(void**) {
  Bench& b = started_bench();
  for (const double periods : {1.0, 1.7, 0.3, 1.0, 1.8, 0.2}) ASSERT_OK(b.cycle(periods));
  ASSERT_STATUS(b.cycle(0.1), Status::kClock);
}

void a_clock_that_reads_nonsense_stops_the_robot(void**) {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  Bench& late = started_bench();
  ASSERT_STATUS(late.executive.cycle({kLast}), Status::kSlip);
  Bench& backwards = started_bench();
  ASSERT_STATUS(backwards.executive.cycle({kFirst}), Status::kClock);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(after_any_number_of_missed_periods_the_reference_moves_on_by_one),
      cmocka_unit_test(less_than_half_a_period_of_jitter_is_no_slip),
      cmocka_unit_test(more_missed_periods_than_are_bridged_brake_the_robot),
      cmocka_unit_test(a_clock_that_stands_or_runs_backwards_stops_the_robot),
      cmocka_unit_test(one_early_cycle_follows_a_late_one_but_a_burst_stops_the_robot),
      cmocka_unit_test(a_clock_that_reads_nonsense_stops_the_robot),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
