// The PID law with numbers that can be checked by hand: gains 100, 50, 10, errors 1, period 10 ms.
#include <random>

#include "tests/control/pid_bench.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr unsigned kSeed = 20260311;

// Proves PI-1.

void without_an_error_there_is_no_torque(void**) {
  PidBench b;
  ASSERT_OK(b.pid.start());
  b.torque_is(kJointZero);
  b.step_gives(kPeriod_s, kJointZero);
}

void every_term_is_its_gain_times_its_input(void**) {
  for (const double sign : {1.0, -1.0}) {
    PidBench b;
    ASSERT_OK(b.pid.start());
    b.q_d = sign * kJointOnes;
    b.step_gives(kPeriod_s, 100.0 * sign * kJointOnes);
    b.q = b.q_d;
    b.step_gives(kPeriod_s, kJointZero);
    b.dq_d = sign * kJointOnes;
    b.step_gives(kPeriod_s, 10.0 * sign * kJointOnes);
    b.dq = 3.0 * b.dq_d;
    b.step_gives(kPeriod_s, -20.0 * sign * kJointOnes);
    b.g = 7.0 * sign * kJointOnes;
    b.step_gives(kPeriod_s, -13.0 * sign * kJointOnes);
  }
}

void every_joint_has_its_own_gains(void**) {
  PidBench b;
  const JointVector numbers = JointVector::LinSpaced(1.0, kDof);
  b.pid.params.gains = {numbers, 10.0 * numbers, 2.0 * numbers};
  ASSERT_OK(b.pid.start());
  b.q_d = 3.0 * kJointOnes;
  b.dq = kJointOnes;
  b.step(kPeriod_s);  // 3 - 2, and the integral of an error that grew from 0 to 3
  b.torque_is((3.0 - 2.0 + 10.0 * 0.5 * 3.0 * kPeriod_s) * numbers);
}

void a_constant_error_is_integrated_as_time_passes(void**) {
  PidBench b;
  b.gains(0.0, 50.0, 0.0);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  for (int k = 0; k < 100; ++k) b.step(kPeriod_s);
  ASSERT_NEAR(b.pid.tau.value[0], 50.0, 1e-10);
  b.q_d = -kJointOnes;
  for (int k = 0; k < 100; ++k) b.step(kPeriod_s);
  ASSERT_NEAR(b.pid.tau.value[0], 0.5, 1e-10);  // the change from 1 to -1 took half a period
}

void the_integral_stops_at_its_limit_and_leaves_it_at_once(void**) {
  PidBench b;
  b.gains(0.0, 50.0, 0.0);
  b.pid.params.integral_limit.setConstant(2.0);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  for (int k = 0; k < 100; ++k) b.step(kPeriod_s);
  b.torque_is(2.0 * kJointOnes);
  b.q_d = -kJointOnes;
  b.step(kPeriod_s);
  b.step_gives(kPeriod_s, 1.5 * kJointOnes);
}

void the_torque_stops_at_its_limit(void**) {
  PidBench b;
  b.pid.params.output_limit = JointVector::LinSpaced(1.0, kDof);
  b.q_d = kJointOnes;
  ASSERT_OK(b.pid.start());
  b.torque_is(b.pid.params.output_limit);
  b.q_d = -kJointOnes;
  b.step_gives(kPeriod_s, -b.pid.params.output_limit);
}

void the_dead_band_is_taken_off_the_error(void**) {
  for (const double sign : {1.0, -1.0}) {
    PidBench b;
    b.gains(100.0, 50.0, 0.0);
    b.pid.params.dead_band.setConstant(0.1);
    b.q_d = sign * 0.1 * kJointOnes;
    ASSERT_OK(b.pid.start());
    for (int k = 0; k < 100; ++k) b.step(kPeriod_s);
    b.torque_is(kJointZero);
    b.q_d = sign * 0.3 * kJointOnes;
    b.step_gives(kPeriod_s, sign * (100.0 * 0.2 + 50.0 * 0.5 * 0.2 * kPeriod_s) * kJointOnes);
  }
}

void feed_forward_is_gain_times_reference(void**) {
  PidBench b;
  b.gains(0.0, 0.0, 0.0);
  b.pid.ddq_d.source = &b.ddq_d;
  b.pid.tau_d.source = &b.tau_d;
  b.pid.params.velocity_gain.setConstant(2.0);
  b.pid.params.acceleration_gain.setConstant(3.0);
  b.pid.params.effort_gain.setConstant(0.5);
  ASSERT_OK(b.pid.start());
  b.dq_d = kJointOnes;
  b.step_gives(kPeriod_s, 2.0 * kJointOnes);
  b.ddq_d = kJointOnes;
  b.step_gives(kPeriod_s, 5.0 * kJointOnes);
  b.tau_d = kJointOnes;
  b.step_gives(kPeriod_s, 5.5 * kJointOnes);
}

void a_feed_forward_gain_without_its_input_is_refused(void**) {
  PidBench velocity, acceleration;
  velocity.pid.dq_d = {};
  velocity.pid.params.velocity_gain[kDof - 1] = 1.0;
  acceleration.pid.params.acceleration_gain[0] = 1.0;
  ASSERT_STATUS(velocity.pid.start(), Status::kNotConnected);
  ASSERT_STATUS(acceleration.pid.start(), Status::kNotConnected);
}

void the_derivative_on_measurement_knows_nothing_of_the_reference(void**) {
  PidBench b;
  b.gains(0.0, 0.0, 10.0);
  b.pid.params.derivative = Derivative::kMeasurement;
  ASSERT_OK(b.pid.start());
  b.q_d = b.dq_d = kJointOnes;
  b.step_gives(kPeriod_s, kJointZero);
  b.dq = kJointOnes;
  b.step_gives(kPeriod_s, -10.0 * kJointOnes);
}

void a_velocity_that_is_not_wired_is_the_difference_of_the_position(void**) {
  PidBench b;
  b.gains(0.0, 0.0, 10.0);
  b.pid.dq = {};
  b.pid.dq_d = {};
  b.q = 5.0 * kJointOnes;
  ASSERT_OK(b.pid.start());
  b.torque_is(kJointZero);
  b.q += 0.02 * kJointOnes;
  b.step_gives(kPeriod_s, -20.0 * kJointOnes);
  b.q_d += 0.03 * kJointOnes;
  b.step_gives(kPeriod_s, 30.0 * kJointOnes);
  b.step_gives(kPeriod_s, kJointZero);
}

// Proves PI-5.

void a_number_that_is_not_finite_never_becomes_a_torque_nor_stays_in_the_law(void**) {
  JointVector PidBench::*const inputs[] = {&PidBench::q_d, &PidBench::q,     &PidBench::dq_d,
                                           &PidBench::dq,  &PidBench::ddq_d, &PidBench::tau_d,
                                           &PidBench::g};
  for (const double gain : {0.0, 10.0}) {
    for (JointVector PidBench::*input : inputs) {
      for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
        PidBench b, twin;
        for (PidBench* each : {&b, &twin}) {
          each->gains(gain, gain, gain);
          each->pid.params.dead_band.setConstant(0.1);
          each->pid.params.derivative_time_constant.setConstant(0.1);
          each->pid.ddq_d.source = &each->ddq_d;
          each->pid.tau_d.source = &each->tau_d;
          each->q_d = kJointOnes;
          ASSERT_OK(each->pid.start());
          each->step(kPeriod_s);
        }
        const double good = (b.*input)[kDof - 1];
        (b.*input)[kDof - 1] = bad;
        ASSERT_STATUS(b.pid.step(kPeriod_s), Status::kCommandNotFinite);
        assert_true(b.pid.tau.value == twin.pid.tau.value);
        (b.*input)[kDof - 1] = good;
        b.step(kPeriod_s);
        twin.step(kPeriod_s);
        assert_true(b.pid.tau.value == twin.pid.tau.value);
        assert_true(b.pid.integral() == twin.pid.integral());
        (b.*input)[0] = bad;
        ASSERT_STATUS(b.pid.start(), Status::kCommandNotFinite);
      }
    }
  }
}

void a_measured_torque_that_is_not_finite_is_refused_at_start(void**) {
  PidBench b;
  b.pid.tau_measured.source = &b.tau_measured;
  b.tau_measured[2] = std::nan("");
  ASSERT_STATUS(b.pid.start(), Status::kCommandNotFinite);
}

void gains_of_which_any_are_zero_give_finite_torques_in_every_mode(void**) {
  print_message("seed %u\n", kSeed);
  std::mt19937_64 bits(kSeed);
  std::normal_distribution<double> normal;
  for (int zeros = 0; zeros < 8; ++zeros) {
    for (const auto mode :
         {AntiWindup::kNone, AntiWindup::kBackCalculation, AntiWindup::kConditional}) {
      PidBench b;
      b.gains(zeros & 1 ? 0.0 : 100.0, zeros & 2 ? 0.0 : 50.0, zeros & 4 ? 0.0 : 10.0);
      b.pid.params.anti_windup = mode;
      b.pid.params.output_limit.setConstant(20.0);
      b.pid.params.integral_limit.setConstant(15.0);
      ASSERT_OK(b.pid.start());
      for (int k = 0; k < 2000; ++k) {
        for (JointVector* input : {&b.q_d, &b.q, &b.dq_d, &b.dq})
          for (int i = 0; i < kDof; ++i) (*input)[i] = normal(bits) * (k % 50 == 0 ? 1e6 : 1.0);
        b.step(kPeriod_s);
        assert_true((b.pid.tau.value.cwiseAbs() - 20.0 * kJointOnes).maxCoeff() <= 0.0);
        assert_true((b.pid.integral().cwiseAbs() - 15.0 * kJointOnes).maxCoeff() <= 0.0);
        if (zeros & 2) assert_true(b.pid.integral() == kJointZero);
      }
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(without_an_error_there_is_no_torque),
      cmocka_unit_test(every_term_is_its_gain_times_its_input),
      cmocka_unit_test(every_joint_has_its_own_gains),
      cmocka_unit_test(a_constant_error_is_integrated_as_time_passes),
      cmocka_unit_test(the_integral_stops_at_its_limit_and_leaves_it_at_once),
      cmocka_unit_test(the_torque_stops_at_its_limit),
      cmocka_unit_test(the_dead_band_is_taken_off_the_error),
      cmocka_unit_test(feed_forward_is_gain_times_reference),
      cmocka_unit_test(a_feed_forward_gain_without_its_input_is_refused),
      cmocka_unit_test(the_derivative_on_measurement_knows_nothing_of_the_reference),
      cmocka_unit_test(a_velocity_that_is_not_wired_is_the_difference_of_the_position),
      cmocka_unit_test(a_number_that_is_not_finite_never_becomes_a_torque_nor_stays_in_the_law),
      cmocka_unit_test(a_measured_torque_that_is_not_finite_is_refused_at_start),
      cmocka_unit_test(gains_of_which_any_are_zero_give_finite_torques_in_every_mode),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
