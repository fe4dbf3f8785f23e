// Tests the executive's rows, and the execution times it keeps of every stage.
#include "kernel/cycle/executive.hpp"

#include "kernel/core/names.hpp"
#include "tests/cycle/executive_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Proves EXE-6.

void a_row_runs_in_exactly_its_cycles(void**) {
  constexpr struct {
    int divisor, offset;
    const char* cycles;  // of the first twelve, x where the row runs
  } kRows[] = {{1, 0, "xxxxxxxxxxxx"}, {3, 0, "x..x..x..x.."},   {3, 2, "..x..x..x..x"},
               {5, 4, "....x....x.."}, {100, 0, "x..........."}, {100, 99, "............"}};
  for (const auto& row : kRows) {
    Bench& b = started_bench();
    RowProbe probe = {&b.hal, '1'};
    ASSERT_OK(b.executive.add(probe.row(row.divisor, row.offset)));
    for (int number = 0; number < 12; ++number) {
      probe.time_s = -1.0;
      ASSERT_OK(b.cycle(number == 6 ? 4.0 : 1.0));  // a slip does not change the count
      const double time_s = row.cycles[number] == 'x' ? number * Bench::kPeriod_s : -1.0;
      ASSERT_NEAR(probe.time_s, time_s, 1e-12);
    }
  }
}

void rows_run_in_the_order_they_were_added(void**) {
  Bench& b = fresh_bench();
  RowProbe probes[] = {{&b.hal, '1'}, {&b.hal, '2'}, {&b.hal, '3'}};
  ASSERT_OK(b.executive.add(probes[0].row()));
  ASSERT_OK(b.executive.add(probes[1].row(2, 1)));
  ASSERT_OK(b.executive.add(probes[2].row()));
  ASSERT_OK(b.start());
  ASSERT_OK(b.cycle());
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rw13rw123");
}

void no_row_runs_in_a_cycle_that_stops_the_robot(void**) {
  Bench& b = started_bench();
  RowProbe probe = {&b.hal, '1'};
  ASSERT_OK(b.executive.add(probe.row()));
  b.hal.write_status = Status::kBusTimeout;
  ASSERT_STATUS(b.cycle(), Status::kBusTimeout);
  assert_string_equal(b.hal.diary(), "rw");
}

void a_row_that_could_never_run_is_refused(void**) {
  Bench& b = fresh_bench();
  RowProbe probe = {&b.hal, '1'};
  constexpr int kBad[][2] = {{0, 0}, {-1, 0}, {1, 1}, {1, -1}, {3, 3}, {3, -1}};
  for (const auto& [divisor, offset] : kBad)
    ASSERT_STATUS(b.executive.add(probe.row(divisor, offset)), Status::kBadValue);
  ASSERT_STATUS(b.executive.add({"nothing", 1, 0, 10, false, nullptr, &probe}), Status::kBadValue);
  ASSERT_OK(b.start());
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rw");
}

void a_row_without_a_place_is_refused_and_the_others_run(void**) {
  Bench& b = fresh_bench();
  RowProbe probe = {&b.hal, '1'};
  for (int i = 0; i < kMaxRows - 2; ++i) ASSERT_OK(b.executive.add(probe.row()));
  ASSERT_STATUS(b.executive.add(probe.row()), Status::kTooLarge);
  ASSERT_OK(b.start());
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rw111111");
}

// Proves SCH-4, LAD-2.

/// Four overruns lead to skip_optional, four more to a hold. After that the cycles are clean, or
/// the robot is rearmed.
void optional_rows_run_again_once_cycles_are_clean_and_after_a_rearm(void**) {
  constexpr struct {
    int overruns;
    bool rearms;
  } kCases[] = {{4, false}, {8, false}, {8, true}};
  for (const auto& it : kCases) {
    Bench& b = fresh_bench();
    RowProbe probe = {&b.hal, 'o'};
    Row row = probe.row();
    row.optional = true;
    ASSERT_OK(b.executive.add(row));
    ASSERT_OK(b.start());
    b.hal.read_ns = 2 * Bench::kPeriod_ns;
    for (int i = 0; i < it.overruns; ++i) static_cast<void>(b.cycle());
    b.hal.read_ns = 0;
    const int waited = it.rearms ? RestWatch::kCycles : b.pipeline.executive.clean_cycles;
    for (int i = 0; i < waited; ++i) {
      static_cast<void>(b.hal.diary());
      static_cast<void>(b.cycle());
      assert_string_equal(b.hal.diary(), "rw");
    }
    if (it.rearms) ASSERT_OK(b.executive.arm());
    static_cast<void>(b.cycle());
    assert_string_equal(b.hal.diary(), "rwo");
  }
}

// Proves EXE-7.

void every_stage_is_charged_the_time_it_took(void**) {
  Bench& b = fresh_bench();
  RowProbe probe = {&b.hal, '1'};
  probe.takes_ns = 300;
  ASSERT_OK(b.executive.add(probe.row()));
  ASSERT_OK(b.start());
  b.hal.read_ns = 100;
  b.hal.write_ns = 200;
  for (int i = 0; i < 3; ++i) ASSERT_OK(b.cycle());
  constexpr std::uint64_t kExpected[] = {100, 0, 0, 200, 300, 600};  // in the order of Stage
  for (std::size_t i = 0; i < kNames<Stage>.size(); ++i) {
    const Histogram& times = b.executive.times()->stage(static_cast<Stage>(i));
    assert_int_equal(times.count(), 3);
    assert_int_equal(times.min(), kExpected[i]);
    assert_int_equal(times.max(), kExpected[i]);
  }
}

void a_cycle_that_fails_is_timed_as_far_as_it_went(void**) {
  Bench& b = started_bench();
  b.hal.read_ns = 100;
  b.hal.write_ns = 200;
  b.hal.write_status = Status::kBusTimeout;
  ASSERT_STATUS(b.cycle(), Status::kBusTimeout);
  ASSERT_STATUS(b.cycle(), Status::kBusTimeout);  // no command any more
  constexpr std::uint64_t kCounts[] = {1, 1, 1, 1, 0, 1};
  for (std::size_t i = 0; i < kNames<Stage>.size(); ++i)
    assert_int_equal(b.executive.times()->stage(static_cast<Stage>(i)).count(), kCounts[i]);
  assert_int_equal(b.executive.times()->stage(Stage::kCycle).last(), 300);
}

void a_cycle_longer_than_the_period_is_an_overrun(void**) {
  Bench& b = started_bench();
  constexpr std::uint64_t kPeriod_ns = Bench::kPeriod_ns;
  const std::uint64_t takes_ns[] = {0, kPeriod_ns, kPeriod_ns + 1, 10 * kPeriod_ns, 5};
  for (const std::uint64_t read_ns : takes_ns) {
    b.hal.read_ns = read_ns;
    ASSERT_OK(b.cycle());
  }
  assert_int_equal(b.executive.telemetry().overruns, 2);
  assert_int_equal(b.executive.times()->stage(Stage::kCycle).count(), 5);
  ASSERT_OK(b.start());
  assert_int_equal(b.executive.telemetry().overruns, 0);
  assert_int_equal(b.executive.times()->stage(Stage::kCycle).count(), 0);
}

void without_a_stopwatch_nothing_is_timed_and_everything_runs(void**) {
  Bench& b = fresh_bench();
  static std::optional<Executive> untimed;
  untimed.emplace(b.hal, b.pipeline);
  ASSERT_OK(untimed->start());
  b.hal.read_ns = 2 * Bench::kPeriod_ns;
  ASSERT_OK(armed(*untimed, Bench::kPeriod_ns, b.now_ns));
  static_cast<void>(b.hal.diary());
  ASSERT_OK(untimed->cycle({b.now_ns + Bench::kPeriod_ns}));
  assert_string_equal(b.hal.diary(), "rw");
  assert_int_equal(untimed->telemetry().overruns, 0);
  assert_null(untimed->times());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_row_runs_in_exactly_its_cycles),
      cmocka_unit_test(rows_run_in_the_order_they_were_added),
      cmocka_unit_test(no_row_runs_in_a_cycle_that_stops_the_robot),
      cmocka_unit_test(a_row_that_could_never_run_is_refused),
      cmocka_unit_test(a_row_without_a_place_is_refused_and_the_others_run),
      cmocka_unit_test(optional_rows_run_again_once_cycles_are_clean_and_after_a_rearm),
      cmocka_unit_test(every_stage_is_charged_the_time_it_took),
      cmocka_unit_test(a_cycle_that_fails_is_timed_as_far_as_it_went),
      cmocka_unit_test(a_cycle_longer_than_the_period_is_an_overrun),
      cmocka_unit_test(without_a_stopwatch_nothing_is_timed_and_everything_runs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
