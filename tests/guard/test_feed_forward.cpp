// Tests the guard on feed-forward beside positions and velocities: its limits are compared with the
// sequence that was sent, over random commands.
#include <random>

#include "tests/guard/guard_bench.hpp"

namespace tactus {
namespace {

constexpr unsigned kSeed = 20260401;
constexpr int kCycles = 4000;

struct FeedForwardBench : GuardBench {
  RobotCommand last;  // sent

  explicit FeedForwardBench(CommandMode commanded) {
    mode = commanded;
    params.following_error.setConstant(kInfinity);
    start();
    last = {mode, mode == CommandMode::kPosition ? state.q : JointVector(JointVector::Zero())};
  }
  RobotCommand send(RobotCommand command) {
    ASSERT_OK(guard.limit(state, command));
    return last = command;
  }
  RobotCommand brake() { return last = guard.brake(state); }
  JointVector dq_step() const { return params.limits.ddq_max * kPeriod_s; }
  JointVector tau_step() const { return params.limits.dtau_max * kPeriod_s; }
};

bool within(const JointVector& value, const JointVector& limit) {
  return (value.cwiseAbs().array() <= limit.array() * (1.0 + kRounding)).all();
}

JointVector random_joints(std::mt19937& random, const JointVector& most) {
  std::uniform_real_distribution<double> share(-1.5, 1.5);
  JointVector values;
  for (int i = 0; i < kDof; ++i) values[i] = share(random) * most[i];
  return values;
}

// Proves GRD-12.

void no_feed_forward_exceeds_limit_or_rate(void**) {
  std::mt19937 random(kSeed);
  std::bernoulli_distribution brakes(0.1);
  for (const CommandMode mode : {CommandMode::kPosition, CommandMode::kVelocity}) {
    FeedForwardBench bench(mode);
    const JointLimits& limits = bench.params.limits;
    for (int k = 0; k < kCycles; ++k) {
      const RobotCommand before = bench.last;
      RobotCommand wanted = before;
      wanted.dq_ff = random_joints(random, limits.dq_max);
      wanted.tau_ff = random_joints(random, limits.tau_max);
      const RobotCommand sent = brakes(random) ? bench.brake() : bench.send(wanted);
      assert_true(within(sent.dq_ff, limits.dq_max) && within(sent.tau_ff, limits.tau_max));
      assert_true(within(sent.dq_ff - before.dq_ff, bench.dq_step()));
      assert_true(within(sent.tau_ff - before.tau_ff, bench.tau_step()));
    }
    assert_true(bench.telemetry().feed_forward_cycles > kCycles / 2);
    assert_int_equal(bench.telemetry().limited_cycles, 0);
  }
}

void feed_forward_within_its_limits_is_sent_unchanged(void**) {
  FeedForwardBench bench(CommandMode::kPosition);
  JointVector q = bench.state.q;
  for (int k = 1; k <= 500; ++k) {
    const double t = k * kPeriod_s;
    const JointVector dq = JointVector::Constant(0.3 * std::sin(t));
    q += kPeriod_s * dq;
    const JointVector tau = JointVector::Constant(5.0 * std::sin(t));
    const RobotCommand sent = bench.send({bench.mode, q, DriveRequest::kFollow, {}, dq, tau});
    assert_true(sent.dq_ff == dq && sent.tau_ff == tau);
  }
  assert_int_equal(bench.telemetry().feed_forward_cycles, 0);
}

void a_limited_position_is_not_fed_faster_than_it_moves(void**) {
  FeedForwardBench bench(CommandMode::kPosition);
  const JointLimits& limits = bench.params.limits;
  JointVector q = bench.state.q;
  const JointVector speed = 0.9 * limits.dq_max;
  int at_limit = 0;
  for (int k = 1; k <= 6000; ++k) {  // runs far beyond the position limit
    const JointVector ramp = speed * std::min(1.0, k / 500.0);
    q += kPeriod_s * ramp;
    const JointVector before = bench.last.value, fed = bench.last.dq_ff;
    const RobotCommand sent = bench.send({bench.mode, q, DriveRequest::kFollow, {}, ramp});
    for (int i = 0; i < kDof; ++i) {
      if (sent.value[i] == q[i]) continue;
      const double slope = (sent.value[i] - before[i]) / kPeriod_s;
      const double slowest = fed[i] - limits.ddq_max[i] * kPeriod_s;
      assert_true(sent.dq_ff[i] <= std::max({slope, slowest, 0.0}) + 1e-9);
      assert_true(sent.dq_ff[i] >= 0.0);
      at_limit += slope == 0.0 && sent.dq_ff[i] == 0.0;
    }
  }
  assert_true(at_limit > 1000);
}

void a_brake_ends_the_velocity_and_keeps_the_torque_that_is_fed_forward(void**) {
  FeedForwardBench bench(CommandMode::kPosition);
  JointVector q = bench.state.q;
  const JointVector tau = JointVector::Constant(3.0);
  for (int k = 1; k <= 500; ++k) {
    const JointVector dq = JointVector::Constant(1e-3 * k);
    q += kPeriod_s * dq;
    bench.send({bench.mode, q, DriveRequest::kFollow, {}, dq, tau});
  }
  assert_true(bench.last.dq_ff == JointVector(JointVector::Constant(0.5)));
  for (int k = 0; k < 200; ++k) {
    bench.brake();
    assert_true(bench.last.tau_ff == tau);
  }
  assert_true(bench.last.dq_ff.isZero(0.0));
}

// Proves GRD-2.

void feed_forward_that_is_not_finite_trips(void**) {
  for (JointVector RobotCommand::*field : {&RobotCommand::dq_ff, &RobotCommand::tau_ff}) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
      FeedForwardBench bench(CommandMode::kPosition);
      RobotCommand command = bench.last;
      (command.*field)[kDof - 1] = bad;
      ASSERT_STATUS(bench.guard.limit(bench.state, command), Status::kCommandNotFinite);
      assert_int_equal(bench.telemetry().tripped_joint, kDof - 1);
      bench.brake();
      assert_true(bench.last.dq_ff.isZero(0.0) && bench.last.tau_ff.isZero(0.0));
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_feed_forward_exceeds_limit_or_rate),
      cmocka_unit_test(feed_forward_within_its_limits_is_sent_unchanged),
      cmocka_unit_test(a_limited_position_is_not_fed_faster_than_it_moves),
      cmocka_unit_test(a_brake_ends_the_velocity_and_keeps_the_torque_that_is_fed_forward),
      cmocka_unit_test(feed_forward_that_is_not_finite_trips),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
