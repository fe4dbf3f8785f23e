// The bench of the ladder's tests: an arm that follows its commands exactly, and the executive that
// takes it down the ladder.
#pragma once

#include "tests/cycle/executive_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

// Positions for the drives, and a law, not connected to them, that fails when its torque is not
// finite.
inline constexpr std::string_view kPositions = R"(
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

inline constexpr std::string_view kWithSensor = R"(
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

/// The drives reach the commanded position within the cycle.
struct FollowingArm {
  ExecutiveBench& b;
  JointVector step = JointVector::Zero();  // rad, of the last cycle

  Status cycle(double periods = 1.0) {
    const Status status = b.cycle(periods);
    if (!b.hal.enabled()) {
      b.hal.state.dq.setZero();
      return status;
    }
    step = b.hal.command.value - b.hal.state.q;
    b.hal.state.q = b.hal.command.value;
    b.hal.state.dq = step / ExecutiveBench::kPeriod_s;
    return status;
  }
  void cycles(int count, Status expected) {
    for (int i = 0; i < count; ++i) ASSERT_STATUS(cycle(), expected);
  }
};

inline ExecutiveBench& started(std::string_view text = kPositions) {
  ExecutiveBench& b = fresh_bench(text);
  ASSERT_OK(b.start());
  return b;
}

/// Moves for half a second along the line of 0.5 rad/s.
inline FollowingArm moving(ExecutiveBench& b) {
  FollowingArm arm{b};
  assert_true(b.send_line());
  arm.cycles(500, Status::kOk);
  ASSERT_NEAR(b.hal.state.dq[0], 0.5, 1e-6);
  return arm;
}

inline Event last_event(const ExecutiveBench& b) {
  Event event;
  assert_true(b.executive.events().read(b.executive.events().count() - 1, event));
  return event;
}

inline void assert_event(const ExecutiveBench& b, Cause cause, Status status, Rung from, Rung to) {
  const Event event = last_event(b);
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(cause));
  ASSERT_STATUS(event.status, status);
  assert_true(event.from == from && event.to == to && b.executive.rung() == to);
  assert_int_equal(event.cycle, b.executive.telemetry().cycles);
}

inline Report final_report(ExecutiveBench& b, std::uint32_t id) {
  Report report, found;
  int finals = 0;
  while (b.client.poll(report)) {
    if (report.id == id && report.outcome != Outcome::kStarted) {
      found = report;
      ++finals;
    }
  }
  assert_int_equal(finals, 1);
  return found;
}

}  // namespace tactus
