// Time response of the PID law: closed forms at several periods, start, and change of gains.
#include <algorithm>

#include "tests/control/pid_bench.hpp"

namespace tactus {
namespace {

/// Returns the largest deviation from the closed form of place_poles() within 4 s, rad.
double deviation(double dt_s) {
  PidAndInertia b;
  place_poles(b);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  double largest = 0.0;
  for (int k = 1; k * dt_s < 4.0; ++k) {
    b.cycle(dt_s);
    const double pt = kPole * k * dt_s;
    largest = std::max(largest, std::abs(b.q[0] - 1.0 + std::exp(-pt) * (1.0 + pt - pt * pt)));
  }
  return largest;
}

// Proves PI-2.

void a_loop_of_three_poles_answers_a_step_as_its_closed_form(void**) {
  for (const double dt_s : kPeriods_s) assert_true(deviation(dt_s) < kPole * dt_s);
  ASSERT_NEAR(deviation(2e-3) / deviation(1e-3), 2.0, 0.05);  // first order, by the hold's delay
}

void the_integral_of_a_smooth_error_is_that_of_calculus_at_every_period(void**) {
  for (const double dt_s : kPeriods_s) {
    PidBench b;
    b.gains(0.0, 50.0, 0.0);
    ASSERT_OK(b.pid.start());
    for (int k = 1; k * dt_s < 3.0; ++k) {
      const double t = k * dt_s;
      b.q_d = std::sin(4.0 * t) * kJointOnes;
      b.step(dt_s);
      // Error of the trapezoidal rule: dt^2 / 12 times the change of slope, at most 8, and a
      // margin.
      ASSERT_NEAR(b.pid.integral()[0], 50.0 * (1.0 - std::cos(4.0 * t)) / 4.0,
                  50.0 * 8.1 * dt_s * dt_s / 12.0);
    }
  }
}

void a_step_of_the_velocity_passes_the_filter_with_its_time_constant(void**) {
  for (const double dt_s : kPeriods_s) {
    PidBench b;
    b.gains(0.0, 0.0, 1.0);
    b.pid.params.derivative_time_constant.setConstant(0.02);
    ASSERT_OK(b.pid.start());
    b.dq_d = kJointOnes;
    for (int k = 1; k < 20; ++k) {
      b.step(dt_s);
      ASSERT_NEAR(b.pid.tau.value[0], 1.0 - std::exp(-k * dt_s / 0.02), 1e-12);
    }
  }
}

void the_filtered_rate_is_that_of_the_continuous_filter_within_half_a_period(void**) {
  constexpr double kT = 0.02, w = 10.0;
  for (const bool wired : {true, false}) {
    for (const double dt_s : kPeriods_s) {
      PidBench b;
      b.gains(0.0, 0.0, 1.0);
      b.pid.params.derivative_time_constant.setConstant(kT);
      if (!wired) b.pid.dq = {};
      ASSERT_OK(b.pid.start());
      for (int k = 1; k * dt_s < 2.0; ++k) {
        const double t = k * dt_s;
        b.q = std::sin(w * t) * kJointOnes;
        b.dq = w * std::cos(w * t) * kJointOnes;
        b.step(dt_s);
        if (t < 0.5) continue;  // 25 time constants: the start has no effect any more
        const double filtered =
            w * (std::cos(w * t) + w * kT * std::sin(w * t)) / (1 + w * w * kT * kT);
        ASSERT_NEAR(b.pid.tau.value[0], -filtered, 0.5 * dt_s * w * w);
      }
    }
  }
}

// Proves PI-4.

void the_first_torque_on_the_reference_is_gravity(void**) {
  PidBench b;
  b.gains(100.0, 50.0, 10.0);
  b.q_d = b.q = kJointOnes;
  b.g = 3.0 * kJointOnes;
  ASSERT_OK(b.pid.start());
  b.torque_is(3.0 * kJointOnes);
  b.step_gives(1e-3, 3.0 * kJointOnes);
}

void the_first_torque_is_the_measured_one_where_there_is_an_integral(void**) {
  PidBench b;
  b.pid.tau_measured.source = &b.tau_measured;
  b.gains(100.0, 50.0, 10.0);
  b.pid.params.gains.ki[0] = 0.0;
  b.pid.params.integral_limit[1] = 2.0;
  b.q_d = 1.05 * kJointOnes;
  b.q = kJointOnes;
  b.g = 3.0 * kJointOnes;
  b.tau_measured = 4.0 * kJointOnes;
  ASSERT_OK(b.pid.start());
  JointVector expected = 4.0 * kJointOnes;
  expected[0] = 8.0;  // no integral: 100 0.05 + 3
  expected[1] = 6.0;  // 4 N m less were needed, 2 are allowed
  b.torque_is(expected);
}

void a_new_start_forgets_the_past(void**) {
  PidBench b;
  b.gains(100.0, 50.0, 10.0);
  ASSERT_OK(b.pid.start());
  b.q_d = kJointOnes;
  for (int k = 0; k < 100; ++k) b.step(1e-3);
  b.q = b.q_d;
  ASSERT_OK(b.pid.start());
  b.torque_is(kJointZero);
}

/// Brings the law into a motion in which every term contributes.
void set_in_motion(PidBench& b) {
  b.gains(100.0, 50.0, 10.0);
  b.pid.params.derivative_time_constant.setConstant(0.01);
  ASSERT_OK(b.pid.start());
  for (int k = 0; k < 100; ++k) {
    b.q_d = JointVector::LinSpaced(-1.0, 1.0) * std::sin(0.03 * k);
    b.dq = 2.0 * b.q_d;
    b.step(1e-3);
  }
}

/// The parameters of the law with other gains.
Pid::Params with_gains(const PidBench& b, double kp, double ki, double kd) {
  Pid::Params next = b.pid.params;
  next.gains = {kp * kJointOnes, ki * kJointOnes, kd * kJointOnes};
  return next;
}

void new_gains_do_not_step_the_torque(void**) {
  PidBench b;
  set_in_motion(b);
  const JointVector before = b.pid.tau.value, integral = b.pid.integral();
  for (const double ki : {5.0, 5000.0, 0.0}) {
    b.pid.retune(with_gains(b, 300.0, ki, 2.0), JointLimits());
    b.step(0.0);
    ASSERT_NEAR((b.pid.tau.value - before).cwiseAbs().maxCoeff(), 0.0, 1e-10);
    assert_true(b.pid.integral() == integral);
  }
}

/// Both ends, and every step between them, of the difference: with inputs that stay, the law alone
/// would be constant but for the integral.
void the_difference_of_new_gains_fades_within_half_the_torque_rate(void**) {
  PidBench b;
  set_in_motion(b);
  const JointLimits limits;
  Pid::Params next = with_gains(b, 900.0, 0.0, 2.0);
  next.derivative_time_constant.setZero();
  b.step(1e-3);
  b.pid.retune(next, limits);
  JointVector last = b.pid.tau.value;
  for (int k = 0; k < 20000; ++k) {
    b.step(1e-3);
    const JointVector change = (b.pid.tau.value - last).cwiseAbs();
    if (k > 0) assert_true((change.array() <= 0.5e-3 * limits.dtau_max.array() + 1e-9).all());
    last = b.pid.tau.value;
  }
  const JointVector law = 900.0 * (b.q_d - b.q) + 2.0 * (b.dq_d - b.dq) + b.g + b.pid.integral();
  ASSERT_NEAR((last - law).cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

void gains_that_ask_for_more_torque_than_there_is_are_refused(void**) {
  PidBench b;
  set_in_motion(b);
  const JointLimits limits;
  ASSERT_OK(b.pid.judge_change(with_gains(b, 50.0, 0.0, 1.0), limits).status);
  ASSERT_STATUS(b.pid.judge_change(with_gains(b, 1e6, 0.0, 1.0), limits).status,
                Status::kEffortLimit);
  b.q_d *= 100.0;
  ASSERT_STATUS(b.pid.judge_change(with_gains(b, 1.7e308, 1.0, 1.7e308), limits).status,
                Status::kCommandNotFinite);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_loop_of_three_poles_answers_a_step_as_its_closed_form),
      cmocka_unit_test(a_step_of_the_velocity_passes_the_filter_with_its_time_constant),
      cmocka_unit_test(the_integral_of_a_smooth_error_is_that_of_calculus_at_every_period),
      cmocka_unit_test(the_filtered_rate_is_that_of_the_continuous_filter_within_half_a_period),
      cmocka_unit_test(the_first_torque_on_the_reference_is_gravity),
      cmocka_unit_test(the_first_torque_is_the_measured_one_where_there_is_an_integral),
      cmocka_unit_test(a_new_start_forgets_the_past),
      cmocka_unit_test(new_gains_do_not_step_the_torque),
      cmocka_unit_test(the_difference_of_new_gains_fades_within_half_the_torque_rate),
      cmocka_unit_test(gains_that_ask_for_more_torque_than_there_is_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
