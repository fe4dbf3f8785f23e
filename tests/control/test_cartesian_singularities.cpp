// Cartesian pose control where the Jacobian loses rank: through singularities, out of reach and
// back.
#include "tests/control/pose_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// Returns joints with the smallest sigma that a seeded descent finds.
JointVector singular_joints(RandomVectors& random) {
  JointVector q = random_joints(random, 0.8);
  double sigma = sigma_at(q), reach = 0.3;
  while (reach > 1e-6 && sigma > 1e-5) {
    JointVector tried = q;
    for (int i = 0; i < kDof; ++i) tried[i] += reach * random.unit();
    const JointVector margin = (0.05 * (kLimits.q_max - kLimits.q_min)).cwiseMax(0.15);
    tried = tried.cwiseMax(kLimits.q_min + margin).cwiseMin(kLimits.q_max - margin);
    const double now = sigma_at(tried);
    reach *= now < sigma ? 1.5 : 0.97;
    if (now < sigma) {
      q = tried;
      sigma = now;
    }
  }
  return q;
}

/// Returns a motion from 0 to 1 and back within two seconds, at rest at 0 and at 1; sets its rate.
double out_and_back(double t, double& rate) {
  rate = t < 2.0 ? 0.5 * kPi * std::sin(kPi * t) : 0.0;
  return t < 2.0 ? 0.5 - 0.5 * std::cos(kPi * t) : 0.0;
}

// Proves CP-5.

void it_passes_through_singularities(void**) {
  RandomVectors random;
  int passed = 0;
  for (int number = 0; number < 60; ++number) {
    JointVector from = singular_joints(random), way;
    for (int i = 0; i < kDof; ++i) way[i] = random.unit() > 0.0 ? 0.27 : -0.27;
    from -= 0.5 * way;  // the singularity is in the middle of the way
    PoseBench bench;
    bench.law.params.posture_gain = 10.0;  // keeps the arm from evading the singularity
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

/// True if a joint is at an end of its range.
bool at_a_stop(const JointVector& q) {
  return (q - kLimits.q_min).cwiseMin(kLimits.q_max - q).minCoeff() < 0.03;
}

/// An arm that bends to both sides may come back bent to the other side, and there a joint may
/// reach its stop, or the arm a singularity along which the tip is missing, before the tip is back.
void it_goes_out_of_reach_along_the_edge_and_comes_back(void**) {
  RandomVectors random;
  int edges = 0, back = 0;
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
    const bool is_back =
        bench.position_error().norm() < 0.01 && bench.rotation_error().norm() < 0.01;
    assert_true(is_back || at_a_stop(bench.true_q) || bench.law.sigma.value < 1e-3);
    back += is_back;
  }
  print_message("%d edges, back from %d\n", edges, back);
  assert_true(back >= 10 && 2 * back > edges);
}

void out_of_reach_it_comes_to_rest(void**) {
  RandomVectors random;
  for (int number = 0; number < 10; ++number) {
    PoseBench bench;
    bench.dt_s = number % 2 == 0 ? 1e-3 : 8e-3;
    ASSERT_OK(bench.start(regular_joints(random)));
    bench.x_d.p += 0.6 * random.axis();
    ASSERT_OK(bench.run(12.0));
    const JointVector before = bench.dq_c();
    ASSERT_OK(bench.step());
    assert_true((bench.dq_c() - before).norm() / bench.dt_s < 0.5);
    assert_true(bench.dq_c().norm() < 0.1);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_passes_through_singularities),
      cmocka_unit_test(it_goes_out_of_reach_along_the_edge_and_comes_back),
      cmocka_unit_test(out_of_reach_it_comes_to_rest),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
