// The executive without its chain, and on the way up again.
#include "tests/ladder_bench.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

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
