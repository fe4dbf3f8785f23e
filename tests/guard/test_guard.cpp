// Tests the guard on measured states and torques.
#include <random>

#include "tests/guard/guard_bench.hpp"

namespace tactus {
namespace {

constexpr unsigned kSeed = 20260304;
constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity};

// Proves GRD-1.

void a_state_on_its_limits_passes(void**) {
  GuardBench bench;
  bench.start();
  bench.state.q = bench.params.limits.q_max;
  bench.state.dq = bench.params.limits.dq_max;
  ASSERT_OK(bench.check());
  bench.state.q = bench.params.limits.q_min;
  bench.state.dq *= -1.0;
  ASSERT_OK(bench.check());
  assert_int_equal(bench.telemetry().tripped_joint, -1);
}

void a_measured_number_that_is_not_finite_trips_and_names_the_joint(void**) {
  for (JointVector RobotState::*field : {&RobotState::q, &RobotState::dq, &RobotState::tau}) {
    for (int i = 0; i < kDof; ++i) {
      for (const double bad : kBad) {
        GuardBench bench;
        bench.start();
        (bench.state.*field)[i] = bad;
        bench.trips_on(Status::kStateNotFinite, i);
        ASSERT_STATUS(bench.start(kPeriod_s), Status::kStateNotFinite);
      }
    }
  }
}

void a_position_or_velocity_beyond_limit_and_allowance_trips_and_names_both(void**) {
  for (int i = 0; i < kDof; ++i) {
    for (const bool upper : {true, false}) {
      GuardBench bench;
      bench.params.position_allowance.setConstant(1e-6);
      bench.params.velocity_allowance.setConstant(0.05);
      bench.start();
      const JointLimits& limits = bench.params.limits;
      const double middle = bench.state.q[i];
      const double q = upper ? limits.q_max[i] : limits.q_min[i];
      bench.state.q[i] = q + (upper ? 0.999e-6 : -0.999e-6);
      ASSERT_OK(bench.check());
      bench.state.q[i] = q + (upper ? 1.001e-6 : -1.001e-6);
      bench.trips_on(Status::kMeasuredPositionLimit, i);
      assert_true(bench.telemetry().tripped_value == bench.state.q[i]);
      ASSERT_NEAR(bench.telemetry().tripped_limit, q + (upper ? 1e-6 : -1e-6), kRounding);

      bench.state.q[i] = middle;
      bench.state.dq[i] = (upper ? 1.0 : -1.0) * 1.0499 * limits.dq_max[i];
      ASSERT_OK(bench.check());
      bench.state.dq[i] = (upper ? 1.0 : -1.0) * 1.0501 * limits.dq_max[i];
      bench.trips_on(Status::kMeasuredVelocityLimit, i);
      assert_true(bench.telemetry().tripped_value == bench.state.dq[i]);
      ASSERT_NEAR(bench.telemetry().tripped_limit, 1.05 * limits.dq_max[i], kRounding);
    }
  }
}

// Proves GRD-13.

void an_allowance_beyond_the_tolerance_is_taken_from_references_not_given_to_the_guard(void**) {
  GuardBench bench;
  const JointLimits& limits = bench.params.limits;
  bench.params.position_allowance.setConstant(0.05);
  bench.params.velocity_allowance.setConstant(0.3);
  const JointLimits references = bench.params.references();
  for (int i = 0; i < kDof; ++i) {
    ASSERT_NEAR(references.q_min[i], limits.q_min[i] + 0.04, kRounding);
    ASSERT_NEAR(references.q_max[i], limits.q_max[i] - 0.04, kRounding);
    ASSERT_NEAR(references.dq_max[i], 0.8 * limits.dq_max[i], kRounding);
    GuardBench far = bench, fast = bench;
    far.start();
    far.state.q[i] = limits.q_max[i] + 0.0101;
    far.trips_on(Status::kMeasuredPositionLimit, i);
    fast.start();
    fast.state.dq[i] = 1.0999 * limits.dq_max[i];
    ASSERT_OK(fast.check());
    fast.state.dq[i] = 1.1001 * limits.dq_max[i];
    fast.trips_on(Status::kMeasuredVelocityLimit, i);
  }
}

void an_arm_beyond_a_limit_within_the_allowance_starts_where_it_is_and_comes_back(void**) {
  for (const CommandMode mode : {CommandMode::kPosition, CommandMode::kVelocity}) {
    GuardBench bench;
    bench.mode = mode;
    JointVector& q = bench.state.q;
    q = bench.params.limits.q_max + JointVector::Constant(0.009);
    bench.start();
    const bool positions = mode == CommandMode::kPosition;
    const JointVector stay = positions ? q : JointVector(JointVector::Zero());
    for (int k = 0; k < 1000; ++k) assert_true(bench.sent(stay) == stay);
    assert_int_equal(bench.telemetry().limited_cycles, 0);
    const JointVector away = positions ? JointVector(q + JointVector::Ones()) : JointVector::Ones();
    JointVector last = stay;
    for (int k = 0; k < 300; ++k) {
      const JointVector sent = bench.sent(k < 50 || k > 250 ? away : JointVector(q - away));
      if (positions) assert_true((sent - last).maxCoeff() <= (k > 250 ? 1.0 : 1e-8));
      if (!positions) assert_true((sent.array() <= 0.0).all());
      last = sent;
    }
    if (positions) assert_true((last.array() < bench.params.limits.q_max.array() + 1e-8).all());
  }
}

/// Its bound follows it inwards, with the allowance as its play.
void an_arm_a_little_outside_its_range_may_go_nowhere_but_back(void**) {
  for (const double side : {1.0, -1.0}) {
    GuardBench bench;
    const double middle = bench.state.q[3];
    const double end = side > 0.0 ? bench.params.limits.q_max[3] : bench.params.limits.q_min[3];
    double& q = bench.state.q[3];
    const auto beyond = [&](double rad) { q = end + side * rad; };
    beyond(0.111);
    ASSERT_STATUS(bench.start(kPeriod_s), Status::kMeasuredPositionLimit);
    beyond(0.05);
    bench.start();
    for (const double rad : {0.059, 0.04, 0.049, 0.03, 0.02, 0.029}) {
      beyond(rad);
      ASSERT_OK(bench.check());
    }
    beyond(0.0301);
    bench.trips_on(Status::kMeasuredPositionLimit, 3);
    q = middle;
    ASSERT_OK(bench.check());
    beyond(0.0101);
    bench.trips_on(Status::kMeasuredPositionLimit, 3);
  }
}

// Proves GRD-2.

void a_command_that_is_not_finite_trips_in_every_mode_and_names_the_joint(void**) {
  for (const int mode : {0, 1, 2}) {
    for (int i = 0; i < kDof; ++i) {
      for (const double bad : kBad) {
        GuardBench bench;
        bench.mode = static_cast<CommandMode>(mode);
        bench.start();
        RobotCommand command = {bench.mode, bench.state.q};
        command.value[i] = bad;
        ASSERT_STATUS(bench.guard.limit(bench.state, command), Status::kCommandNotFinite);
        assert_int_equal(bench.telemetry().tripped_joint, i);
      }
    }
  }
}

// Proves GRD-3.

void a_torque_within_its_limits_is_sent_as_it_came(void**) {
  GuardBench bench;
  bench.start();
  const JointVector wanted = JointVector::LinSpaced(-0.9, 0.9);
  assert_true(bench.sent(wanted) == wanted);
  assert_int_equal(bench.telemetry().limited_cycles, 0);
}

void a_torque_step_is_sent_at_the_rate_limit(void**) {
  GuardBench bench;
  bench.start();
  ASSERT_NEAR(bench.sent(10.0)[0], 1.0, kRounding);
  ASSERT_NEAR(bench.sent(10.0)[0], 2.0, kRounding);
  ASSERT_NEAR(bench.sent(-10.0)[0], 1.0, kRounding);
  ASSERT_OK(bench.start(2.0 * kPeriod_s));
  ASSERT_NEAR(bench.sent(10.0)[0], 2.0, kRounding);
}

void a_torque_beyond_its_limit_is_sent_as_the_limit(void**) {
  for (const double sign : {1.0, -1.0}) {
    GuardBench bench;
    bench.start();
    for (int cycle = 0; cycle < 86; ++cycle) bench.sent(sign * 1000.0);
    ASSERT_NEAR(bench.sent(sign * 1000.0)[0], sign * 87.0, kRounding);
    const JointVector sent = bench.sent(sign * 1000.0);
    assert_true(sent[0] == sign * 87.0 && sent[6] == sign * 12.0);
  }
}

void the_rate_counts_from_the_torque_held_at_start(void**) {
  GuardBench bench;
  bench.state.tau[0] = 30.0;
  bench.start();
  assert_true(bench.sent(30.0 * JointVector::Unit(0))[0] == 30.0);
  ASSERT_NEAR(bench.sent(40.0 * JointVector::Unit(0))[0], 31.0, kRounding);
}

void a_torque_held_at_start_beyond_its_limit_is_refused(void**) {
  for (const double sign : {1.0, -1.0}) {
    GuardBench bench;
    bench.state.tau[6] = sign * 12.0;
    bench.start();
    bench.state.tau[6] = sign * 12.1;
    ASSERT_STATUS(bench.start(kPeriod_s), Status::kEffortLimit);
    assert_int_equal(bench.telemetry().tripped_joint, 6);
    assert_true(bench.telemetry().tripped_value == sign * 12.1);
    assert_true(bench.telemetry().tripped_limit == 12.0);
  }
}

void no_random_sequence_of_commands_passes_a_limit(void**) {
  print_message("seed %u\n", kSeed);
  std::mt19937_64 bits(kSeed);
  std::normal_distribution<double> normal;
  GuardBench bench;
  bench.start();
  const JointLimits& limits = bench.params.limits;
  JointVector wanted = JointVector::Zero(), before = wanted;
  for (int cycle = 0; cycle < 100000; ++cycle) {
    const double jump = std::pow(10.0, normal(bits));  // mostly small, some far beyond any limit
    for (int i = 0; i < kDof; ++i) wanted[i] = 0.9 * wanted[i] + jump * normal(bits);
    const JointVector now = bench.sent(wanted);
    assert_true((now.cwiseAbs() - limits.tau_max).maxCoeff() <= 0.0);
    const JointVector step = (now - before).cwiseAbs();
    assert_true((step - kPeriod_s * limits.dtau_max).maxCoeff() <= kRounding);
    before = now;
  }
  assert_true(bench.telemetry().limited_cycles > 0 && bench.telemetry().limited_cycles < 100000);
}

void telemetry_counts_a_cycle_once_and_marks_its_joints(void**) {
  GuardBench bench;
  bench.start();
  bench.sent(5.0 * (JointVector::Unit(0) + JointVector::Unit(2)));
  assert_int_equal(bench.telemetry().limited_cycles, 1);
  bench.sent(0.0);  // within limits
  assert_int_equal(bench.telemetry().limited_joints, 0b101);
  bench.sent(-5.0 * JointVector::Unit(6));
  assert_int_equal(bench.telemetry().limited_cycles, 2);
  assert_int_equal(bench.telemetry().limited_joints, 0b1000101);
  bench.start();
  assert_int_equal(bench.telemetry().limited_cycles, 0);
  assert_int_equal(bench.telemetry().limited_joints, 0);
}

// Proves CFG-5, GRD-3.

void tightened_limits_hold(void**) {
  GuardBench bench;
  bench.params.limits.tau_max.setConstant(0.25);
  bench.params.limits.dtau_max.setConstant(100.0);  // 0.1 N m per cycle
  bench.params.limits.dq_max.setConstant(0.5);
  bench.params.position_margin.setConstant(0.1);
  bench.start();
  ASSERT_NEAR(bench.sent(1.0)[0], 0.1, kRounding);
  ASSERT_NEAR(bench.sent(1.0)[0], 0.2, kRounding);
  assert_true(bench.sent(1.0)[0] == 0.25);

  const double q_max = bench.params.limits.q_max[0];
  bench.state.q[0] = q_max - 0.091;  // 0.009 beyond the margin, of 0.01 that are allowed
  ASSERT_OK(bench.check());
  bench.state.q[0] = q_max - 0.089;
  bench.trips_on(Status::kMeasuredPositionLimit, 0);
  bench.state.q[0] = bench.params.limits.q_min[0] + 0.089;
  bench.trips_on(Status::kMeasuredPositionLimit, 0);
  bench.state.q[0] = 0.0;
  bench.state.dq[3] = -0.6;
  bench.trips_on(Status::kMeasuredVelocityLimit, 3);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_state_on_its_limits_passes),
      cmocka_unit_test(a_measured_number_that_is_not_finite_trips_and_names_the_joint),
      cmocka_unit_test(a_position_or_velocity_beyond_limit_and_allowance_trips_and_names_both),
      cmocka_unit_test(
          an_allowance_beyond_the_tolerance_is_taken_from_references_not_given_to_the_guard),
      cmocka_unit_test(
          an_arm_beyond_a_limit_within_the_allowance_starts_where_it_is_and_comes_back),
      cmocka_unit_test(an_arm_a_little_outside_its_range_may_go_nowhere_but_back),
      cmocka_unit_test(a_command_that_is_not_finite_trips_in_every_mode_and_names_the_joint),
      cmocka_unit_test(a_torque_within_its_limits_is_sent_as_it_came),
      cmocka_unit_test(a_torque_step_is_sent_at_the_rate_limit),
      cmocka_unit_test(a_torque_beyond_its_limit_is_sent_as_the_limit),
      cmocka_unit_test(the_rate_counts_from_the_torque_held_at_start),
      cmocka_unit_test(a_torque_held_at_start_beyond_its_limit_is_refused),
      cmocka_unit_test(no_random_sequence_of_commands_passes_a_limit),
      cmocka_unit_test(telemetry_counts_a_cycle_once_and_marks_its_joints),
      cmocka_unit_test(tightened_limits_hold),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
