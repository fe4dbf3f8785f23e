// Tests the commanded joint motion: whatever velocity is requested, the command keeps its bounds.
#include "kernel/math/joint_integrator.hpp"

#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
const JointVector zero = JointVector::Zero(), ones = JointVector::Ones();

JointIntegrator::Bounds bounds() {
  return {-ones, ones, 2.0 * ones, 8.0 * ones, 0.1};
}

JointIntegrator at(const JointVector& q) {
  JointIntegrator motion;
  motion.start(bounds(), q);
  return motion;
}

JointVector random_joints(RandomVectors& random, double most) {
  JointVector v;
  for (int i = 0; i < kDof; ++i) v[i] = most * random.unit();
  return v;
}

// Proves CP-4.

void a_joint_stops_within_its_stopping_distance_and_uses_it(void**) {
  for (const double dt_s : {1e-3, 8e-3})
    for (const double distance : {1e-12, 1e-6, 1e-3, 0.1, 2.0}) {
      const double speed = stopping_speed(distance, 8.0, dt_s);
      ASSERT_NEAR(speed * dt_s + speed * speed / 16.0, distance, 1e-12 * distance);
    }
  assert_true(stopping_speed(0.0, 8.0, 1e-3) == 0.0 && stopping_speed(-1.0, 8.0, 1e-3) == 0.0);
}

void from_rest_the_motion_has_the_wanted_direction(void**) {
  JointIntegrator motion = at(zero);
  JointVector wanted = JointVector::LinSpaced(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    motion.step(wanted, motion.q(), kPeriod_s);
    const double part = motion.dq()[0] / wanted[0];
    ASSERT_NEAR((motion.dq() - part * wanted).norm(), 0.0, 1e-12);
  }
  assert_true(motion.dq() == wanted);
}

void whatever_is_wanted_no_bound_is_exceeded(void**) {
  RandomVectors random;
  const JointIntegrator::Bounds most = bounds();
  for (const double dt_s : {1e-3, 8e-3}) {
    JointIntegrator motion = at(zero);
    JointVector wanted = zero;
    for (int k = 0; k < 20000; ++k) {
      if (k % 97 == 0) wanted = random_joints(random, k % 2 == 0 ? 1.0 : 50.0);
      const JointVector q = motion.q(), dq = motion.dq();
      motion.step(wanted, q, dt_s);
      for (int i = 0; i < kDof; ++i) {
        assert_true(std::abs(motion.q()[i]) <= 1.0 + 1e-12);
        assert_true(std::abs(motion.dq()[i]) <= 2.0);
        assert_true(std::abs(motion.dq()[i] - dq[i]) <= most.ddq_max[i] * dt_s * (1.0 + 1e-9));
        ASSERT_NEAR(motion.q()[i], q[i] + dt_s * motion.dq()[i], 1e-15);
      }
    }
  }
}

void a_joint_beyond_its_limit_moves_only_inwards(void**) {
  JointIntegrator motion = at(1.1 * ones);
  for (int k = 0; k < 100; ++k) motion.step(ones, motion.q(), kPeriod_s);
  assert_true(motion.q() == 1.1 * ones);
  for (int k = 0; k < 1000; ++k) motion.step(-ones, motion.q(), kPeriod_s);
  assert_true(motion.q()[0] < 0.5);
}

// Proves CP-7.

void the_command_leads_a_blocked_joint_by_no_more_than_is_stated(void**) {
  JointIntegrator motion = at(zero);
  for (int k = 0; k < 3000; ++k) {
    motion.step(ones, zero, kPeriod_s);
    assert_true(motion.q().maxCoeff() <= 0.1 + 1e-15);
  }
  ASSERT_NEAR(motion.q()[0], 0.1, 1e-12);
  ASSERT_NEAR(motion.dq()[0], 0.0, 1e-12);
}

void the_command_follows_a_joint_that_is_pushed_but_not_beyond_its_limits(void**) {
  JointIntegrator motion = at(zero);
  JointVector q = zero;
  for (int k = 0; k < 2000; ++k) {
    q += 1e-3 * ones;  // 1 rad/s
    motion.step(zero, q, kPeriod_s);
    if (q[0] < 1.0) assert_true(motion.q()[0] >= q[0] - 0.1 - 1e-12);
    assert_true(motion.q()[0] <= 1.0 + 1e-12 && motion.dq().maxCoeff() <= 2.0);
  }
  ASSERT_NEAR(motion.q()[0], 1.0, 1e-3);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_stops_within_its_stopping_distance_and_uses_it),
      cmocka_unit_test(from_rest_the_motion_has_the_wanted_direction),
      cmocka_unit_test(whatever_is_wanted_no_bound_is_exceeded),
      cmocka_unit_test(a_joint_beyond_its_limit_moves_only_inwards),
      cmocka_unit_test(the_command_leads_a_blocked_joint_by_no_more_than_is_stated),
      cmocka_unit_test(the_command_follows_a_joint_that_is_pushed_but_not_beyond_its_limits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
