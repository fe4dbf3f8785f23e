// Tests the schedule: which rows fit the period in every frame, and which do not.
#include "kernel/pipeline/schedule.hpp"

#include "kernel/cycle/background.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves SCH-1.

// The compiler evaluates a constant schedule.
constexpr std::array<Row, 4> kConstant = {{{"control", 1, 0, 500},
                                           {"recorder", 2, 0, 200, true},
                                           {"collision", 4, 1, 400},
                                           {"watch", 8, 2, 300}}};
static_assert(judge(kConstant, 1000).ok());
static_assert(judge(kConstant, 1000).major_frame == 8);
static_assert(judge(kConstant, 999).status == Status::kOverBudget);
static_assert(judge(kConstant, 999).frame == 2 && judge(kConstant, 999).sum_us == 1000);
static_assert(judge(kConstant, 899).frame == 1 && judge(kConstant, 899).sum_us == 900);

Status nothing(void*, const RobotState&, double) {
  return Status::kOk;
}

/// The duration of every frame, counted over so many cycles that all of them repeat.
ScheduleVerdict counted(const std::array<Row, kMaxRows>& rows, std::size_t count,
                        std::int64_t period_us) {
  std::int64_t product = 1;
  for (std::size_t i = 0; i < count; ++i) product *= rows[i].divisor;
  for (std::int64_t frame = 0; frame < product; ++frame) {
    std::int64_t sum_us = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::int64_t next = rows[i].offset;  // counted, not divided
      while (next < frame) next += rows[i].divisor;
      if (next == frame) sum_us += rows[i].budget_us;
    }
    if (sum_us > period_us) return {Status::kOverBudget, -1, 0, frame, sum_us};
  }
  return {};
}

void random_tables_are_judged_as_counting_every_frame_does(void**) {
  Random random{20261121};
  int refused = 0;
  constexpr int kTables = 2000;
  for (int table = 0; table < kTables; ++table) {
    std::array<Row, kMaxRows> rows;
    const auto count = static_cast<std::size_t>(1 + random.below(4));
    for (std::size_t i = 0; i < count; ++i) {
      rows[i].divisor = 1 + random.below(6);
      rows[i].offset = random.below(rows[i].divisor);
      rows[i].budget_us = 1 + random.below(500);
    }
    const ScheduleVerdict found = judge(rows, count, 1000), expected = counted(rows, count, 1000);
    ASSERT_STATUS(found.status, expected.status);
    assert_int_equal(found.frame, expected.frame);
    assert_int_equal(found.sum_us, expected.sum_us);
    refused += expected.ok() ? 0 : 1;
  }
  assert_in_range(refused, kTables / 20, kTables / 2);
}

void a_row_that_could_never_run_or_has_no_budget_is_refused(void**) {
  constexpr int kBad[][3] = {{0, 0, 1}, {-1, 0, 1}, {1, 1, 1}, {3, 3, 1}, {3, -1, 1}, {1, 0, 0}};
  for (const auto& [divisor, offset, budget_us] : kBad) {
    Schedule schedule;
    ASSERT_STATUS(schedule.add({"bad", divisor, offset, budget_us}, 1000).status,
                  Status::kBadValue);
    assert_int_equal(schedule.count(), 0);
  }
}

void a_major_frame_that_is_too_long_is_refused(void**) {
  Schedule schedule;
  assert_true(schedule.add({"a", 1000, 0, 1}, 1000).ok());
  ASSERT_STATUS(schedule.add({"b", 999, 0, 1}, 1000).status, Status::kTooLarge);
  assert_true(schedule.add({"c", 100000, 0, 1}, 1000).ok());
  ASSERT_STATUS(schedule.add({"d", 2147483647, 0, 1}, 1000).status, Status::kTooLarge);
}

void rows_that_do_not_fit_leave_the_schedule_as_it_was(void**) {
  Schedule schedule;
  assert_true(schedule.add({"a", 1, 0, 600}, 1000).ok());
  ASSERT_STATUS(schedule.add({"b", 5, 3, 401}, 1000).status, Status::kOverBudget);
  assert_int_equal(schedule.count(), 1);
  assert_true(schedule.add({"b", 5, 3, 400}, 1000).ok());
  while (schedule.count() < kMaxRows) assert_true(schedule.add({"c", 5, 2, 1}, 1000).ok());
  ASSERT_STATUS(schedule.add({"d", 5, 2, 1}, 1000).status, Status::kTooLarge);
}

void a_row_is_bound_by_its_name(void**) {
  Schedule schedule;
  assert_true(schedule.add({"a", 1, 0, 1}, 1000).ok());
  assert_true(schedule[0].run == nullptr);
  assert_false(schedule.bind("b", nothing, nullptr));
  assert_true(schedule.bind("a", nothing, &schedule));
  assert_true(schedule[0].run == nothing && schedule[0].context == &schedule);
}

// Proves SCH-3.

void background_work_ends_before_the_next_cycle(void**) {
  struct Work {
    std::int64_t now_ns, takes_ns;
    int pieces;
  } work = {0, 30'000, 0};
  const Background background = {50,
                                 [](void* context) {
                                   Work& it = *static_cast<Work*>(context);
                                   it.now_ns += it.takes_ns;
                                   return ++it.pieces % 100 != 0;
                                 },
                                 &work};
  constexpr std::int64_t kNext_ns = 1'000'000;
  while (background.run(work.now_ns, kNext_ns)) {
  }
  assert_int_equal(work.pieces, 32);  // the last begins at 930 us: 50 us fit until 950 us
  assert_true(work.now_ns <= kNext_ns);
  assert_false(background.run(950'001, kNext_ns));
  assert_false(background.run(kNext_ns + 1, kNext_ns));
  work.pieces = 99;
  assert_false(background.run(0, kNext_ns));  // finished, with nothing left to do
  assert_int_equal(work.pieces, 100);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(random_tables_are_judged_as_counting_every_frame_does),
      cmocka_unit_test(a_row_that_could_never_run_or_has_no_budget_is_refused),
      cmocka_unit_test(a_major_frame_that_is_too_long_is_refused),
      cmocka_unit_test(rows_that_do_not_fit_leave_the_schedule_as_it_was),
      cmocka_unit_test(a_row_is_bound_by_its_name),
      cmocka_unit_test(background_work_ends_before_the_next_cycle),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
