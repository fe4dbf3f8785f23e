// Limits of Cartesian pose control: the joints keep their limits for any reference, through
// singularities, out of reach and back, and with blocked joints.
#include "tests/control/pose_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves CP-4.

void the_speed_limits_scale_the_twist_and_keep_its_direction(void**) {
  RandomVectors random;
  for (int number = 0; number < 20; ++number) {
    PoseBench bench;
    bench.law.params.posture_gain = 0.0;
    bench.law.params.limits.ddq_max.setConstant(1e6);
    ASSERT_OK(bench.start(regular_joints(random)));
    bench.v_d << 1.5 * random.axis(), 2.0 * random.axis();
    ASSERT_OK(bench.step());
    const double scale = bench.law.scale.value;
    ASSERT_NEAR((bench.J * bench.dq_c() - scale * bench.v_d).norm(), 0.0, 1e-7);
    const double used = bench.dq_c().cwiseQuotient(kLimits.dq_max).cwiseAbs().maxCoeff();
    ASSERT_NEAR(used, 1.0, scale < 1.0 ? 1e-9 : 1.0);
    assert_true(number > 0 || scale < 1.0);
  }
}

void the_tip_keeps_its_speed_limits(void**) {
  PoseBench bench;
  RandomVectors random;
  bench.law.params.max_speed = 0.1;
  bench.law.params.max_angular_speed = 0.2;
  ASSERT_OK(bench.start(regular_joints(random)));
  bench.x_d.p += Vector3(0.1, -0.1, 0.1);
  bench.x_d.r = exp_so3({0.3, 0.2, 0.0}) * bench.x_d.r;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_OK(bench.step());
    const Vector6 v = bench.J * bench.dq_c();
    assert_true(v.head<3>().norm() <= 0.1 + 1e-4 && v.tail<3>().norm() <= 0.2 + 1e-4);
  }
}

void whatever_the_reference_does_no_limit_is_exceeded(void**) {
  RandomVectors random;
  for (const double dt_s : {1e-3, 2e-3, 8e-3})
    for (const int delay : {0, 2}) {
      PoseBench bench;
      bench.dt_s = dt_s;
      bench.delay = delay;
      ASSERT_OK(bench.start(random_joints(random, 0.9)));
      Watch watch{bench};
      for (int k = 0; k < 6000; ++k) {
        if (k % 157 == 0) {
          bench.x_d = tip_at(random_joints(random, 1.0));
          if (k % 3 == 0) bench.x_d.p += 2.0 * random.vector();
          bench.v_d << 3.0 * random.vector(), 5.0 * random.vector();
          if (k % 2 == 0) bench.v_d.setZero();
        }
        ASSERT_OK(watch.step());
      }
    }
}

void a_large_step_of_the_reference_is_reached_without_overshoot(void**) {
  RandomVectors random;
  for (int number = 0; number < 10; ++number) {
    PoseBench bench;
    const JointVector q0 = regular_joints(random);
    ASSERT_OK(bench.start(q0));
    const Vector3 step = 0.15 * random.axis();
    bench.x_d.p += step;
    double beyond = 0.0;
    Watch watch{bench};
    for (int k = 0; k < 3000; ++k) {
      ASSERT_OK(watch.step());
      beyond = std::max(beyond, -bench.position_error().dot(step) / step.norm());
    }
    assert_true(beyond < 1e-3);
  }
}

/// Puts a joint close to its limit and sends the tip to a place for which the joint would have to
/// go further, then back.
void a_joint_at_its_limit_stops_there_and_can_leave(void**) {
  RandomVectors random;
  int at_limit = 0;
  for (int number = 0; number < 4 * kDof; ++number) {
    const int joint = number % kDof;
    JointVector q = regular_joints(random), beyond = q;
    q[joint] = kLimits.q_max[joint] - 0.15;
    beyond[joint] = kLimits.q_max[joint] + 0.15;
    if (!(sigma_at(q) > 0.06)) continue;
    PoseBench bench;
    bench.law.params.posture_gain = 0.0;
    ASSERT_OK(bench.start(q));
    const Pose home = bench.x_d;
    Watch watch{bench};
    bench.x_d = tip_at(beyond);
    double most = -10.0;
    for (int k = 0; k < 2000; ++k) {
      ASSERT_OK(watch.step());
      most = std::max(most, bench.q_c()[joint]);
    }
    at_limit += most > kLimits.q_max[joint] - 0.011;
    bench.x_d = home;
    for (int k = 0; k < 6000; ++k) ASSERT_OK(watch.step());
    assert_true(bench.position_error().norm() < 1e-3 && bench.rotation_error().norm() < 1e-2);
  }
  assert_true(at_limit >= kDof);
}

/// If a joint is at its limit and the tip's motion would drive it further, the other joints move
/// the tip in the same way as far as they can.
void the_others_take_the_share_of_a_joint_at_its_limit(void**) {
  if (kDof <= 6) _skip(__FILE__, __LINE__);  // there are no others
  RandomVectors random;
  int taken = 0;
  for (int number = 0; number < 4 * kDof; ++number) {
    const int joint = number % kDof;
    JointVector q = regular_joints(random);
    q[joint] = kLimits.q_max[joint] - 0.01;
    PoseBench bench;
    bench.law.params.posture_gain = 0.0;
    bench.law.params.limits.ddq_max.setConstant(1e6);
    ASSERT_OK(bench.start(q));
    const DampedInverse<kDof> every(bench.J, 0.05);
    bench.J.col(joint).setZero();
    if (!(every.sigma() > 0.06 && DampedInverse<kDof>(bench.J, 0.05).sigma() > 0.06)) continue;
    bench.v_d << 1e-3 * random.axis(), 1e-3 * random.axis();
    if (!(every.times(bench.v_d)[joint] > 0.0)) bench.v_d = -bench.v_d;
    ASSERT_OK(bench.step());
    ASSERT_NEAR(bench.law.scale.value, 1.0, 0.0);
    ASSERT_NEAR(bench.dq_c()[joint], 0.0, 1e-9);
    ASSERT_NEAR((bench.J * bench.dq_c() - bench.v_d).norm(), 0.0, 1e-8);
    ++taken;
  }
  assert_true(taken >= 3);
}

// Proves CP-7.

void a_blocked_arm_is_not_run_away_from_and_released_without_a_jump(void**) {
  RandomVectors random;
  for (int number = 0; number < 2 * kDof; ++number) {
    PoseBench bench;
    bench.delay = number % 3;
    bench.law.params.max_lead = 0.02;
    ASSERT_OK(bench.start(regular_joints(random)));
    Watch watch{bench};
    const Vector3 way = 0.1 * random.axis();
    const Pose home = bench.x_d;
    for (int k = 0; k < 8000; ++k) {
      const double t = k * bench.dt_s;
      bench.blocked.setConstant(false);
      if (number < kDof)
        bench.blocked[number] = t > 0.2 && t < 3.0;  // one joint
      else
        bench.blocked.setConstant(t > 0.2 && t < 3.0);
      watch.follows = t < 0.2;
      bench.x_d.p = home.p + std::min(t, 3.0) * way;
      bench.v_d.head<3>() = t < 3.0 ? way : Vector3::Zero();
      const JointVector q = bench.q;
      ASSERT_OK(watch.step());
      assert_true((bench.q_c() - bench.q).cwiseAbs().maxCoeff() <= 0.02 + 1e-12);
      const JointVector step = bench.q - q;
      assert_true((step.cwiseAbs() - kLimits.dq_max * bench.dt_s).maxCoeff() <= 0.021);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_speed_limits_scale_the_twist_and_keep_its_direction),
      cmocka_unit_test(the_tip_keeps_its_speed_limits),
      cmocka_unit_test(whatever_the_reference_does_no_limit_is_exceeded),
      cmocka_unit_test(a_large_step_of_the_reference_is_reached_without_overshoot),
      cmocka_unit_test(a_joint_at_its_limit_stops_there_and_can_leave),
      cmocka_unit_test(the_others_take_the_share_of_a_joint_at_its_limit),
      cmocka_unit_test(a_blocked_arm_is_not_run_away_from_and_released_without_a_jump),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
