// Cartesian pose control at the edges: whatever the reference, the joints keep their limits;
// through singularities, out of reach and back; with joints that are blocked.
#include "tests/pose_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr double kOver = 1.0 + 1e-9;
const JointLimits kLimits;

/// Watches one run: what no command may ever do.
struct Watch {
  PoseBench& bench;
  bool follows = true;  ///< the robot does, so accelerations are limited too
  JointVector dq = bench.dq_c();

  Status step() {
    const JointVector before = bench.q_c();
    TRY(bench.step());
    const JointVector& now = bench.dq_c();
    for (int i = 0; i < kDof; ++i) {
      assert_true(std::abs(now[i]) <= kLimits.dq_max[i]);
      assert_true(bench.q_c()[i] <= std::max(kLimits.q_max[i] - 0.01, before[i]) + 1e-12);
      assert_true(bench.q_c()[i] >= std::min(kLimits.q_min[i] + 0.01, before[i]) - 1e-12);
      ASSERT_NEAR(bench.q_c()[i], before[i] + bench.dt_s * now[i], 1e-14);
      if (follows) assert_true(std::abs(now[i] - dq[i]) <= kLimits.ddq_max[i] * bench.dt_s * kOver);
    }
    assert_true(bench.law.scale.value >= 0.0 && bench.law.scale.value <= 1.0);
    dq = now;
    return Status::kOk;
  }
};

/// Joints where sigma is as small as a seeded descent finds it.
JointVector singular_joints(Random& random) {
  JointVector q = random_joints(random, 0.8);
  double sigma = sigma_at(q), reach = 0.3;
  while (reach > 1e-6 && sigma > 1e-5) {
    JointVector tried = q;
    for (int i = 0; i < kDof; ++i) tried[i] += reach * random.unit();
    const JointVector margin = 0.05 * (kLimits.q_max - kLimits.q_min);
    tried = tried.cwiseMax(kLimits.q_min + margin).cwiseMin(kLimits.q_max - margin);
    const double now = sigma_at(tried);
    reach *= now < sigma ? 1.5 : 0.97;
    if (now < sigma) q = tried, sigma = now;
  }
  return q;
}

/// From 0 to 1 and back within two seconds, at rest in between and at the ends; its rate.
double out_and_back(double t, double& rate) {
  rate = t < 2.0 ? 0.5 * kPi * std::sin(kPi * t) : 0.0;
  return t < 2.0 ? 0.5 - 0.5 * std::cos(kPi * t) : 0.0;
}

// Proves CP-4.

void the_speed_limits_scale_the_twist_and_keep_its_direction(void**) {
  Random random;
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
  Random random;
  bench.law.params.max_speed = 0.1, bench.law.params.max_angular_speed = 0.2;
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
  Random random;
  for (const double dt_s : {1e-3, 2e-3, 8e-3})
    for (const int delay : {0, 2}) {
      PoseBench bench;
      bench.dt_s = dt_s, bench.delay = delay;
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
  Random random;
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

/// A joint is put close to its limit and the tip is asked to where the joint would have to go
/// further, then back.
void a_joint_at_its_limit_stops_there_and_can_leave(void**) {
  Random random;
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

// Proves CP-5.

void it_passes_through_singularities(void**) {
  Random random;
  int passed = 0;
  for (int number = 0; number < 60; ++number) {
    JointVector from = singular_joints(random), way;
    for (int i = 0; i < kDof; ++i) way[i] = random.unit() > 0.0 ? 0.27 : -0.27;
    from -= 0.5 * way;  // the singularity lies in the middle of the way
    PoseBench bench;
    bench.law.params.posture_gain = 10.0;  // to stay on the way, and not to evade
    bench.law.q_posture.source = &bench.q_posture;
    bench.dt_s = number % 2 == 0 ? 1e-3 : 8e-3;
    ASSERT_OK(bench.start(from));
    Watch watch{bench};
    double nearest = 1.0;
    for (double t = 0.0; t < 6.0; t += bench.dt_s) {
      double rate = 0.0;
      const double s = out_and_back(t, rate);
      Jacobian J;
      bench.q_posture = from + s * way;
      bench.x_d = tip_at(bench.q_posture, J);
      bench.v_d = J * (rate * way);
      ASSERT_OK(watch.step());
      nearest = std::min(nearest, bench.law.sigma.value);
    }
    assert_true(bench.position_error().norm() < 1e-3 && bench.rotation_error().norm() < 1e-3);
    passed += nearest < 0.01;
  }
  print_message("%d singularities passed\n", passed);
  assert_true(passed >= 50);
}

void it_goes_out_of_reach_along_the_edge_and_comes_back(void**) {
  Random random;
  int edges = 0;
  for (int number = 0; number < 60; ++number) {
    PoseBench bench;
    bench.dt_s = number % 2 == 0 ? 1e-3 : 8e-3;
    ASSERT_OK(bench.start(regular_joints(random)));
    Watch watch{bench};
    const Pose home = bench.x_d;
    const Vector3 out = 0.4 * random.axis(), along = 0.2 * random.axis();
    double nearest = 1.0;
    for (double t = 0.0; t < 8.0; t += bench.dt_s) {
      double rate = 0.0, side_rate = 0.0;
      const double s = out_and_back(0.5 * t, rate), side = out_and_back(t, side_rate);
      bench.x_d.p = home.p + s * out + side * along;
      bench.v_d << 0.5 * rate * out + side_rate * along, Vector3::Zero();
      ASSERT_OK(watch.step());
      nearest = std::min(nearest, bench.law.sigma.value);
    }
    if (nearest > 0.05) continue;
    ++edges;
    assert_true(bench.position_error().norm() < 0.01 && bench.rotation_error().norm() < 0.01);
  }
  print_message("%d edges\n", edges);
  assert_true(edges >= 10);
}

void out_of_reach_it_comes_to_rest(void**) {
  Random random;
  for (int number = 0; number < 10; ++number) {
    PoseBench bench;
    ASSERT_OK(bench.start(regular_joints(random)));
    bench.x_d.p += 0.6 * random.axis();
    ASSERT_OK(bench.run(12.0));
    const JointVector before = bench.dq_c();
    ASSERT_OK(bench.step());
    assert_true((bench.dq_c() - before).norm() / bench.dt_s < 0.5);
    assert_true(bench.dq_c().norm() < 0.1);
  }
}

// Proves CP-7.

void a_blocked_arm_is_not_run_away_from_and_released_without_a_jump(void**) {
  Random random;
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
      cmocka_unit_test(it_passes_through_singularities),
      cmocka_unit_test(it_goes_out_of_reach_along_the_edge_and_comes_back),
      cmocka_unit_test(out_of_reach_it_comes_to_rest),
      cmocka_unit_test(a_blocked_arm_is_not_run_away_from_and_released_without_a_jump),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
