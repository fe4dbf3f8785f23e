// Tests the robot's internal servo: steady state, delay and behaviour against a force. The arm is
// MuJoCo's; the oracle is the analytic solution of the servo's differential equation.
#include <cmath>
#include <limits>

#include "tests/sim_plant/arm/driven_hal.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// One robot for all tests, because MuJoCo's memory outlives a failed assertion.
struct Bench {
  SimHal hal;
  RobotState state;
  JointVector home;  // rad, where it is at the start
  double period_s = 0.0;

  void start(CommandMode mode, int period_us, const PlantParams& params = {}) {
    ASSERT_OK(hal.load(params, 1));
    period_s = period_us * 1e-6;
    hal.set_period(period_s);
    ASSERT_OK(arm_drives(hal, mode, state));
    home = hal.arm().q();
  }
  Status write(CommandMode mode, const JointVector& value) { return follow(hal, mode, value); }
  double farthest_from(const JointVector& q) const {
    return (hal.arm().q() - q).cwiseAbs().maxCoeff();
  }
  double speed_off(const JointVector& dq) const {
    return (hal.arm().dq() - dq).cwiseAbs().maxCoeff();
  }
} g_bench;

constexpr CommandMode kPosition = CommandMode::kPosition, kVelocity = CommandMode::kVelocity;

/// A motion from home and back on every joint, rad, at rest at t = 0: up to 0.5 rad/s.
JointVector wave(double t_s) {
  const double s = std::sin(t_s), x = 0.4 * s * s * s;
  JointVector q;
  for (int i = 0; i < kDof; ++i) q[i] = i % 2 == 0 ? x : -x;
  return q;
}

PlantParams slow(double time_constant_s) {
  PlantParams params;
  params.servo_time_constant_s = time_constant_s;
  return params;
}

// Proves SIM-20.

void attaching_in_either_mode_moves_nothing(void**) {
  for (const double time_constant_s : {0.0, 0.02}) {
    PlantParams params = slow(time_constant_s);
    params.payload_kg = 3.0;
    params.payload_com = Vector3(0.1, 0.0, 0.05);
    for (const CommandMode mode : {kPosition, kVelocity}) {
      g_bench.start(mode, 8000, params);
      const JointVector hold =
          mode == kPosition ? g_bench.state.q : JointVector(JointVector::Zero());
      for (int k = 0; k < 125; ++k) {
        ASSERT_OK(g_bench.write(mode, hold));
        ASSERT_NEAR(g_bench.farthest_from(g_bench.home), 0.0, 1e-12);
      }
      ASSERT_OK(measure(g_bench.hal, g_bench.state));
      assert_true(g_bench.state.tau.norm() > 10.0);
    }
  }
}

// Proves SIM-21.

void an_ideal_servo_is_at_the_position_sent_when_the_period_ends(void**) {
  for (const int period_us : {500, 1000, 8000}) {
    g_bench.start(kPosition, period_us);
    for (int k = 1; k * g_bench.period_s <= 3.2; ++k) {
      const JointVector q_c = g_bench.home + wave(k * g_bench.period_s);
      const JointVector slope =
          (q_c - g_bench.home - wave((k - 1) * g_bench.period_s)) / g_bench.period_s;
      ASSERT_OK(g_bench.write(kPosition, q_c));
      ASSERT_NEAR(g_bench.farthest_from(q_c), 0.0, 1e-6);
      ASSERT_NEAR(g_bench.speed_off(slope), 0.0, 1e-3);
    }
  }
}

void an_ideal_servo_arrives_from_one_period_to_the_next_whatever_the_slope(void**) {
  for (const int period_us : {500, 1000, 8000}) {
    g_bench.start(kPosition, period_us);
    const double speed = 2.5 * g_bench.period_s, way = speed * g_bench.period_s;  // 2.5 rad/s^2
    JointVector q_c = g_bench.home;
    for (const double slope : {1.0, -1.0, 0.5, 0.0, -1.0, 1.0}) {
      q_c += JointVector::Constant(slope * way);
      ASSERT_OK(g_bench.write(kPosition, q_c));
      ASSERT_NEAR(g_bench.farthest_from(q_c), 0.0, 1e-2 * way);
      ASSERT_NEAR(g_bench.speed_off(JointVector::Constant(slope * speed)), 0.0, 1e-2 * speed);
    }
  }
}

void an_ideal_servo_has_the_velocity_sent_when_the_period_ends(void**) {
  for (const int period_us : {1000, 8000}) {
    g_bench.start(kVelocity, period_us);
    for (int k = 1; k * g_bench.period_s <= 3.2; ++k) {
      const double t = k * g_bench.period_s, h = 1e-6;
      const JointVector dq_c = (wave(t + h) - wave(t - h)) / (2.0 * h);
      ASSERT_OK(g_bench.write(kVelocity, dq_c));
      ASSERT_NEAR(g_bench.speed_off(dq_c), 0.0, 1e-3);
    }
  }
}

void a_slow_servo_follows_a_step_in_position_as_a_critically_damped_lag(void**) {
  for (const double T : {0.04, 2e-4}) {
    const double step = 0.7 * T * T;  // rad, for at most 0.7 rad/s^2
    g_bench.start(kPosition, 1000, slow(T));
    const JointVector q_c = g_bench.home + JointVector::Constant(step);
    for (int k = 1; k <= 300; ++k) {
      ASSERT_OK(g_bench.write(kPosition, q_c));
      const double t = k * 1e-3, way = 1.0 - (1.0 + t / T) * std::exp(-t / T);
      const JointVector q = g_bench.home + JointVector::Constant(way * step);
      ASSERT_NEAR(g_bench.farthest_from(q), 0.0, 0.02 * step);
    }
  }
}

void a_slow_servo_is_late_by_two_time_constants_behind_a_ramp(void**) {
  constexpr double kSpeed = 0.2, kT = 0.04;  // rad/s, s
  for (const int period_us : {1000, 8000}) {
    g_bench.start(kPosition, period_us, slow(kT));
    JointVector q_c = g_bench.home;
    for (int k = 1; k * g_bench.period_s <= 1.0; ++k) {
      q_c = g_bench.home + JointVector::Constant(kSpeed * k * g_bench.period_s);
      ASSERT_OK(g_bench.write(kPosition, q_c));
    }
    // The target is held for a period: on average it is half a period ahead of the ramp through its
    // ends.
    const double late_s = 2.0 * kT - 0.5 * g_bench.period_s;
    ASSERT_NEAR(g_bench.farthest_from(q_c - JointVector::Constant(kSpeed * late_s)), 0.0,
                0.02 * kSpeed * late_s);
  }
}

void a_slow_servo_is_not_late_if_the_velocity_of_the_ramp_is_fed_forward(void**) {
  constexpr double kSpeed = 0.2, kT = 0.04;  // rad/s, s
  for (const int period_us : {1000, 8000}) {
    g_bench.start(kPosition, period_us, slow(kT));
    const JointVector dq_ff = JointVector::Constant(kSpeed);
    JointVector q_c = g_bench.home;
    for (int k = 1; k * g_bench.period_s <= 1.0; ++k) {
      q_c = g_bench.home + JointVector::Constant(kSpeed * k * g_bench.period_s);
      ASSERT_OK(follow(g_bench.hal, kPosition, q_c, dq_ff));
    }
    // The target, held for a period, is half a period ahead of the ramp.
    const JointVector ahead = JointVector::Constant(0.5 * kSpeed * g_bench.period_s);
    ASSERT_NEAR(g_bench.farthest_from(q_c + ahead), 0.0, 1e-2 * kSpeed * 2.0 * kT);
  }
}

void a_slow_servo_follows_a_step_in_velocity_as_a_lag_of_first_order(void**) {
  constexpr double kStep = 0.05, kT = 0.04;  // rad/s, s
  g_bench.start(kVelocity, 1000, slow(kT));
  for (int k = 1; k <= 300; ++k) {
    ASSERT_OK(g_bench.write(kVelocity, JointVector::Constant(kStep)));
    const double expected = kStep * (1.0 - std::exp(-k * 1e-3 / kT));
    ASSERT_NEAR(g_bench.speed_off(JointVector::Constant(expected)), 0.0, 0.01 * kStep);
  }
}

// Proves SIM-22.

void no_drive_exerts_more_than_it_can(void**) {
  g_bench.start(kVelocity, 1000);
  const JointVector limit(robot_mjcf().drive_torque.data());
  const JointVector top = 0.99 * JointVector(robot_mjcf().drive_speed.data());
  bool reached = false;
  for (int k = 0; k < 200; ++k) {
    ASSERT_OK(g_bench.write(kVelocity, k % 100 < 50 ? top : JointVector(-top)));
    ASSERT_OK(measure(g_bench.hal, g_bench.state));
    assert_true((g_bench.state.tau.cwiseAbs().array() <= limit.array()).all());
    reached = reached || (g_bench.state.tau.cwiseAbs().array() == limit.array()).any();
  }
  assert_true(reached);
}

void a_target_out_of_reach_closes_the_brakes(void**) {
  const JointVector top(robot_mjcf().drive_speed.data());
  for (int joint = 0; joint < kDof; ++joint) {
    for (const double sign : {1.0, -1.0}) {
      for (const CommandMode mode : {kPosition, kVelocity}) {
        g_bench.start(mode, 1000);
        JointVector target = sign * 1.01 * top[joint] * JointVector::Unit(joint);
        if (mode == kPosition) target = g_bench.home + 1e-3 * target;
        ASSERT_STATUS(g_bench.write(mode, target), Status::kDriveFault);
        ASSERT_NEAR(g_bench.farthest_from(g_bench.home), 0.0, 0.0);
        ASSERT_STATUS(g_bench.write(mode, g_bench.state.q), Status::kDriveFault);
      }
    }
  }
}

// Proves SIM-4.

void a_target_that_is_not_finite_or_of_another_mode_closes_the_brakes(void**) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const CommandMode mode : {kPosition, kVelocity}) {
      g_bench.start(mode, 1000);
      JointVector target = g_bench.home;
      target[kDof - 1] = bad;
      ASSERT_STATUS(g_bench.write(mode, target), Status::kDriveFault);
      g_bench.start(mode, 1000);
      const JointVector still = mode == kPosition ? g_bench.home : JointVector(JointVector::Zero());
      ASSERT_STATUS(follow(g_bench.hal, mode, still, target), Status::kDriveFault);
    }
  }
  g_bench.start(kPosition, 1000);
  ASSERT_STATUS(g_bench.write(CommandMode::kEffort, g_bench.state.tau), Status::kDriveFault);
  assert_true(g_bench.hal.arm().dq().isZero(0.0));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(attaching_in_either_mode_moves_nothing),
      cmocka_unit_test(an_ideal_servo_is_at_the_position_sent_when_the_period_ends),
      cmocka_unit_test(an_ideal_servo_arrives_from_one_period_to_the_next_whatever_the_slope),
      cmocka_unit_test(an_ideal_servo_has_the_velocity_sent_when_the_period_ends),
      cmocka_unit_test(a_slow_servo_follows_a_step_in_position_as_a_critically_damped_lag),
      cmocka_unit_test(a_slow_servo_is_late_by_two_time_constants_behind_a_ramp),
      cmocka_unit_test(a_slow_servo_is_not_late_if_the_velocity_of_the_ramp_is_fed_forward),
      cmocka_unit_test(a_slow_servo_follows_a_step_in_velocity_as_a_lag_of_first_order),
      cmocka_unit_test(no_drive_exerts_more_than_it_can),
      cmocka_unit_test(a_target_out_of_reach_closes_the_brakes),
      cmocka_unit_test(a_target_that_is_not_finite_or_of_another_mode_closes_the_brakes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
