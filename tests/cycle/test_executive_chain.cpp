// Tests the executive without its chain: the guard brakes positions and velocities, efforts are
// disabled, and a wire that fails disables the drives in every mode.
#include <utility>

#include "tests/cycle/ladder_bench.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Proves LAD-5.

/// The guard brakes joint 1 at its acceleration limit; at rest the drives are disabled.
void assert_braked_by_the_guard(FollowingArm& arm, Status status) {
  const JointLimits limits;
  const double change = limits.ddq_max[0] * Bench::kPeriod_s * Bench::kPeriod_s;
  double step = 0.5 * Bench::kPeriod_s;
  for (; step > 1e-9; step = std::max(0.0, step - change)) {
    ASSERT_NEAR(arm.step[0], std::max(0.0, step - change), 1e-9);
    assert_true(arm.b.executive.rung() == Rung::kStop && arm.b.hal.stops == 0);
    ASSERT_STATUS(arm.cycle(), status);
  }
  for (int i = 0; i < 2 * RestWatch::kCycles + 10 && arm.b.hal.stops == 0; ++i)
    ASSERT_STATUS(arm.cycle(), status);
  assert_int_equal(arm.b.hal.stops, 1);
}

void a_stage_error_in_positions_is_braked_by_the_guard(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  b.hal.state.dq[5] = 2.0;  // 2e308 N m: the law's torque is not finite
  ASSERT_STATUS(arm.cycle(), Status::kCommandNotFinite);
  assert_event(b, Cause::kStage, Status::kCommandNotFinite, Rung::kNominal, Rung::kStop);
  assert_braked_by_the_guard(arm, Status::kCommandNotFinite);
}

void a_sensor_at_fault_is_braked_by_the_guard(void**) {
  Bench& b = started(kWithSensor);
  FollowingArm arm = moving(b);
  b.hal.state.ft[2] = std::nan("");
  ASSERT_STATUS(arm.cycle(), Status::kSensorNotFinite);
  assert_event(b, Cause::kSensor, Status::kSensorNotFinite, Rung::kNominal, Rung::kStop);
  assert_braked_by_the_guard(arm, Status::kSensorNotFinite);
}

void a_state_that_is_no_number_is_braked_by_the_guard_from_what_was_sent(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
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

/// Keeps the state that the row receives.
struct StateProbe {
  RobotState seen;
  static Status run(void* probe, const RobotState& measured, double) {
    static_cast<StateProbe*>(probe)->seen = measured;
    return Status::kOk;
  }
};

void ports_and_rows_are_given_the_last_state_that_was_finite(void**) {
  for (JointVector RobotState::*field : {&RobotState::q, &RobotState::dq, &RobotState::tau}) {
    Bench& b = started();
    StateProbe probe;
    ASSERT_OK(b.executive.add({"probe", 1, 0, 10, false, StateProbe::run, &probe}));
    moving(b);
    const RobotState before = b.hal.state;
    ASSERT_OK(b.cycle());
    (b.hal.state.*field)[5] = std::nan("");
    for (int i = 0; i < 3; ++i) {
      ASSERT_STATUS(b.cycle(), Status::kStateNotFinite);
      assert_true(probe.seen.q == before.q && probe.seen.dq == before.dq);
      assert_true(probe.seen.tau == before.tau);
      for (const auto& [port, value] :
           {std::pair("robot.q", before.q), {"robot.dq", before.dq}, {"robot.tau", before.tau}})
        assert_true(*static_cast<const JointVector*>(b.pipeline.ports.find(port)->value) == value);
    }
  }
}

void a_robot_that_does_not_follow_is_braked_by_the_guard(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
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
  assert_string_equal(state.hal.diary(), "rd");  // no command is sent any more
}

// Proves LAD-1, LAD-5.

/// A lost wire leaves no way to brake, in any command mode.
void a_wire_that_fails_disables_the_drives_in_every_mode(void**) {
  for (const std::string_view text : {kPositions, kVelocities, kExecutivePipeline}) {
    for (const bool reading : {true, false}) {
      Bench& b = started(text);
      ASSERT_OK(b.cycle());
      static_cast<void>(b.hal.diary());
      (reading ? b.hal.read_status : b.hal.write_status) = Status::kBusTimeout;
      ASSERT_STATUS(b.cycle(), Status::kBusTimeout);
      assert_event(b, Cause::kWire, Status::kBusTimeout, Rung::kNominal, Rung::kDisabled);
      assert_string_equal(b.hal.diary(), reading ? "rd" : "rw");
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_stage_error_in_positions_is_braked_by_the_guard),
      cmocka_unit_test(a_sensor_at_fault_is_braked_by_the_guard),
      cmocka_unit_test(a_state_that_is_no_number_is_braked_by_the_guard_from_what_was_sent),
      cmocka_unit_test(ports_and_rows_are_given_the_last_state_that_was_finite),
      cmocka_unit_test(a_robot_that_does_not_follow_is_braked_by_the_guard),
      cmocka_unit_test(efforts_without_a_chain_are_disabled_in_the_same_cycle),
      cmocka_unit_test(a_wire_that_fails_disables_the_drives_in_every_mode),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
