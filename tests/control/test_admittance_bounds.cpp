// Bounds of the admittance: it never exceeds one, winds up at one, jumps at start, or passes on
// NaN.
#include "tests/control/admittance_bench.hpp"

namespace tactus {
namespace {

// Proves AD-4.

void axes_that_are_not_in_the_set_do_not_yield(void**) {
  for (int set = 0; set < 8; ++set) {
    AdmittanceBench bench;
    bench.ac.params.frame = CompliantFrame::kBase;
    bench.ac.params.translation = static_cast<AxisSet>(set);
    bench.ac.params.rotation = static_cast<AxisSet>(7 - set);
    bench.h = wrench(10.0 * kOnes, kOnes);
    ASSERT_OK(bench.ac.start());
    bench.run(0.2);
    const char* word = name(static_cast<AxisSet>(set));
    for (int i = 0; i < 3; ++i) {
      const char* letter = word;  // "none" contains no x, y, z
      while (*letter != 0 && *letter != "xyz"[i]) ++letter;
      assert_int_equal(bench.moved()[i] > 1e-3, *letter != 0);
    }
    if (set == 7) assert_close(bench.turned(), Vector3::Zero(), 1e-15);
    if (set == 6) assert_close(bench.turned().cross(Vector3::UnitX()), Vector3::Zero(), 1e-15);
  }
}

void bounds_are_kept_over_random_wrenches(void**) {
  RandomVectors random;
  for (int trial = 0; trial < 60; ++trial) {
    AdmittanceBench bench;
    Admittance::Params& p = bench.ac.params;
    p.frame = CompliantFrame::kBase;
    p.mass = p.inertia = std::pow(10.0, random.between(-2.0, 2.0)) * kOnes;
    p.damping = p.rotational_damping = std::pow(10.0, random.between(-2.0, 3.0)) * kOnes;
    p.stiffness = p.rotational_stiffness = std::pow(10.0, random.between(-2.0, 5.0)) * kOnes;
    p.max_displacement = 0.05;
    p.max_velocity = 0.2;
    p.max_rotation = 0.3;
    p.max_angular_velocity = 0.5;
    const double dt_s = random.between(1e-3, 8e-3);
    ASSERT_OK(bench.ac.start());
    Vector3 last = Vector3::Zero();
    for (int i = 0; i < 400; ++i) {
      if (i % 20 == 0) bench.h = wrench(200.0 * random.vector(), 30.0 * random.vector());
      ASSERT_OK(bench.ac.step(dt_s));
      const Vector3 moved = bench.moved();
      assert_true(moved.cwiseAbs().maxCoeff() <= 0.05 + 1e-15);
      assert_true(bench.ac.v_c.value.head<3>().cwiseAbs().maxCoeff() <= 0.2);
      assert_true((moved - last).cwiseAbs().maxCoeff() <= 0.2 * dt_s + 1e-15);
      assert_true(bench.turned().cwiseAbs().maxCoeff() <= 0.3 + 1e-15);
      assert_true(bench.ac.v_c.value.tail<3>().norm() <= 0.5 * std::sqrt(3.0) + 1e-12);
      last = moved;
    }
  }
}

void behind_a_bound_nothing_winds_up(void**) {
  AdmittanceBench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.max_displacement = 0.05;
  bench.h[0] = 50.0;  // the spring would give 0.5 m
  ASSERT_OK(bench.ac.start());
  assert_false(bench.ac.limited.value);
  bench.run(5.0);
  ASSERT_NEAR(bench.moved().x(), 0.05, 1e-15);
  assert_true(bench.ac.v_c.value[0] == 0.0 && bench.ac.limited.value);
  bench.h[0] = 0.0;  // released, it moves at once, as from rest at the bound
  bench.run(1e-3);
  assert_true(bench.moved().x() < 0.05 && bench.ac.v_c.value[0] < 0.0);
  assert_false(bench.ac.limited.value);
}

void a_force_beyond_its_bound_counts_as_the_bound(void**) {
  AdmittanceBench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.max_force = 20.0;
  bench.ac.params.max_moment = 2.0;
  bench.h = wrench({1e9, -1e9, 10.0}, {1e9, 0.0, 0.0});
  ASSERT_OK(bench.ac.start());
  bench.run(8.0);
  assert_close(bench.moved(), {0.2, -0.2, 0.1}, 1e-9);
  assert_close(bench.turned(), {0.2, 0.0, 0.0}, 1e-3);
  assert_true(bench.ac.limited.value);
}

// Proves AD-5.

void starting_moves_nothing_whatever_pushes_and_whatever_was_before(void**) {
  AdmittanceBench bench;
  bench.h = wrench(50.0 * kOnes, kOnes);
  for (int i = 0; i < 2; ++i) {
    ASSERT_OK(bench.ac.start());
    assert_true(bench.ac.x_c.value.p == bench.x_d.p && bench.ac.v_c.value.isZero(0.0));
    assert_true(distance(bench.ac.x_c.value.r, bench.x_d.r) == 0.0);
    bench.run(1e-3);  // 50 N on 1 kg for 1 ms
    assert_true(bench.moved().cwiseAbs().maxCoeff() < 0.6 * 50.0 * 1.75 * 1e-6);
    bench.run(1.0);
  }
}

void what_is_not_finite_never_becomes_a_pose(void**) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (int input = 0; input < 25; ++input) {
      AdmittanceBench bench, untouched;
      bench.h = untouched.h = wrench(kOnes, kOnes);
      ASSERT_OK(bench.ac.start());
      ASSERT_OK(untouched.ac.start());
      double* values[] = {bench.x_d.p.data(), bench.x_d.r.coeffs().data(), bench.v_d.data(),
                          bench.h.data(), bench.h_d.data()};
      const int first[] = {0, 3, 7, 13, 19};
      int which = 4;
      while (first[which] > input) --which;
      double& value = values[which][input - first[which]];
      const double good = value;
      value = bad;
      ASSERT_STATUS(bench.ac.step(1e-3), Status::kCommandNotFinite);
      value = good;  // the refused cycle has no effect
      bench.run(1e-3);
      untouched.run(1e-3);
      assert_true(bench.ac.x_c.value.p == untouched.ac.x_c.value.p);
      value = bad;
      ASSERT_STATUS(bench.ac.start(), Status::kCommandNotFinite);
    }
}

// Proves AD-6.

/// Pushed, moving and stretched, the displacement stops within the robot's acceleration limits, and
/// then neither spring nor wrench moves it; the next start begins without displacement.
void braked_the_displacement_comes_to_rest_and_is_held(void**) {
  for (const BrakeWay way : {BrakeWay::kOnPath, BrakeWay::kAtOnce}) {
    AdmittanceBench bench;
    bench.h = wrench({30.0, -20.0, 10.0}, {1.0, 0.5, -1.0});
    ASSERT_OK(bench.ac.start());
    bench.run(0.1);
    bench.h.setZero();  // the spring would pull back
    Vector6 v = bench.ac.v_c.value;
    assert_true(v.head<3>().norm() > 0.05 && v.tail<3>().norm() > 0.05);
    constexpr double kDt_s = 1e-3;
    for (int k = 0; k < 500; ++k) {
      bench.ac.brake(Status::kHalted, way);
      const Vector3 before = bench.moved();
      ASSERT_OK(bench.ac.step(kDt_s));
      const Vector6& now = bench.ac.v_c.value;
      assert_true((now - v).head<3>().norm() <= Robot::kTaskLimit.a_max * kDt_s);
      assert_true((now - v).tail<3>().norm() <= Robot::kTaskLimit.alpha_max * kDt_s);
      assert_close(bench.moved() - before, 0.5 * kDt_s * (now + v).head<3>(), 1e-12);
      v = now;
    }
    ASSERT_NEAR(v.norm(), 0.0, 0.0);
    const Vector3 held = bench.moved();
    assert_true(held.norm() > 0.01);
    bench.h = wrench({50.0, 50.0, 50.0}, Vector3::Zero());
    bench.run(1.0);
    assert_close(bench.moved(), held, 1e-12);
    ASSERT_OK(bench.ac.start());
    assert_close(bench.moved(), Vector3::Zero(), 1e-12);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(axes_that_are_not_in_the_set_do_not_yield),
      cmocka_unit_test(bounds_are_kept_over_random_wrenches),
      cmocka_unit_test(behind_a_bound_nothing_winds_up),
      cmocka_unit_test(a_force_beyond_its_bound_counts_as_the_bound),
      cmocka_unit_test(starting_moves_nothing_whatever_pushes_and_whatever_was_before),
      cmocka_unit_test(what_is_not_finite_never_becomes_a_pose),
      cmocka_unit_test(braked_the_displacement_comes_to_rest_and_is_held),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
