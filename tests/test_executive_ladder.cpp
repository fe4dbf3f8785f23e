// The executive on the ladder: which rung it takes, in which cycle, how it brakes, how it comes
// back.
#include "tests/executive_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Positions for the drives; beside them a law that fails when its torque is not finite.
constexpr std::string_view kPositions = R"(
[robot]
name      = fer
period_us = 1000
q_c       = jrg.q_d
[executive]
max_slip  = 5
stop_ms   = 2000
[jrg]
type = joint_reference_generator
q    = robot.q
[pd]
type = pd_gravity
q_d  = jrg.q_d
q    = robot.q
dq   = robot.dq
kp   = 1
kd   = 1e308
)";

constexpr std::string_view kWithSensor = R"(
[robot]
name      = fer
period_us = 1000
q_c       = jrg.q_d
[jrg]
type = joint_reference_generator
q    = robot.q
[model]
type = robot_model
q    = robot.q
dq   = robot.dq
[ft]
type = wrench_front_end
ft   = robot.ft
x    = model.x
tool = robot.tool
stuck_s = 0
max_force = 100
max_moment = 10
tare_s = 0
)";

/// The drives do in a cycle what they are told.
struct Arm {
  Bench& b;
  JointVector step = JointVector::Zero();  // rad, of the last cycle

  Status cycle(double periods = 1.0) {
    const Status status = b.cycle(periods);
    if (b.hal.stops > 0) return b.hal.state.dq.setZero(), status;
    step = b.hal.command.value - b.hal.state.q;
    b.hal.state.q = b.hal.command.value;
    b.hal.state.dq = step / Bench::kPeriod_s;
    return status;
  }
  void cycles(int count, Status expected) {
    for (int i = 0; i < count; ++i) ASSERT_STATUS(cycle(), expected);
  }
};

Bench& started(std::string_view text = kPositions) {
  Bench& b = fresh_bench(text);
  ASSERT_OK(b.executive.start());
  return b;
}

/// Half a second along the line of 0.5 rad/s.
Arm moving(Bench& b) {
  Arm arm{b};
  assert_true(b.send_line());
  arm.cycles(500, Status::kOk);
  ASSERT_NEAR(b.hal.state.dq[0], 0.5, 1e-6);
  return arm;
}

Event last_event(const Bench& b) {
  Event event;
  assert_true(b.executive.events().read(b.executive.events().count() - 1, event));
  return event;
}

void assert_event(const Bench& b, Cause cause, Status status, Rung from, Rung to) {
  const Event event = last_event(b);
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(cause));
  ASSERT_STATUS(event.status, status);
  assert_true(event.from == from && event.to == to && b.executive.rung() == to);
  assert_int_equal(event.cycle, b.executive.telemetry().cycles);
}

Report final_report(Bench& b, std::uint32_t id) {
  Report report, found;
  int finals = 0;
  while (b.client.poll(report)) {
    if (report.id == id && report.outcome != Outcome::kStarted) found = report, ++finals;
  }
  assert_int_equal(finals, 1);
  return found;
}

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
    b.hal.read_ns = 2 * Bench::kPeriod_ns;  // one more: the thousand begin anew
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
    Arm arm = moving(b);
    const bool bridged = it.rung == Rung::kNominal;
    ASSERT_STATUS(arm.cycle(1.0 + it.missed), bridged ? Status::kOk : Status::kSlip);
    assert_true(b.executive.rung() == it.rung);
    if (bridged) continue;
    assert_true(last_event(b).value == static_cast<float>(it.missed));
    assert_true(last_event(b).cycle == 501);
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
  ASSERT_OK(b.executive.start());
  b.hal.read_ns = 0;
  ASSERT_OK(b.cycle());
  static_cast<void>(b.hal.diary());
  ASSERT_STATUS(b.cycle(7.0), Status::kSlip);  // a hold is recorded, but for overruns
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
  assert_int_equal(b.executive.timing().row_overruns(index), 2);
  assert_int_equal(b.executive.timing().row(index).max(), 500'000);
  assert_int_equal(b.executive.telemetry().overruns, 0);
  probe.status = Status::kWorkspace;
  ASSERT_STATUS(b.cycle(), Status::kWorkspace);
  assert_event(b, Cause::kRow, Status::kWorkspace, Rung::kNominal, Rung::kStop);
}

// Proves LAD-4, LAD-10.

void a_hold_brakes_on_the_path_and_refuses_references_with_its_cause(void**) {
  Bench& b = started();
  Arm arm = moving(b);
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  const Report aborted = final_report(b, 1);
  assert_true(aborted.outcome == Outcome::kAborted);
  ASSERT_STATUS(aborted.verdict.status, Status::kSlip);
  std::uint32_t id = 0;
  JointSpace::Point point;
  point.q = b.hal.state.q;
  assert_true(b.client.send(point, id).ok());
  for (int i = 0; b.executive.braking(); ++i) {
    assert_true(i < 2000);
    ASSERT_STATUS(b.executive.rearm(), Status::kNotAtRest);
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
  b.hal.state.dq[2] = 0.02;  // creeps
  ASSERT_STATUS(b.cycle(7.0), Status::kSlip);
  for (int i = 1; i < 2000; ++i) {
    assert_true(b.executive.rung() == Rung::kHold);
    ASSERT_STATUS(b.cycle(), Status::kSlip);
  }
  assert_event(b, Cause::kStopTime, Status::kStopTime, Rung::kHold, Rung::kStop);
  for (int i = 0; i < 2000; ++i) ASSERT_STATUS(b.cycle(), Status::kSlip);
  assert_event(b, Cause::kStopTime, Status::kStopTime, Rung::kStop, Rung::kDisabled);
  assert_int_equal(b.hal.stops, 1);
}

void a_halt_brakes_then_disables_and_an_off_disables_at_once(void**) {
  Bench& b = started();
  Arm arm = moving(b);
  b.executive.halt();
  assert_event(b, Cause::kHalt, Status::kHalted, Rung::kNominal, Rung::kStop);
  for (int i = 0; b.hal.stops == 0; ++i) {
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
  off.executive.stop();
  assert_event(off, Cause::kOff, Status::kNotStarted, Rung::kNominal, Rung::kDisabled);
}

// Proves LAD-5.

/// From now on the guard brakes joint 1, by its acceleration limit; the drives are disabled at
/// rest.
void assert_braked_by_the_guard(Arm& arm, Status status) {
  const JointLimits limits;
  const double change = limits.ddq_max[0] * Bench::kPeriod_s * Bench::kPeriod_s;
  double step = 0.5 * Bench::kPeriod_s;
  for (; step > 1e-9; step = std::max(0.0, step - change)) {
    ASSERT_NEAR(arm.step[0], std::max(0.0, step - change), 1e-9);
    assert_true(arm.b.executive.rung() == Rung::kStop && arm.b.hal.stops == 0);
    ASSERT_STATUS(arm.cycle(), status);
  }
  for (int i = 0; i < RestWatch::kCycles + 10 && arm.b.hal.stops == 0; ++i)
    ASSERT_STATUS(arm.cycle(), status);
  assert_int_equal(arm.b.hal.stops, 1);
}

void a_stage_error_in_positions_is_braked_by_the_guard(void**) {
  Bench& b = started();
  Arm arm = moving(b);
  b.hal.state.dq[5] = 2.0;  // 2e308 N m: the law's torque is not finite
  ASSERT_STATUS(arm.cycle(), Status::kCommandNotFinite);
  assert_event(b, Cause::kStage, Status::kCommandNotFinite, Rung::kNominal, Rung::kStop);
  assert_braked_by_the_guard(arm, Status::kCommandNotFinite);
}

void a_sensor_at_fault_is_braked_by_the_guard(void**) {
  Bench& b = started(kWithSensor);
  Arm arm = moving(b);
  b.hal.state.ft[2] = std::nan("");
  ASSERT_STATUS(arm.cycle(), Status::kSensorNotFinite);
  assert_event(b, Cause::kSensor, Status::kSensorNotFinite, Rung::kNominal, Rung::kStop);
  assert_braked_by_the_guard(arm, Status::kSensorNotFinite);
}

void a_state_that_is_no_number_is_braked_by_the_guard_from_what_was_sent(void**) {
  Bench& b = started();
  Arm arm = moving(b);
  const JointVector q = b.hal.state.q;
  b.hal.state.dq[5] = std::nan("");
  ASSERT_STATUS(b.cycle(), Status::kStateNotFinite);
  assert_event(b, Cause::kState, Status::kStateNotFinite, Rung::kNominal, Rung::kStop);
  assert_int_equal(last_event(b).joint, 5);
  arm.step = b.hal.command.value - q;
  b.hal.state.q = b.hal.command.value;
  b.hal.state.dq = arm.step / Bench::kPeriod_s;
  assert_braked_by_the_guard(arm, Status::kStateNotFinite);
}

void a_robot_that_does_not_follow_is_braked_by_the_guard(void**) {
  Bench& b = started();
  Arm arm = moving(b);
  const JointVector sent = b.hal.command.value;
  b.hal.state.q[0] -= 0.2;
  ASSERT_STATUS(b.cycle(), Status::kFollowingError);
  assert_event(b, Cause::kState, Status::kFollowingError, Rung::kNominal, Rung::kStop);
  arm.step = b.hal.command.value - sent;
  b.hal.state.q = b.hal.command.value;
  assert_braked_by_the_guard(arm, Status::kFollowingError);
}

void efforts_without_a_chain_are_disabled_in_the_same_cycle(void**) {
  Bench& state = started(kExecutivePipeline);
  state.hal.state.q[0] = std::nan("");
  ASSERT_STATUS(state.cycle(), Status::kStateNotFinite);
  assert_event(state, Cause::kState, Status::kStateNotFinite, Rung::kNominal, Rung::kDisabled);
  assert_string_equal(state.hal.diary(), "srx");  // nothing more is sent
}

// Proves LAD-6.

void after_a_rearm_the_reference_is_the_measured_state_and_old_targets_are_void(void**) {
  for (const bool disabled : {false, true}) {
    Bench& b = started();
    Arm arm = moving(b);
    ASSERT_STATUS(arm.cycle(disabled ? 50.0 : 7.0), Status::kSlip);
    for (int i = 0; b.executive.braking(); ++i) ASSERT_STATUS(arm.cycle(), Status::kSlip);
    assert_true(b.executive.rung() == (disabled ? Rung::kDisabled : Rung::kHold));
    final_report(b, 1);
    std::uint32_t id = 0;
    JointSpace::Point point;
    point.q = b.hal.state.q + JointVector::Constant(0.5);
    assert_true(b.client.send(point, id).ok());  // nobody has seen it before the rearm
    b.hal.state.q[0] -= 1e-3;                    // pushed while it held
    const JointVector held = b.hal.state.q, sent = b.hal.command.value;
    b.hal.stops = 0;
    if (!disabled) static_cast<void>(b.cycle());  // what is measured in the next cycle
    ASSERT_OK(b.executive.rearm());
    assert_event(b, Cause::kRearm, Status::kOk, disabled ? Rung::kDisabled : Rung::kHold,
                 Rung::kNominal);
    ASSERT_OK(b.cycle());
    assert_true(b.reference() == held[0]);
    const double change = JointLimits().ddq_max[0] * Bench::kPeriod_s * Bench::kPeriod_s + 1e-12;
    assert_true(std::abs(b.hal.command.value[0] - (disabled ? held : sent)[0]) <= change);
    const Report refused = final_report(b, id);
    assert_true(refused.outcome == Outcome::kRefused);
    assert_true(b.send_line());
    for (int i = 0; i < 100; ++i) ASSERT_OK(arm.cycle());
    assert_true(b.hal.state.dq[0] > 0.1);
  }
}

void a_rearm_that_finds_something_wrong_leaves_the_rung(void**) {
  Bench& b = started();
  Arm arm{b};
  ASSERT_OK(b.executive.rearm());  // nothing to do
  b.hal.write_status = Status::kConnectionLost;
  ASSERT_STATUS(b.cycle(), Status::kConnectionLost);
  assert_event(b, Cause::kWire, Status::kConnectionLost, Rung::kNominal, Rung::kDisabled);
  b.hal.start_status = Status::kDriveFault;
  ASSERT_STATUS(b.executive.rearm(), Status::kDriveFault);
  assert_true(b.executive.rung() == Rung::kDisabled);
  ASSERT_STATUS(b.cycle(), Status::kConnectionLost);
  b.hal.start_status = b.hal.write_status = Status::kOk;
  ASSERT_OK(b.executive.rearm());
  b.hal.stops = 0;
  ASSERT_OK(arm.cycle(1000.0));  // a clock that went on meanwhile is no slip
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
      cmocka_unit_test(a_stage_error_in_positions_is_braked_by_the_guard),
      cmocka_unit_test(a_sensor_at_fault_is_braked_by_the_guard),
      cmocka_unit_test(a_state_that_is_no_number_is_braked_by_the_guard_from_what_was_sent),
      cmocka_unit_test(a_robot_that_does_not_follow_is_braked_by_the_guard),
      cmocka_unit_test(efforts_without_a_chain_are_disabled_in_the_same_cycle),
      cmocka_unit_test(after_a_rearm_the_reference_is_the_measured_state_and_old_targets_are_void),
      cmocka_unit_test(a_rearm_that_finds_something_wrong_leaves_the_rung),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
