// Cartesian pose control as a law: sign, response, start, rates, posture.
#include "kernel/control/cartesian_pose.hpp"

#include "kernel/pipeline/kinds.hpp"
#include "kernel/pipeline/pipeline.hpp"
#include "tests/control/pose_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const JointVector zero = JointVector::Zero();

// Proves CP-1.

void on_its_reference_the_arm_stands(void**) {
  PoseBench bench;
  bench.law.params.posture_gain = 0.0;
  ASSERT_OK(bench.start(regular(0)));
  const JointVector q = bench.true_q;
  ASSERT_OK(bench.run(0.1));
  ASSERT_NEAR((bench.q_c() - q).norm(), 0.0, 1e-12);
  ASSERT_NEAR(bench.law.scale.value, 1.0, 0.0);
}

void the_command_moves_the_tip_as_the_error_and_the_twist_say(void**) {
  for (int axis = 0; axis < 6; ++axis)
    for (const double sign : {1.0, -1.0}) {
      PoseBench bench;
      bench.law.params.position_gain = {10.0, 11.0, 12.0};
      bench.law.params.rotation_gain = {13.0, 14.0, 15.0};
      bench.law.params.limits.ddq_max.setConstant(1e6);
      ASSERT_OK(bench.start(regular(1)));
      const Vector6 e = 1e-3 * sign * Vector6::Unit(axis);
      bench.x_d.p += e.head<3>();
      bench.x_d.r = exp_so3(e.tail<3>()) * bench.x_d.r;
      bench.v_d = 0.02 * Vector6::Unit((axis + 2) % 6);
      ASSERT_OK(bench.step());
      const Vector6 expected = bench.v_d + (10.0 + axis) * e;
      ASSERT_NEAR((bench.J * bench.dq_c() - expected).norm(), 0.0, 1e-8);
      ASSERT_NEAR((bench.q_c() - bench.q - bench.dt_s * bench.dq_c()).norm(), 0.0, 1e-15);
    }
}

void a_slow_robot_is_corrected_slowly_and_a_standing_one_not_at_all(void**) {
  for (const double share : {1.0, 0.3, 0.0}) {
    PoseBench bench;
    bench.law.speed_scaling.source = &share;
    bench.law.params.limits.ddq_max.setConstant(1e6);
    ASSERT_OK(bench.start(regular(1)));
    bench.x_d.p += Vector3(1e-3, 0.0, 0.0);
    bench.v_d = 0.02 * Vector6::Unit(2);  // from the generator, already scaled
    ASSERT_OK(bench.step());
    const Vector6 expected = bench.v_d + share * 10.0 * 1e-3 * Vector6::Unit(0);
    ASSERT_NEAR((bench.J * bench.dq_c() - expected).norm(), 0.0, 1e-8);
  }
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    PoseBench bench;
    bench.law.speed_scaling.source = &share;
    ASSERT_OK(bench.start(regular(1)));
    ASSERT_STATUS(bench.step(), Status::kReferenceFault);
  }
}

void a_turn_is_made_on_the_shortest_arc(void**) {
  PoseBench bench;
  ASSERT_OK(bench.start(regular(2)));
  bench.x_d.r = negative(exp_so3({0.0, 0.0, -0.02}) * bench.x_d.r);
  ASSERT_OK(bench.step());
  const Vector6 v = bench.J * bench.dq_c();
  assert_true(v[5] < 0.0);
  ASSERT_NEAR(v.head<5>().norm(), 0.0, 1e-8);
}

void a_small_error_decays_as_an_exponential(void**) {
  for (int number = 0; number < 10; ++number) {
    PoseBench bench;
    bench.law.params.posture_gain = 0.0;
    ASSERT_OK(bench.start(regular(number)));
    const Vector3 step(3e-5, -2e-5, 4e-5), turn(-5e-5, 3e-5, 2e-5);
    bench.x_d.p += step;
    bench.x_d.r = exp_so3(turn) * bench.x_d.r;
    for (int k = 1; k <= 500; ++k) {
      ASSERT_OK(bench.step());
      const double left = std::exp(-10.0 * 1e-3 * k);
      // (1 - K dt)^k is below exp(-K t) by no more than K dt / (2 e); 1e-7 is for nonlinear terms.
      assert_close(bench.position_error(), left * step, 0.0037 * step.norm() + 1e-7);
      assert_close(bench.rotation_error(), left * turn, 0.0037 * turn.norm() + 1e-7);
    }
  }
}

void a_known_delay_of_the_measurement_is_no_error(void**) {
  for (const double told : {0.0, 2e-3}) {
    PoseBench bench;
    bench.delay = 2;
    bench.law.params.measurement_delay = told;
    bench.law.params.posture_gain = 0.0;
    ASSERT_OK(bench.start(regular(3)));
    const Vector3 p0 = bench.x_d.p, velocity(0.02, 0.02, -0.01);
    for (int k = 0; k < 2000; ++k) {
      bench.v_d.head<3>() = velocity;
      bench.x_d.p = p0 + k * bench.dt_s * velocity;
      ASSERT_OK(bench.step());
    }
    // The true tip is at the reference one period after x_d, and ahead by the unknown delay.
    const Vector3 ahead = -bench.position_error() - bench.dt_s * velocity;
    assert_close(ahead, (2e-3 - told) * velocity, 3e-6);
  }
}

// Proves CP-2.

void it_starts_where_the_arm_stands_and_accelerates_from_rest(void**) {
  PoseBench bench;
  ASSERT_OK(bench.start(regular(4)));
  assert_true(bench.q_c() == bench.true_q && bench.dq_c() == zero);
  bench.x_d.p += Vector3(0.3, 0.3, 0.3);
  ASSERT_OK(bench.step());
  const JointVector most = bench.law.params.limits.ddq_max * bench.dt_s;
  assert_true((bench.dq_c().cwiseAbs() - most).maxCoeff() <= 1e-12);
  ASSERT_OK(bench.run(0.1));
  ASSERT_OK(bench.law.start(bench.dt_s));
  assert_true(bench.q_c() == bench.q && bench.dq_c() == zero);
}

void a_gain_too_large_for_the_period_is_refused_at_the_start(void**) {
  PoseBench bench;
  bench.law.params.rotation_gain[1] = 500.0;
  ASSERT_OK(bench.start(zero));
  bench.law.params.rotation_gain[1] = 500.1;
  ASSERT_STATUS(bench.start(zero), Status::kUnstableGain);
  bench.law.params.rotation_gain[1] = 50.0;
  bench.law.params.measurement_delay = 10e-3;
  ASSERT_STATUS(bench.start(zero), Status::kUnstableGain);

  static RoomyPipeline pipeline;
  static CartesianPose law;
  std::size_t kind = 0;
  while (Kinds::kTypes[kind] != CartesianPose::kType) ++kind;
  pipeline.append({Name("cpc"), kind, &law});
  pipeline.robot.period_us = 50000;
  ASSERT_OK(pipeline.start({}));
  pipeline.robot.period_us = 50001;
  ASSERT_STATUS(pipeline.start({}), Status::kUnstableGain);
}

void the_largest_gain_is_stable_with_measurements_two_periods_old(void**) {
  for (const int delay : {0, 1, 2}) {
    PoseBench bench;
    bench.dt_s = 8e-3;
    bench.delay = delay;
    bench.law.params.position_gain.setConstant(0.5 / bench.dt_s);
    bench.law.params.rotation_gain.setConstant(0.5 / bench.dt_s);
    ASSERT_OK(bench.start(regular(5)));
    bench.x_d.p += Vector3(1e-3, -1e-3, 1e-3);
    ASSERT_OK(bench.run(2.0));
    ASSERT_NEAR(bench.position_error().norm(), 0.0, 1e-6);
  }
}

// Proves CP-3.

void the_response_is_the_same_at_every_rate(void**) {
  const auto run = [](double dt_s) {
    PoseBench bench;
    bench.dt_s = dt_s;
    static_cast<void>(bench.start(regular(6)));
    bench.x_d.p += Vector3(0.03, -0.02, 0.02);
    bench.x_d.r = exp_so3({0.05, 0.0, -0.08}) * bench.x_d.r;
    std::array<Vector6, 5> at;
    for (Vector6& e : at) {
      if (bench.run(0.2) != Status::kOk) e.setConstant(std::nan(""));
      e << bench.position_error(), bench.rotation_error();
    }
    return at;
  };
  const auto fast = run(1e-4);
  for (const double dt_s : {1e-3, 2e-3, 8e-3}) {
    const auto slow = run(dt_s);
    const double bound = 10.0 * dt_s / 4.0;  // K dt / (2 e), and the start from rest
    for (std::size_t i = 0; i < fast.size(); ++i)
      ASSERT_NEAR((slow[i] - fast[i]).norm() / 0.103, 0.0, bound);
  }
}

// Proves CP-8.

void the_posture_is_approached_without_moving_the_tip(void**) {
  if (kDof <= 6) _skip(__FILE__, __LINE__);  // no null space
  RandomVectors random;
  for (int number = 0; number < 5; ++number) {
    PoseBench bench;
    ASSERT_OK(bench.start(regular(number)));
    const JointVector q0 = bench.true_q;
    bench.q_posture = q0;
    for (int i = 0; i < kDof; ++i) bench.q_posture[i] += 0.2 * random.unit();
    bench.law.q_posture.source = &bench.q_posture;
    const double before = (bench.q_posture - q0).norm();
    for (int k = 0; k < 4000; ++k) {
      ASSERT_OK(bench.step());
      ASSERT_NEAR((bench.J * bench.dq_c()).norm(), 0.0, 1e-4);
      assert_true(bench.position_error().norm() < 2e-6);
    }
    ASSERT_NEAR(bench.position_error().norm(), 0.0, 1e-8);
    assert_true((bench.q_posture - bench.true_q).norm() < before);
  }
}

/// Away from the posture of its start, with a reference that stands, the whole arm comes to rest.
void an_arm_that_holds_its_tip_holds_its_elbow(void**) {
  for (int number = 0; number < 5; ++number) {
    PoseBench bench;
    ASSERT_OK(bench.start(regular(number)));
    for (int k = 0; k < 500; ++k) {
      bench.x_d.p += Vector3(1e-4, -1e-4, 1e-4);
      ASSERT_OK(bench.step());
    }
    for (int k = 0; k < 2000; ++k) ASSERT_OK(bench.step());
    assert_true(bench.law.at_rest());
    ASSERT_NEAR(bench.position_error().norm(), 0.0, 1e-6);
  }
}

void in_one_period_the_posture_adds_nothing_to_the_twist(void**) {
  for (int number = 0; number < 20; ++number) {
    PoseBench with, without;
    without.law.params.posture_gain = 0.0;
    for (PoseBench* bench : {&with, &without}) {
      bench->law.params.limits.ddq_max.setConstant(1e6);
      ASSERT_OK(bench->start(regular(number)));
      bench->x_d.p += Vector3(1e-3, 2e-3, -1e-3);
      ASSERT_OK(bench->step());
    }
    ASSERT_NEAR((with.J * (with.dq_c() - without.dq_c())).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(on_its_reference_the_arm_stands),
      cmocka_unit_test(an_arm_that_holds_its_tip_holds_its_elbow),
      cmocka_unit_test(the_command_moves_the_tip_as_the_error_and_the_twist_say),
      cmocka_unit_test(a_slow_robot_is_corrected_slowly_and_a_standing_one_not_at_all),
      cmocka_unit_test(a_turn_is_made_on_the_shortest_arc),
      cmocka_unit_test(a_small_error_decays_as_an_exponential),
      cmocka_unit_test(a_known_delay_of_the_measurement_is_no_error),
      cmocka_unit_test(it_starts_where_the_arm_stands_and_accelerates_from_rest),
      cmocka_unit_test(a_gain_too_large_for_the_period_is_refused_at_the_start),
      cmocka_unit_test(the_largest_gain_is_stable_with_measurements_two_periods_old),
      cmocka_unit_test(the_response_is_the_same_at_every_rate),
      cmocka_unit_test(the_posture_is_approached_without_moving_the_tip),
      cmocka_unit_test(in_one_period_the_posture_adds_nothing_to_the_twist),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
