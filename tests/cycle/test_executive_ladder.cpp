// Tests the executive on the ladder: which rung it takes, in which cycle, and how it brakes on the
// path.
#include "tests/cycle/ladder_bench.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Proves LAD-3, LAD-2.

void an_overrun_at_any_stage_takes_every_fourth_time_one_rung(void**) {
  for (const int stage : {0, 1, 2}) {
    Bench& b = started();
    RowProbe probe = {&b.hal, '1'};
    ASSERT_OK(b.executive.add(probe.row()));
    std::uint64_t& delay_ns = stage == 0   ? b.hal.read_ns
                              : stage == 1 ? b.hal.write_ns
                                           : probe.takes_ns;
    delay_ns = Bench::kPeriod_ns + 1;
    for (int cycle = 1; cycle <= 12; ++cycle) {
      ASSERT_STATUS(b.cycle(), cycle < 8 ? Status::kOk : Status::kOverrun);
      const Rung expected = cycle < 4    ? Rung::kNominal
                            : cycle < 8  ? Rung::kSkipOptional
                            : cycle < 12 ? Rung::kHold
                                         : Rung::kStop;
      assert_true(b.executive.rung() == expected);
    }
    assert_event(b, Cause::kOverruns, Status::kOverrun, Rung::kHold, Rung::kStop);
    assert_true(last_event(b).value > 1000.0F && last_event(b).value < 1001.0F);  // us
    delay_ns = 0;
    for (int i = 0; i < RestWatch::kCycles; ++i) static_cast<void>(b.cycle());
    assert_event(b, Cause::kAtRest, Status::kOverrun, Rung::kStop, Rung::kDisabled);
    assert_int_equal(b.executive.telemetry().overruns, 12);
  }
}

void single_overruns_outside_the_window_change_nothing(void**) {
  Bench& b = started();
  for (int cycle = 0; cycle < 2000; ++cycle) {
    b.hal.read_ns = cycle % 34 == 0 ? 2 * Bench::kPeriod_ns : 0;  // 3 in any 100 cycles
    ASSERT_OK(b.cycle());
    assert_true(b.executive.rung() == Rung::kNominal);
  }
}

void optional_rows_come_back_after_a_thousand_clean_cycles_and_not_before(void**) {
  Bench& b = started();
  b.hal.read_ns = 2 * Bench::kPeriod_ns;
  for (int i = 0; i < 4; ++i) ASSERT_OK(b.cycle());
  for (const int clean : {999, 1000}) {
    b.hal.read_ns = 0;
    for (int i = 0; i < clean; ++i) {
      assert_true(b.executive.rung() == Rung::kSkipOptional);
      ASSERT_OK(b.cycle());
    }
    b.hal.read_ns = 2 * Bench::kPeriod_ns;  // one more overrun: the count of a thousand restarts
    if (clean < 1000) ASSERT_OK(b.cycle());
  }
  assert_event(b, Cause::kClean, Status::kOk, Rung::kSkipOptional, Rung::kNominal);
}

void a_delay_takes_its_rung_in_the_cycle_after_it(void**) {
  constexpr struct {
    int missed;
    Rung rung;
  } kCases[] = {{0, Rung::kNominal}, {5, Rung::kNominal}, {6, Rung::kHold},
                {10, Rung::kHold},   {11, Rung::kStop},   {100, Rung::kStop}};
  for (const auto& it : kCases) {
    Bench& b = started();
    FollowingArm arm = moving(b);
    const bool bridged = it.rung == Rung::kNominal;
    ASSERT_STATUS(arm.cycle(1.0 + it.missed), bridged ? Status::kOk : Status::kSlip);
    assert_true(b.executive.rung() == it.rung);
    if (bridged) continue;
    assert_true(last_event(b).value == static_cast<float>(it.missed));
    assert_true(last_event(b).cycle == b.armed_in + 501);
  }
}

// Proves SCH-4.

void optional_rows_are_left_out_for_overruns_and_no_others(void**) {
  Bench& b = started();
  RowProbe always = {&b.hal, 'a'}, optional = {&b.hal, 'o'};
  Row row = optional.row();
  row.optional = true;
  ASSERT_OK(b.executive.add(always.row()));
  ASSERT_OK(b.executive.add(row));
  static_cast<void>(b.hal.diary());
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rwao");
  b.hal.read_ns = 2 * Bench::kPeriod_ns;
  for (int i = 0; i < 4; ++i) ASSERT_OK(b.cycle());
  static_cast<void>(b.hal.diary());
  for (const Rung rung : {Rung::kSkipOptional, Rung::kHold}) {
    assert_true(b.executive.rung() == rung);
    for (int i = 0; i < 4; ++i) static_cast<void>(b.cycle());
    assert_string_equal(b.hal.diary(), "rwarwarwarwa");
  }
  ASSERT_OK(b.start());
  b.hal.read_ns = 0;
  ASSERT_OK(b.cycle());
  static_cast<void>(b.hal.diary());
  ASSERT_STATUS(b.cycle(7.0), Status::kSlip);  // a hold for another cause
  assert_string_equal(b.hal.diary(), "rwao");
}

void a_row_that_finds_something_stops_the_robot_and_its_overruns_are_its_own(void**) {
  Bench& b = started();
  RowProbe probe = {&b.hal, '1'};
  ASSERT_OK(b.executive.add(probe.row()));  // 10 us
  const int index = b.pipeline.schedule.count() - 1;
  for (const std::uint64_t takes_ns : {10'000U, 10'001U, 500'000U}) {
    probe.takes_ns = takes_ns;
    ASSERT_OK(b.cycle());
  }
  assert_int_equal(b.executive.times()->row_overruns(index), 2);
  assert_int_equal(b.executive.times()->row(index).max(), 500'000);
  assert_int_equal(b.executive.telemetry().overruns, 0);
  probe.status = Status::kWorkspace;
  ASSERT_STATUS(b.cycle(), Status::kWorkspace);
  assert_event(b, Cause::kRow, Status::kWorkspace, Rung::kNominal, Rung::kStop);
}

// Proves LAD-4, LAD-10.

void a_hold_brakes_on_the_path_and_refuses_references_with_its_cause(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  const Report aborted = final_report(b, 1);
  assert_true(aborted.outcome == Outcome::kAborted);
  ASSERT_STATUS(aborted.verdict.status, Status::kSlip);
  std::uint32_t id = 0;
  JointSpace::Point point;
  point.q = b.hal.state.q;
  assert_true(b.client.send(point, id).ok());
  for (int i = 0; b.executive.busy(); ++i) {
    assert_true(i < 2000);
    ASSERT_STATUS(b.executive.arm(), Status::kNotAtRest);
    ASSERT_STATUS(arm.cycle(), Status::kSlip);
    assert_true(arm.step.tail(kDof - 1).isZero(1e-12));  // only joint 1 moves along the line
  }
  Report report;
  assert_true(b.client.poll(report) && report.id == id && report.outcome == Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kSlip);
  arm.cycles(100, Status::kSlip);
  assert_true(b.executive.rung() == Rung::kHold && b.hal.stops == 0);
  assert_true(arm.step.isZero(0.0));
}

void a_brake_that_does_not_come_to_rest_goes_further_down(void**) {
  Bench& b = started();
  ASSERT_OK(b.cycle());
  b.hal.state.dq[2] = 0.02;  // creeps, so it never rests
  ASSERT_STATUS(b.cycle(7.0), Status::kSlip);
  for (int i = 1; i < 2000; ++i) {
    assert_true(b.executive.rung() == Rung::kHold);
    ASSERT_STATUS(b.cycle(), Status::kSlip);
  }
  assert_event(b, Cause::kStopTime, Status::kStopTime, Rung::kHold, Rung::kStop);
  for (int i = 0; i < 2000; ++i) ASSERT_STATUS(b.cycle(), Status::kSlip);
  assert_event(b, Cause::kStopTime, Status::kStopTime, Rung::kStop, Rung::kDisabled);
  static_cast<void>(b.cycle());
  assert_int_equal(b.hal.stops, 1);
}

void a_halt_brakes_then_disables_and_an_off_disables_at_once(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  b.executive.halt();
  assert_event(b, Cause::kHalt, Status::kHalted, Rung::kNominal, Rung::kStop);
  for (int i = 0; b.executive.rung() == Rung::kStop; ++i) {
    assert_true(i < 2000);
    ASSERT_STATUS(arm.cycle(), Status::kHalted);
  }
  assert_true(arm.step.isZero(1e-5));
  assert_event(b, Cause::kAtRest, Status::kHalted, Rung::kStop, Rung::kDisabled);
  std::uint32_t id = 0;
  JointSpace::Point point;
  point.q = b.hal.state.q;
  assert_true(b.client.send(point, id).ok());
  ASSERT_STATUS(b.cycle(), Status::kHalted);
  ASSERT_STATUS(final_report(b, id).verdict.status, Status::kHalted);

  Bench& off = started();
  ASSERT_OK(off.cycle());
  static_cast<void>(off.executive.stop());
  assert_event(off, Cause::kOff, Status::kNotStarted, Rung::kNominal, Rung::kDisabled);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_overrun_at_any_stage_takes_every_fourth_time_one_rung),
      cmocka_unit_test(single_overruns_outside_the_window_change_nothing),
      cmocka_unit_test(optional_rows_come_back_after_a_thousand_clean_cycles_and_not_before),
      cmocka_unit_test(a_delay_takes_its_rung_in_the_cycle_after_it),
      cmocka_unit_test(optional_rows_are_left_out_for_overruns_and_no_others),
      cmocka_unit_test(a_row_that_finds_something_stops_the_robot_and_its_overruns_are_its_own),
      cmocka_unit_test(a_hold_brakes_on_the_path_and_refuses_references_with_its_cause),
      cmocka_unit_test(a_brake_that_does_not_come_to_rest_goes_further_down),
      cmocka_unit_test(a_halt_brakes_then_disables_and_an_off_disables_at_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
