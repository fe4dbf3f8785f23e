// The executive's brake brings a reference and a command to rest from random states: the generator
// on the path, the guard within limits.
#include <optional>

#include "kernel/guard/guard.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

ReferenceBench& fresh() {
  static std::optional<ReferenceBench> bench;
  return bench.emplace();
}

/// Sends a trajectory with random waypoints at rest, each with the same offset of all joints.
std::uint32_t send_random(ReferenceBench& b, Random& random) {
  Trajectory<JointSpace>* motion =
      b.trajectory(static_cast<Fields>(kVelocityField | kAccelerationField));
  if (motion == nullptr) return 0;
  for (int i = 1 + random.below(4); i > 0; --i)
    b.add(*motion, 1.0 * (motion->count + 1), random.uniform(-0.2, 0.2));
  std::uint32_t id = 0;
  return b.client.send(*motion, id).ok() ? id : 0;
}

struct Finals {
  std::array<int, 64> count{};
  std::array<Outcome, 64> outcome{};
  std::array<Status, 64> status{};

  void take(ReferenceBench& b) {
    Report report;
    while (b.client.poll(report)) {
      if (report.outcome == Outcome::kStarted || report.outcome == Outcome::kReleased ||
          report.outcome == Outcome::kScheduled)
        continue;
      ++count[report.id];
      outcome[report.id] = report.outcome;
      status[report.id] = report.verdict.status;
    }
  }
};

// Proves LAD-6, LAD-7, LAD-10.

void a_trajectory_is_braked_on_its_path_within_limits_and_everything_is_accounted(void**) {
  Random random{42};
  for (int trial = 0; trial < 150; ++trial) {
    ReferenceBench& b = fresh();
    Finals finals;
    const JointLimits& limits = b.channel.settings.limits;
    const std::uint32_t first = send_random(b, random);
    assert_true(first > 0);
    for (int i = random.below(1500); i > 0; --i) ASSERT_OK(b.step());
    finals.take(b);
    const bool running = finals.count[first] == 0;
    int waited = 0;
    for (int k = 0; k < 3000; ++k) {
      if (random.below(100) == 0 && waited < 20) waited += send_random(b, random) > 0 ? 1 : 0;
      const JointSpace::Point before = b.out();
      b.generator.brake(Status::kSlip, BrakeWay::kOnPath);
      ASSERT_OK(b.step());
      finals.take(b);
      const JointSpace::Point& now = b.out();
      const double offset = now.q[0] - b.home.q[0];
      for (int i = 0; i < kDof; ++i) {
        assert_true(std::abs(now.dq[i]) <= limits.dq_max[i] * 1.000001);
        assert_true(std::abs(now.dq[i] - before.dq[i]) <= limits.ddq_max[i] * kPeriod_s * 1.001);
        ASSERT_NEAR(now.q[i] - b.home.q[i], offset, 1e-9);  // the path is a line through all joints
      }
    }
    assert_true(b.out().dq.isZero(0.0) && b.out().ddq.isZero(0.0));
    if (running) {
      assert_true(finals.outcome[first] == Outcome::kAborted);
      ASSERT_STATUS(finals.status[first], Status::kSlip);
    }
    for (std::uint32_t id = first; id <= first + static_cast<std::uint32_t>(waited); ++id) {
      assert_int_equal(finals.count[id], 1);
      if (id == first) continue;
      assert_true(finals.outcome[id] == Outcome::kRefused);
      ASSERT_STATUS(finals.status[id], Status::kSlip);
    }
    assert_non_null(b.client.acquire());  // every store is back
  }
}

void a_trajectory_that_waits_is_aborted_and_a_stream_of_points_is_brought_to_rest(void**) {
  ReferenceBench& b = fresh();
  Trajectory<JointSpace>* later = b.trajectory(0);
  b.add(*later, 1.0, 0.1);
  later->start_s = 5.0;
  std::uint32_t waiting = 0, id = 0;
  assert_true(b.client.send(*later, waiting).ok());
  JointSpace::Point point;
  point.q = b.home.q;
  point.dq = JointVector::Constant(0.3);
  assert_true(b.client.send(point, id).ok());
  ASSERT_OK(b.step());
  ASSERT_NEAR(b.out().dq[0], 0.3, 0.0);
  Finals finals;
  for (int k = 0; k < 3000; ++k) {
    const JointVector dq = b.out().dq;
    b.generator.brake(Status::kOverrun, BrakeWay::kOnPath);
    ASSERT_OK(b.step());
    finals.take(b);
    const JointVector change = b.out().dq - dq;
    for (int i = 0; i < kDof; ++i)
      assert_true(std::abs(change[i]) <= b.channel.settings.limits.ddq_max[i] * kPeriod_s * 1.0001);
  }
  assert_true(b.out().dq.isZero(0.0));
  assert_true(finals.outcome[waiting] == Outcome::kAborted && finals.count[waiting] == 1);
  ASSERT_STATUS(finals.status[waiting], Status::kOverrun);
  assert_true(finals.outcome[id] == Outcome::kExecuted);
}

void nothing_is_lost_when_reports_are_not_read_while_it_brakes(void**) {
  ReferenceBench& b = fresh();
  std::array<int, 200> finals{};
  std::uint32_t sent = 0, controls = 0;
  JointSpace::Point point;
  point.q = b.home.q;
  for (int round = 0; round < 12; ++round) {
    std::uint32_t id = 0;
    for (; b.client.cancel(id).ok(); ++controls) sent = id;  // until no more may be unanswered
    while (b.client.send(point, id).ok()) sent = id;         // until the mailbox is full
    for (int k = 0; k < 5; ++k) b.generator.brake(Status::kClock, BrakeWay::kOnPath);
  }
  Report report;
  for (int round = 0; round < 100; ++round) {
    while (b.client.poll(report)) {
      ++finals[report.id];
      ASSERT_STATUS(report.verdict.status, Status::kClock);
    }
    b.generator.brake(Status::kClock, BrakeWay::kOnPath);
  }
  assert_true(controls == kControls && sent > 3 * kControls);
  for (std::uint32_t id = 1; id <= sent; ++id) assert_int_equal(finals[id], 1);
}

// Proves LAD-5, LAD-7.

/// Sends random commands, brakes, and checks that the command comes to rest within limits.
void brake_by_the_guard(CommandMode mode, Random& random) {
  const JointLimits limits;
  Guard guard;
  RobotState state;
  state.q = middle_of_range();
  state.drives.fill({DriveState::kEnabled, true});
  ASSERT_OK(guard.start({}, mode, state, kPeriod_s, {}));
  JointVector sent = mode == CommandMode::kPosition ? state.q : JointVector::Zero();
  JointVector step = JointVector::Zero();
  const bool positions = mode == CommandMode::kPosition;
  JointVector towards;
  for (int i = 0; i < kDof; ++i)
    towards[i] = positions ? random.uniform(limits.q_min[i], limits.q_max[i])
                           : random.uniform(-1.0, 1.0) * limits.dq_max[i];
  const int moving = random.below(400);
  for (int k = 0; k < moving + 2000; ++k) {
    RobotCommand command{mode, towards};
    if (k < moving)
      ASSERT_OK(guard.limit(state, command));
    else
      command = guard.brake(state);
    const JointVector change = command.value - sent;
    for (int i = 0; i < kDof; ++i) {
      const double most = limits.ddq_max[i] * kPeriod_s;
      const double found = positions ? (change[i] - step[i]) / kPeriod_s : change[i];
      assert_true(std::abs(found) <= most * (1.0 + 1e-9) + 2e-9);
    }
    step = change;
    sent = command.value;
    state.q = positions ? sent : JointVector(state.q + kPeriod_s * sent);
    for (int i = 0; i < kDof; ++i)
      assert_true(state.q[i] >= limits.q_min[i] - 1e-6 && state.q[i] <= limits.q_max[i] + 1e-6);
  }
  assert_true(positions ? step.isZero(0.0) : sent.isZero(0.0));
}

void the_guard_brings_positions_and_velocities_to_rest_within_limits(void**) {
  Random random{43};
  for (int trial = 0; trial < 100; ++trial) {
    brake_by_the_guard(CommandMode::kPosition, random);
    brake_by_the_guard(CommandMode::kVelocity, random);
  }
}

void a_command_that_is_no_number_leaves_the_guard_as_it_was(void**) {
  RobotState state;
  state.q = middle_of_range();
  state.drives.fill({DriveState::kEnabled, true});
  Guard guard, other;
  ASSERT_OK(guard.start({}, CommandMode::kPosition, state, kPeriod_s, {}));
  ASSERT_OK(other.start({}, CommandMode::kPosition, state, kPeriod_s, {}));
  for (int k = 0; k < 50; ++k) {
    RobotCommand command{CommandMode::kPosition, state.q + JointVector::Constant(0.1)};
    RobotCommand same = command;
    ASSERT_OK(guard.limit(state, command));
    ASSERT_OK(other.limit(state, same));
  }
  RobotCommand bad{CommandMode::kPosition, state.q};
  bad.value[kDof - 1] = std::nan("");
  ASSERT_STATUS(guard.limit(state, bad), Status::kCommandNotFinite);
  assert_true(guard.brake(state).value == other.brake(state).value);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(
          a_trajectory_is_braked_on_its_path_within_limits_and_everything_is_accounted),
      cmocka_unit_test(
          a_trajectory_that_waits_is_aborted_and_a_stream_of_points_is_brought_to_rest),
      cmocka_unit_test(nothing_is_lost_when_reports_are_not_read_while_it_brakes),
      cmocka_unit_test(the_guard_brings_positions_and_velocities_to_rest_within_limits),
      cmocka_unit_test(a_command_that_is_no_number_leaves_the_guard_as_it_was),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
