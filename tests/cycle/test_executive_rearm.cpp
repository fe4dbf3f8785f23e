// Tests the way up from disabled and from a hold: what is taken over, what is void, and what a hold
// watches while it lasts.
#include <string>

#include "tests/cycle/ladder_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

// Proves LAD-6.

/// Sends a point that nobody has seen before the arm is taken over, and returns its number.
std::uint32_t send_early_point(Bench& b) {
  JointSpace::Point point;
  point.q = b.hal.state.q + JointVector::Constant(0.5);
  std::uint32_t id = 0;
  assert_true(b.client.send(point, id).ok());
  return id;
}

void assert_moves_again(FollowingArm& arm, std::uint32_t early) {
  assert_true(final_report(arm.b, early).outcome == Outcome::kRefused);
  assert_true(arm.b.send_line());
  for (int i = 0; i < 100; ++i) ASSERT_OK(arm.cycle());
  assert_true(arm.b.hal.state.dq[0] > 0.1);
}

void from_disabled_the_reference_is_the_measured_state_and_old_targets_are_void(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  ASSERT_STATUS(arm.cycle(50.0), Status::kSlip);
  while (b.executive.busy()) ASSERT_STATUS(arm.cycle(), Status::kSlip);
  assert_true(b.executive.rung() == Rung::kDisabled && b.hal.stops == 1);
  final_report(b, 1);
  const std::uint32_t early = send_early_point(b);
  b.hal.state.q[0] -= 0.1;  // pushed while it was disabled
  ASSERT_OK(armed(b.executive, Bench::kPeriod_ns, b.now_ns));
  assert_event(b, Cause::kRearm, Status::kOk, Rung::kArming, Rung::kNominal);
  ASSERT_OK(b.cycle());
  assert_true(b.reference() == b.hal.state.q[0]);
  assert_true(b.hal.command.value == b.hal.state.q);
  assert_moves_again(arm, early);
}

void from_a_hold_no_command_changes_and_old_targets_are_void(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  while (b.executive.busy()) ASSERT_STATUS(arm.cycle(), Status::kSlip);
  assert_true(b.executive.rung() == Rung::kHold);
  final_report(b, 1);
  const std::uint32_t early = send_early_point(b);
  b.hal.state.q[0] -= 1e-3;  // the drives are off their target
  const JointVector sent = b.hal.command.value;
  ASSERT_STATUS(b.cycle(), Status::kSlip);
  ASSERT_OK(b.executive.arm());
  assert_event(b, Cause::kRearm, Status::kOk, Rung::kHold, Rung::kNominal);
  for (int i = 0; i < 100; ++i) {
    ASSERT_OK(b.cycle());
    assert_true(b.hal.command.value == sent);
  }
  assert_moves_again(arm, early);
}

/// A point a radian away, forwarded at once, is followed by the guard at its own pace.
void a_target_that_the_guard_had_not_reached_is_void_after_a_rearm(void**) {
  std::string text(kPositions);
  text.insert(text.find("[jrg]\n") + 6, "online = forward\n");
  Bench& b = started(text);
  FollowingArm arm{b};
  JointSpace::Point point;
  point.q = b.hal.state.q + JointVector::Unit(0);
  std::uint32_t id = 0;
  assert_true(b.client.send(point, id).ok());
  for (int i = 0; i < 100; ++i) ASSERT_OK(arm.cycle());
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  while (b.executive.busy()) ASSERT_STATUS(arm.cycle(), Status::kSlip);
  const JointVector sent = b.hal.command.value;
  assert_true(b.reference() - sent[0] > 0.3);
  b.hal.state.q[1] -= 1e-3;  // the drives are off their target
  ASSERT_STATUS(b.cycle(), Status::kSlip);
  ASSERT_OK(b.executive.arm());
  for (int i = 0; i < 500; ++i) {
    ASSERT_OK(b.cycle());
    assert_true(b.hal.command.value == sent);
  }
  assert_true(b.send_line());
  for (int i = 0; i < 100; ++i) ASSERT_OK(arm.cycle());
  assert_true(b.hal.command.value[0] > sent[0]);
}

/// 20 N m that a spring of 100 N m/rad holds 0.2 rad beside its reference.
void a_load_is_held_through_a_rearm_without_a_step_of_the_torque(void**) {
  Bench& b = started(kExecutivePipeline);
  b.hal.state.q[1] -= 0.2;
  for (int i = 0; i < 100; ++i) ASSERT_OK(b.cycle());
  ASSERT_NEAR(b.hal.command.value[1], 20.0, 1e-9);
  ASSERT_STATUS(b.cycle(60.0), Status::kSlip);
  for (int i = 0; i < 2 * RestWatch::kCycles; ++i) ASSERT_STATUS(b.cycle(), Status::kSlip);
  ASSERT_OK(b.executive.arm());
  for (int i = 0; i < 100; ++i) {
    ASSERT_OK(b.cycle());
    ASSERT_NEAR(b.hal.command.value[1], 20.0, 1e-9);
  }
}

// The tip follows, velocities go to the drives.
constexpr std::string_view kTip = R"(
[robot]
name      = fer
period_us = 1000
dq_c      = cpc.dq_c
[executive]
max_slip  = 5
[model]
type = robot_model
q    = robot.q
dq   = robot.dq
[jrg]
type = joint_reference_generator
q    = robot.q
[cpc]
type = cartesian_pose
x_d  = jrg.x_d
v_d  = jrg.v_d
x    = model.x
J    = model.J
q    = robot.q
position_gain = 3 3 3
rotation_gain = 3 3 3
)";

/// Rest is a velocity below a threshold; the chain may still command less than that.
void a_rearm_waits_until_the_command_does_not_move(void**) {
  for (const int cycles : {60, 400, 800}) {
    Bench& b = fresh_bench(kTip);
    ASSERT_OK(b.start());
    JointSpace::Point point;
    point.q = b.hal.state.q + JointVector::Constant(0.2);
    std::uint32_t id = 0;
    assert_true(b.client.send(point, id).ok());
    JointVector last = JointVector::Zero();
    const auto cycle = [&](double periods) {
      last = b.hal.command.value;
      static_cast<void>(b.cycle(periods));
      b.hal.state.dq = b.hal.command.value;
      b.hal.state.q += Bench::kPeriod_s * b.hal.state.dq;
    };
    for (int k = 0; k < cycles; ++k) cycle(1.0);
    cycle(7.0);
    for (int k = 0; b.executive.arm() != Status::kOk; ++k) {
      assert_true(k < 3000);
      cycle(1.0);
    }
    cycle(1.0);
    assert_true((b.hal.command.value - last).cwiseAbs().maxCoeff() <= 1e-3);
  }
}

void a_rearm_waits_for_rest_however_often_the_arm_has_been_at_rest(void**) {
  Bench& b = started();
  FollowingArm arm{b};
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  arm.cycles(50, Status::kSlip);
  b.hal.state.dq[2] = 0.015;  // creeps: less than leaves the hold, more than rest
  for (int i = 0; i < 2 * RestWatch::kCycles; ++i) ASSERT_STATUS(b.cycle(), Status::kSlip);
  assert_true(b.executive.rung() == Rung::kHold);
  ASSERT_STATUS(b.executive.arm(), Status::kNotAtRest);
  b.hal.state.dq[2] = 0.0;
  for (int i = 0; i < 2 * RestWatch::kCycles; ++i) ASSERT_STATUS(b.cycle(), Status::kSlip);
  ASSERT_OK(b.executive.arm());
}

void an_arm_that_is_moved_while_it_is_held_is_stopped(void**) {
  Bench& b = started();
  FollowingArm arm{b};
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  arm.cycles(50, Status::kSlip);
  b.hal.state.dq[2] = 0.03;
  for (int i = 0; b.executive.rung() == Rung::kHold; ++i) {
    assert_true(i < 2 * RestWatch::kCycles);
    ASSERT_STATUS(b.cycle(), Status::kSlip);
  }
  assert_event(b, Cause::kMoved, Status::kMoved, Rung::kHold, Rung::kStop);
}

void noise_at_the_threshold_leaves_a_hold_a_hold(void**) {
  Bench& b = started();
  FollowingArm arm{b};
  Random random{3};
  ASSERT_STATUS(arm.cycle(7.0), Status::kSlip);
  for (int i = 0; i < 20000; ++i) {
    for (double& dq : b.hal.state.dq)  // a standard deviation of 0.01 rad/s, which is the threshold
      dq = 0.01 * std::sqrt(3.0) * random.uniform(-1.0, 1.0);
    ASSERT_STATUS(b.cycle(), Status::kSlip);
    assert_true(b.executive.rung() == Rung::kHold);
  }
  assert_false(b.executive.busy());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(from_disabled_the_reference_is_the_measured_state_and_old_targets_are_void),
      cmocka_unit_test(from_a_hold_no_command_changes_and_old_targets_are_void),
      cmocka_unit_test(a_target_that_the_guard_had_not_reached_is_void_after_a_rearm),
      cmocka_unit_test(a_load_is_held_through_a_rearm_without_a_step_of_the_torque),
      cmocka_unit_test(a_rearm_waits_until_the_command_does_not_move),
      cmocka_unit_test(a_rearm_waits_for_rest_however_often_the_arm_has_been_at_rest),
      cmocka_unit_test(an_arm_that_is_moved_while_it_is_held_is_stopped),
      cmocka_unit_test(noise_at_the_threshold_leaves_a_hold_a_hold),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
