// Tests the executive: the order of a cycle's stages, and the errors that disable the drives.
#include "kernel/cycle/executive.hpp"

#include "tests/cycle/executive_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Proves EXE-1.

void a_cycle_reads_then_writes_then_runs_the_rows_once_each(void**) {
  Bench& b = started_bench();
  RowProbe first = {&b.hal, '1'}, second = {&b.hal, '2'};
  ASSERT_OK(b.executive.add(first.row()));
  ASSERT_OK(b.executive.add(second.row()));
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rw12");
}

void what_is_written_comes_from_the_state_read_in_the_same_cycle(void**) {
  Bench& b = started_bench();
  b.hal.state.q[0] -= 0.005;  // 100 * 0.005 = 0.5 N m back
  ASSERT_OK(b.cycle());
  assert_true(b.hal.command.mode == CommandMode::kEffort);
  ASSERT_NEAR(b.hal.command.value[0], 0.5, 1e-12);
}

// Proves EXE-1, GRD-3.

void what_is_written_has_passed_the_guard(void**) {
  Bench& b = started_bench();
  b.hal.state.q[0] -= 1.0;  // a step of 100 N m, where 1 N m per cycle is allowed
  ASSERT_OK(b.cycle());
  ASSERT_NEAR(b.hal.command.value[0], 1.0, 1e-12);
  assert_int_equal(b.executive.guard().telemetry().limited_cycles, 1);
}

// Proves EXE-1, GRD-4.

/// Drives the arm towards a position limit with a braking distance that depends on its position.
/// The test's own guard gives the expected command.
void velocities_are_limited_by_the_position_read_in_the_same_cycle(void**) {
  Bench& b = fresh_bench(kVelocities);
  ASSERT_OK(b.start());
  static Guard guard;
  ASSERT_OK(guard.start(b.pipeline.guard, CommandMode::kVelocity, b.hal.state, Bench::kPeriod_s,
                        {b.now_ns}));
  JointSpace::Point point;
  point.q = b.hal.state.q;
  point.dq[0] = 2.0;
  std::uint32_t id = 0;
  assert_true(b.client.send(point, id).ok());
  int limited = 0;
  for (int i = 0; i < 5000 && (i < 100 || b.hal.state.dq[0] > 0.1); ++i) {
    ASSERT_OK(b.cycle());
    RobotCommand expected = {CommandMode::kVelocity, point.dq};
    ASSERT_OK(guard.limit(b.hal.state, expected));
    limited += expected.value[0] != 2.0;
    assert_true(b.hal.command.mode == CommandMode::kVelocity);
    assert_true(b.hal.command.value == expected.value);
    b.hal.state.dq = b.hal.command.value;
    b.hal.state.q += Bench::kPeriod_s * b.hal.state.dq;
  }
  assert_true(b.hal.state.dq[0] <= 0.1 && limited > 200);
  ASSERT_NEAR(b.hal.state.q[0], b.pipeline.guard.limits.q_max[0], 1e-3);
}

// Proves EXE-2.

void a_start_connects_and_arming_moves_nothing(void**) {
  Bench& b = fresh_bench();
  ASSERT_OK(b.executive.start());
  assert_string_equal(b.hal.diary(), "s");
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  assert_string_equal(b.hal.diary(), "rd");
  ASSERT_STATUS(b.executive.arm(), Status::kArming);
  ASSERT_STATUS(b.cycle(), Status::kArming);
  assert_string_equal(b.hal.diary(), "ra");
  ASSERT_OK(armed(b.executive, Bench::kPeriod_ns, b.now_ns));
  assert_int_equal(b.hal.writes, 0);
  ASSERT_OK(b.cycle());
  assert_true(b.reference() == b.hal.state.q[0]);
  assert_true(b.hal.command.value.isZero(0.0));
}

void after_a_stop_the_exchange_goes_on_but_moves_nothing(void**) {
  Bench& b = started_bench();
  ASSERT_OK(b.cycle());
  b.hal.disconnect_status = Status::kBusTimeout;  // what the wire knows of the drives
  ASSERT_STATUS(b.executive.stop(), Status::kBusTimeout);
  assert_false(b.hal.enabled());
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  assert_string_equal(b.hal.diary(), "rwrd");
}

void after_a_restart_the_reference_is_the_measured_state_and_the_old_motion_is_void(void**) {
  Bench& b = started_bench();
  assert_true(b.send_line());
  for (int i = 0; i < 10; ++i) ASSERT_OK(b.cycle());
  assert_true(b.reference() > b.hal.state.q[0]);
  ASSERT_STATUS(b.cycle(200.0), Status::kSlip);

  b.hal.state.q[0] += 0.3;  // pushed while it was off
  b.now_ns = 0;             // and the clock began anew
  ASSERT_OK(b.start());
  assert_int_equal(b.executive.telemetry().slips, 0);
  assert_int_equal(b.executive.times()->stage(Stage::kCycle).count(), 0);
  for (int i = 0; i < 10; ++i) {
    ASSERT_OK(b.cycle());
    assert_true(b.reference() == b.hal.state.q[0]);
    assert_true(b.hal.command.value.isZero(0.0));
  }
}

// Proves EXE-5, GRD-1.

void a_measured_number_that_is_not_finite_stops_the_robot_at_any_joint(void**) {
  for (JointVector RobotState::*field : {&RobotState::q, &RobotState::dq, &RobotState::tau}) {
    for (int i = 0; i < kDof; ++i) {
      Bench& b = started_bench();
      ASSERT_OK(b.cycle());
      (b.hal.state.*field)[i] = std::nan("");
      ASSERT_STATUS(b.cycle(), Status::kStateNotFinite);
      assert_string_equal(b.hal.diary(), "rwrd");
      assert_int_equal(b.executive.guard().telemetry().tripped_joint, i);
      assert_stopped(b, Status::kStateNotFinite);
    }
  }
}

// Proves EXE-5.

void an_error_of_the_wire_is_latched(void**) {
  Bench& reading = started_bench();
  reading.hal.read_status = Status::kConnectionLost;
  ASSERT_STATUS(reading.cycle(), Status::kConnectionLost);
  assert_string_equal(reading.hal.diary(), "rd");
  reading.hal.read_status = Status::kOk;
  assert_stopped(reading, Status::kConnectionLost);

  Bench& writing = started_bench();
  writing.hal.write_status = Status::kBusTimeout;
  ASSERT_STATUS(writing.cycle(), Status::kBusTimeout);
  assert_string_equal(writing.hal.diary(), "rw");
  assert_stopped(writing, Status::kBusTimeout);
}

void a_robot_that_cannot_be_reached_or_taken_over_is_not_commanded(void**) {
  Bench& refusing = fresh_bench();
  refusing.hal.connect_status = Status::kConnectionLost;
  ASSERT_STATUS(refusing.executive.start(), Status::kConnectionLost);
  ASSERT_STATUS(refusing.executive.arm(), Status::kConnectionLost);
  assert_int_equal(refusing.executive.events().count(), 2);

  Bench& outside = fresh_bench();
  outside.hal.state.q[3] = 1.0;  // beyond its upper limit of -0.0698
  ASSERT_STATUS(outside.start(), Status::kMeasuredPositionLimit);
  assert_stopped(outside, Status::kMeasuredPositionLimit);
}

void a_stop_by_hand_keeps_the_cause_of_an_earlier_one(void**) {
  Bench& b = started_bench();
  b.hal.read_status = Status::kConnectionLost;
  ASSERT_STATUS(b.cycle(), Status::kConnectionLost);
  static_cast<void>(b.executive.stop());
  ASSERT_STATUS(b.cycle(), Status::kConnectionLost);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cycle_reads_then_writes_then_runs_the_rows_once_each),
      cmocka_unit_test(what_is_written_comes_from_the_state_read_in_the_same_cycle),
      cmocka_unit_test(what_is_written_has_passed_the_guard),
      cmocka_unit_test(velocities_are_limited_by_the_position_read_in_the_same_cycle),
      cmocka_unit_test(a_start_connects_and_arming_moves_nothing),
      cmocka_unit_test(after_a_stop_the_exchange_goes_on_but_moves_nothing),
      cmocka_unit_test(
          after_a_restart_the_reference_is_the_measured_state_and_the_old_motion_is_void),
      cmocka_unit_test(a_measured_number_that_is_not_finite_stops_the_robot_at_any_joint),
      cmocka_unit_test(an_error_of_the_wire_is_latched),
      cmocka_unit_test(a_robot_that_cannot_be_reached_or_taken_over_is_not_commanded),
      cmocka_unit_test(a_stop_by_hand_keeps_the_cause_of_an_earlier_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
