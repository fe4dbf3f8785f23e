// Braking of Cartesian pose control: on the path of its reference, or every joint at once; and the
// posture, which begins where the arm is.
#include "sim_plant/arm/plant_params.hpp"
#include "tests/control/pose_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// An arm whose tip moves, and its posture too if it has one.
struct MovingArm : PoseBench {
  Watch watch{*this};
  Vector3 speed = {0.1, -0.1, 0.05};

  MovingArm() {
    law.params.posture_gain = 2.0;
    ASSERT_OK(start(ready_pose()));
    q_posture = ready_pose();
    q_posture[0] += 1.0;
    law.q_posture.source = &q_posture;
    for (int k = 0; k < 600; ++k) follow();
    assert_true(dq_c().norm() > 0.1);
  }
  void follow() {
    x_d.p += dt_s * speed;
    v_d << speed, Vector3::Zero();
    ASSERT_OK(watch.step());
  }
};

// Proves CP-2.

void a_constant_reference_moves_nothing(void**) {
  for (const int delay : {0, 3}) {
    PoseBench bench;
    bench.delay = delay;
    const JointVector from = ready_pose();
    ASSERT_OK(bench.start(from));
    ASSERT_OK(bench.run(20.0));
    ASSERT_NEAR((bench.q_c() - from).norm(), 0.0, 1e-9);
  }
}

// Proves CP-12.

/// The reference stops within 0.2 s; the tip follows it, the posture task ends.
void on_the_path_the_tip_follows_its_reference_to_rest(void**) {
  MovingArm arm;
  const Vector3 speed = arm.speed;
  for (int k = 1; k <= 200; ++k) {
    arm.law.brake(Status::kHalted, BrakeWay::kOnPath);
    arm.speed = speed * (1.0 - k / 200.0);
    arm.follow();
    assert_true(arm.position_error().norm() < 5e-4);
  }
  for (int k = 0; k < 500; ++k) {
    arm.law.brake(Status::kHalted, BrakeWay::kOnPath);
    ASSERT_OK(arm.watch.step());
  }
  assert_true(arm.dq_c().isZero(0.0));
  assert_true(arm.position_error().norm() < 5e-4);
  const JointVector rest = arm.q_c();
  arm.q[0] += 1e-4;  // nothing moves it any more
  for (int k = 0; k < 1000; ++k) {
    arm.law.brake(Status::kHalted, BrakeWay::kOnPath);
    ASSERT_OK(arm.watch.step());
  }
  assert_true(arm.q_c() == rest);
}

/// A tip far from a reference at rest stops on its way there.
void on_the_path_an_error_that_is_left_is_given_up(void**) {
  PoseBench bench;
  ASSERT_OK(bench.start(ready_pose()));
  bench.x_d.p += Vector3(0.0, 0.0, 2.0);  // out of reach
  ASSERT_OK(bench.run(0.5));
  assert_true(bench.dq_c().norm() > 0.1);
  Watch watch{bench};
  for (int k = 0; k < 800; ++k) {
    bench.law.brake(Status::kHalted, BrakeWay::kOnPath);
    ASSERT_OK(watch.step());
  }
  assert_true(bench.dq_c().isZero(0.0));
}

/// Out of reach, posture and remaining error balance each other; without the posture task the arm
/// must not start to move again.
void on_the_path_an_arm_at_rest_stays_at_rest(void**) {
  constexpr double kRest = 0.01;  // rad/s
  RandomVectors random;
  for (int trial = 0; trial < 60; ++trial) {
    PoseBench bench;
    ASSERT_OK(bench.start(random_joints(random, 0.8)));
    bench.x_d.p += 0.8 * random.vector();
    ASSERT_OK(bench.run(5.0));
    double slowest = kInfinity;
    for (int k = 0; k < 1200; ++k) {
      bench.law.brake(Status::kHalted, BrakeWay::kOnPath);
      ASSERT_OK(bench.step());
      const double speed = bench.dq_c().cwiseAbs().maxCoeff();
      slowest = std::min(slowest, speed);
      assert_true(slowest > 0.5 * kRest || speed <= kRest);
    }
    assert_true(bench.dq_c().isZero(0.0));
  }
}

void at_once_every_joint_brakes_with_its_whole_acceleration(void**) {
  MovingArm arm;
  JointVector dq = arm.dq_c();
  const JointVector most = kLimits.ddq_max * arm.dt_s;
  for (int k = 0; k < 400; ++k) {
    arm.law.brake(Status::kCollision, BrakeWay::kAtOnce);
    arm.follow();  // the reference moves on and is no longer followed
    for (int i = 0; i < kDof; ++i) {
      const double left = std::max(0.0, std::abs(dq[i]) - most[i]);
      ASSERT_NEAR(arm.dq_c()[i], std::copysign(left, dq[i]), 1e-12);
    }
    dq = arm.dq_c();
  }
  assert_true(dq.isZero(0.0));
}

void a_brake_at_once_stays_one_until_the_next_start(void**) {
  MovingArm arm;
  arm.law.brake(Status::kCollision, BrakeWay::kAtOnce);
  arm.follow();
  for (int k = 0; k < 400; ++k) {
    arm.law.brake(Status::kHalted, BrakeWay::kOnPath);
    arm.follow();
  }
  assert_true(arm.dq_c().isZero(0.0));
  ASSERT_OK(arm.start(arm.true_q));
  for (int k = 0; k < 100; ++k) arm.follow();
  assert_true(arm.dq_c().norm() > 0.01);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_constant_reference_moves_nothing),
      cmocka_unit_test(on_the_path_the_tip_follows_its_reference_to_rest),
      cmocka_unit_test(on_the_path_an_error_that_is_left_is_given_up),
      cmocka_unit_test(on_the_path_an_arm_at_rest_stays_at_rest),
      cmocka_unit_test(at_once_every_joint_brakes_with_its_whole_acceleration),
      cmocka_unit_test(a_brake_at_once_stays_one_until_the_next_start),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
