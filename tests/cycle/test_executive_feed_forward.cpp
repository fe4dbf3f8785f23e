// Tests how the executive sends feed-forward: with its command, and never without it.
#include "tests/cycle/executive_bench.hpp"

namespace tactus {
namespace {

constexpr std::string_view kFed = R"(
[robot]
name      = fer
period_us = 1000
q_c       = jrg.q_d
dq_ff     = jrg.dq_d
tau_ff    = model.g
[guard]
following_error = 10
[model]
type = robot_model
q    = robot.q
dq   = robot.dq
tool = robot.tool
[jrg]
type = joint_reference_generator
q    = robot.q
)";

const JointVector& output(const ExecutiveBench& b, const char* name) {
  return *static_cast<const JointVector*>(b.pipeline.ports.find(name)->value);
}

/// A bench whose arm is in motion and whose torques have reached the gravity of its model.
ExecutiveBench& moving_bench() {
  ExecutiveBench& b = fresh_bench(kFed);
  ASSERT_OK(b.start());
  assert_true(b.send_line());
  for (int k = 0; k < 300; ++k) ASSERT_OK(b.cycle());
  assert_true(b.hal.command.dq_ff[0] > 0.1 && b.hal.command.tau_ff.norm() > 1.0);
  return b;
}

// Proves EXE-10.

void a_following_drive_gets_the_feed_forward_of_its_command(void**) {
  ExecutiveBench& b = moving_bench();
  for (int k = 0; k < 200; ++k) {
    ASSERT_OK(b.cycle());
    assert_true(b.hal.command.dq_ff == output(b, "jrg.dq_d"));
    assert_true(b.hal.command.tau_ff == output(b, "model.g"));
  }
}

void a_hold_ends_the_velocity_and_a_rearm_changes_nothing(void**) {
  ExecutiveBench& b = moving_bench();
  ASSERT_STATUS(b.cycle(6.0), Status::kSlip);
  assert_true(b.executive.rung() == Rung::kHold);
  for (int k = 0; k < 1000; ++k) ASSERT_STATUS(b.cycle(), Status::kSlip);
  assert_true(b.hal.command.dq_ff.isZero(0.0));
  const RobotCommand held = b.hal.command;
  ASSERT_OK(b.executive.arm());
  for (int k = 0; k < 100; ++k) {
    ASSERT_OK(b.cycle());
    assert_true(b.hal.command.value == held.value && b.hal.command.dq_ff.isZero(0.0));
    assert_true(b.hal.command.tau_ff == held.tau_ff);
  }
}

/// Keeps every command, whatever is requested.
class WatchedHal final : public Hal {
 public:
  FakeHal inner;
  RobotCommand sent;
  Capabilities capabilities() const override { return inner.capabilities(); }
  Status connect(CommandMode mode) override { return inner.connect(mode); }
  Status read(const CycleTime& now, RobotState& state) override { return inner.read(now, state); }
  Status write(const RobotCommand& command) override { return inner.write(sent = command); }
  Status disconnect() override { return inner.disconnect(); }
};

void drives_that_do_not_follow_get_none(void**) {
  ExecutiveBench& b = moving_bench();
  static WatchedHal hal;
  hal.inner.state = b.hal.state;
  Executive executive(hal, b.pipeline);
  ASSERT_OK(executive.start());
  std::int64_t now_ns = 0;
  bool armed = false;
  for (int k = 0; k < 200; ++k) {
    if (!armed) armed = executive.arm() == Status::kOk;
    (void)executive.cycle({now_ns += 1000000});
    if (hal.sent.request != DriveRequest::kFollow) assert_true(hal.sent.tau_ff.isZero(0.0));
  }
  assert_true(armed && hal.sent.tau_ff.norm() > 1.0);
  hal.inner.state.drives[2].state = DriveState::kFault;
  hal.inner.obeys = false;
  (void)executive.cycle({now_ns += 1000000});
  assert_true(hal.sent.request == DriveRequest::kDisable);
  assert_true(hal.sent.tau_ff.isZero(0.0) && hal.sent.dq_ff.isZero(0.0));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_following_drive_gets_the_feed_forward_of_its_command),
      cmocka_unit_test(a_hold_ends_the_velocity_and_a_rearm_changes_nothing),
      cmocka_unit_test(drives_that_do_not_follow_get_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
