// The PID law when the torque is at its limit, at several periods.
#include <algorithm>

#include "tests/control/pid_bench.hpp"

namespace tactus {
namespace {

// Proves PI-3.

struct Recovery {
  double overshoot = 0.0, settled_s = 0.0;
};

/// A step of 1 rad with at most 3 N m, of which a load takes 1 N m: saturated for a long time.
Recovery recover(AntiWindup mode, double dt_s) {
  PidAndInertia b;
  place_poles(b);
  b.load = 1.0;
  b.pid.params.anti_windup = mode;
  b.pid.params.output_limit.setConstant(3.0);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  Recovery seen;
  for (int k = 1; k * dt_s < 20.0; ++k) {
    b.cycle(dt_s);
    seen.overshoot = std::max(seen.overshoot, b.q[0] - 1.0);
    if (std::abs(b.q[0] - 1.0) > 0.02) seen.settled_s = k * dt_s;
  }
  return seen;
}

void anti_windup_bounds_overshoot_and_recovery(void**) {
  for (const double dt_s : kPeriods_s) {
    const Recovery none = recover(AntiWindup::kNone, dt_s);
    for (const auto mode : {AntiWindup::kBackCalculation, AntiWindup::kConditional}) {
      const Recovery seen = recover(mode, dt_s);
      print_message("%g s: overshoot %.3f of %.3f rad, settled after %.2f of %.2f s\n", dt_s,
                    seen.overshoot, none.overshoot, seen.settled_s, none.settled_s);
      assert_true(seen.overshoot < 0.5 * none.overshoot);
      assert_true(seen.settled_s < 0.7 * none.settled_s);
    }
  }
}

/// Winds up an integral, 50 N m/s with at most 20 N m, by an error of 1 for 10 s.
void wind_up(PidBench& b, AntiWindup mode, double dt_s) {
  b.gains(0.0, 50.0, 0.0);
  b.pid.params.anti_windup = mode;
  b.pid.params.output_limit.setConstant(20.0);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  for (int k = 0; k * dt_s < 10.0; ++k) b.step(dt_s);
  b.torque_is(20.0 * kJointOnes);
}

/// Returns the time after which an error of -1 then brings the torque below its limit, s.
double unwinding_s(AntiWindup mode, double dt_s) {
  PidBench b;
  wind_up(b, mode, dt_s);
  b.q_d = -kJointOnes;
  double t = 0.0;
  for (; b.pid.tau.value[0] >= 20.0 && t < 20.0; t += dt_s) b.step(dt_s);
  return t;
}

void without_anti_windup_it_takes_as_long_to_unwind_as_to_wind_up(void**) {
  for (const double dt_s : kPeriods_s)
    ASSERT_NEAR(unwinding_s(AntiWindup::kNone, dt_s), 9.6, 3.0 * dt_s);
}

void with_anti_windup_the_torque_leaves_its_limit_at_once(void**) {
  for (const double dt_s : kPeriods_s) {
    for (const auto mode : {AntiWindup::kBackCalculation, AntiWindup::kConditional})
      assert_true(unwinding_s(mode, dt_s) <= 2.5 * dt_s);
  }
}

void what_saturates_without_the_integral_does_not_move_a_conditional_one(void**) {
  PidBench b;
  wind_up(b, AntiWindup::kConditional, 1e-3);
  b.g = 30.0 * kJointOnes;
  for (int k = 0; k < 100; ++k) b.step(1e-3);
  ASSERT_NEAR(b.pid.integral()[0], 20.0, 1e-12);
  b.q_d = -kJointOnes;  // but it goes back
  for (int k = 0; k < 100; ++k) b.step(1e-3);
  ASSERT_NEAR(b.pid.integral()[0], 20.0 - 50.0 * 0.099, 1e-9);
}

void back_calculation_takes_the_excess_away_with_its_time_constant(void**) {
  for (const double dt_s : kPeriods_s) {
    PidBench b;
    wind_up(b, AntiWindup::kNone, dt_s);
    b.pid.params.anti_windup = AntiWindup::kBackCalculation;
    b.pid.params.tracking_time_constant.setConstant(0.1);
    b.q_d = kJointZero;
    b.step(dt_s);
    const double excess = b.pid.integral()[0] - 20.0;
    for (int k = 1; k * dt_s < 0.5; ++k) {
      b.step(dt_s);
      ASSERT_NEAR(b.pid.integral()[0], 20.0 + excess * std::exp(-k * dt_s / 0.1), 1e-9);
    }
  }
}

void its_time_constant_is_by_default_between_integral_and_derivative(void**) {
  PidBench b;
  b.gains(0.0, 50.0, 0.5);  // sqrt(0.5 / 50) = 0.1
  b.pid.params.anti_windup = AntiWindup::kBackCalculation;
  b.pid.params.output_limit.setConstant(20.0);
  ASSERT_OK(b.pid.start());
  b.g = 30.0 * kJointOnes;
  b.step(1e-3);
  ASSERT_NEAR(b.pid.integral()[0], -10.0 * (1.0 - std::exp(-0.01)), 1e-9);
  b.gains(5.0, 50.0, 0.0);  // 5 / 50
  ASSERT_OK(b.pid.start());
  b.step(1e-3);
  ASSERT_NEAR(b.pid.integral()[0], -10.0 * (1.0 - std::exp(-0.01)), 1e-9);
}

// Proves PI-7.

void braked_the_integral_stays_until_the_next_start(void**) {
  for (const BrakeWay way : {BrakeWay::kOnPath, BrakeWay::kAtOnce}) {
    PidBench b;
    b.gains(100.0, 50.0, 10.0);
    ASSERT_OK(b.pid.start());
    b.q_d = kJointOnes;
    for (int k = 0; k < 100; ++k) b.step(1e-2);
    const JointVector before = b.pid.integral();
    assert_true(before[0] > 1.0);
    for (int k = 0; k < 1000; ++k) {
      b.pid.brake(Status::kHalted, way);
      b.step(1e-2);
    }
    assert_true(b.pid.integral() == before);
    b.torque_is(100.0 * kJointOnes + before);  // the other terms continue
    ASSERT_OK(b.pid.start());
    b.step(1e-2);
    assert_true(b.pid.integral()[0] > 0.0 && b.pid.integral()[0] < before[0]);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(anti_windup_bounds_overshoot_and_recovery),
      cmocka_unit_test(braked_the_integral_stays_until_the_next_start),
      cmocka_unit_test(without_anti_windup_it_takes_as_long_to_unwind_as_to_wind_up),
      cmocka_unit_test(with_anti_windup_the_torque_leaves_its_limit_at_once),
      cmocka_unit_test(what_saturates_without_the_integral_does_not_move_a_conditional_one),
      cmocka_unit_test(back_calculation_takes_the_excess_away_with_its_time_constant),
      cmocka_unit_test(its_time_constant_is_by_default_between_integral_and_derivative),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
