// An arm that does what it is told, and the executive that takes it down the ladder: the bench of
// the tests of both ways.
#pragma once

#include "tests/executive_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {

// Positions for the drives; beside them a law that fails when its torque is not finite.
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

/// The drives do in a cycle what they are told.
struct Arm {
  ExecutiveBench& b;
  JointVector step = JointVector::Zero();  // rad, of the last cycle

  Status cycle(double periods = 1.0) {
    const Status status = b.cycle(periods);
    if (b.hal.stops > 0) return b.hal.state.dq.setZero(), status;
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
  ASSERT_OK(b.executive.start());
  return b;
}

/// Half a second along the line of 0.5 rad/s.
inline Arm moving(ExecutiveBench& b) {
  Arm arm{b};
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
    if (report.id == id && report.outcome != Outcome::kStarted) found = report, ++finals;
  }
  assert_int_equal(finals, 1);
  return found;
}

}  // namespace tactus
