// The admittance with numbers that can be checked by hand: signs, equilibrium, axes, damping.
#include <algorithm>

#include "tests/control/admittance_bench.hpp"

namespace tactus {
namespace {

const CompliantFrame kFrames[] = {CompliantFrame::kDesired, CompliantFrame::kBase};

// Proves AD-2.

void without_a_wrench_the_command_is_the_desired_pose(void**) {
  AdmittanceBench bench;
  ASSERT_OK(bench.ac.start());
  bench.run(0.1);
  assert_true(bench.ac.x_c.value.p == bench.x_d.p && bench.ac.v_c.value.isZero(0.0));
  assert_true(distance(bench.ac.x_c.value.r, bench.x_d.r) == 0.0);
}

void where_the_environment_pushes_the_tool_yields(void**) {
  for (const CompliantFrame frame : kFrames)
    for (int i = 0; i < 3; ++i) {
      AdmittanceBench bench;
      bench.ac.params.frame = frame;
      bench.h = wrench(10.0 * Vector3::Unit(i), Vector3::Unit(i));
      ASSERT_OK(bench.ac.start());
      bench.run(8.0);
      assert_close(bench.moved(), 0.1 * Vector3::Unit(i), 1e-9);  // 10 N over 100 N/m
      assert_close(bench.turned(), 0.1 * Vector3::Unit(i), 1e-3);
      ASSERT_NEAR(bench.ac.v_c.value.norm(), 0.0, 1e-3);
    }
}

void pressing_with_a_force_takes_its_opposite_as_reference(void**) {
  AdmittanceBench bench;
  bench.h_d = wrench({0.0, 0.0, 20.0}, Vector3::Zero());  // the floor is to push up with 20 N
  ASSERT_OK(bench.ac.start());
  bench.run(8.0);
  assert_close(bench.moved(), {0.0, 0.0, -0.2}, 1e-9);  // so the tool seeks it below
  bench.h = bench.h_d;                                  // and there it is
  bench.run(8.0);
  assert_close(bench.moved(), Vector3::Zero(), 1e-9);
}

/// A floor of 2000 N/m at the desired height, pressed by a compliant axis without a spring.
void without_stiffness_the_force_is_the_one_asked_for(void**) {
  AdmittanceBench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.stiffness.z() = 0.0;
  bench.ac.params.damping.z() = 400.0;
  bench.h_d = wrench({0.0, 0.0, 20.0}, Vector3::Zero());
  ASSERT_OK(bench.ac.start());
  for (int i = 0; i < 4000; ++i) {
    bench.h[2] = std::max(0.0, -2000.0 * bench.moved().z());
    ASSERT_OK(bench.ac.step(1e-3));
  }
  ASSERT_NEAR(bench.h[2], 20.0, 1e-6);
}

void without_a_wire_to_it_the_reference_wrench_is_zero(void**) {
  AdmittanceBench bench;
  bench.h_d = wrench(50.0 * kOnes, kOnes);
  bench.ac.h_d = {};
  ASSERT_OK(bench.ac.start());
  bench.run(0.1);
  assert_close(bench.moved(), Vector3::Zero(), 0.0);
}

/// Stiff along x of its frame, soft along the others, so that the displacement shows the frame.
void stiffness_is_meant_in_the_compliant_frames_axes(void**) {
  for (const CompliantFrame frame : kFrames) {
    AdmittanceBench bench;
    bench.ac.params.frame = frame;
    bench.ac.params.stiffness = {1000.0, 100.0, 100.0};
    bench.ac.params.damping = {100.0, 40.0, 40.0};
    const Matrix3 axes =
        frame == CompliantFrame::kBase ? Matrix3(Matrix3::Identity()) : bench.x_d.r.matrix();
    bench.h = wrench({10.0, 0.0, 0.0}, Vector3::Zero());
    ASSERT_OK(bench.ac.start());
    bench.run(8.0);
    const Vector3 compliance(0.001, 0.01, 0.01);
    const Vector3 local = axes.transpose() * Vector3(10.0, 0.0, 0.0);
    assert_close(bench.moved(), axes * compliance.cwiseProduct(local), 1e-9);
  }
}

/// About a constant axis the rotation is that of a torsion spring, at any angle.
void a_moment_turns_the_tool_on_so3_up_to_its_bound(void**) {
  RandomVectors random;
  for (int i = 0; i < 20; ++i) {
    AdmittanceBench bench;
    bench.ac.params.frame = kFrames[i % 2];
    const Vector3 axis = random.axis();
    const double angle = 0.1 * i;
    if ((angle * axis).cwiseAbs().maxCoeff() > 1.8) continue;
    bench.ac.params.max_moment = 100.0;
    bench.h = wrench(Vector3::Zero(), 10.0 * angle * axis);
    ASSERT_OK(bench.ac.start());
    bench.run(20.0, 4e-3);
    const Vector3 expected = angle * axis;
    if ((bench.x_d.r.conjugate() * expected).cwiseAbs().maxCoeff() > 1.8) continue;
    assert_close(bench.turned(), expected, 1e-6);
  }
}

void a_ratio_of_one_is_critical_damping(void**) {
  AdmittanceBench ratio, value;
  ratio.ac.params.damping_given = DampingGiven::kAsRatio;
  ratio.ac.params.mass = value.ac.params.mass = 4.0 * kOnes;
  ratio.ac.params.damping = ratio.ac.params.rotational_damping = kOnes;
  value.ac.params.damping = 40.0 * kOnes;  // 2 sqrt(4 100)
  ratio.h = value.h = wrench({7.0, 8.0, 9.0}, Vector3::Zero());
  ASSERT_OK(ratio.ac.start());
  ASSERT_OK(value.ac.start());
  ratio.run(0.3);
  value.run(0.3);
  assert_close(ratio.moved(), value.moved(), 1e-15);
}

void a_ratio_cannot_damp_an_axis_without_stiffness(void**) {
  AdmittanceBench bench;
  bench.ac.params.damping_given = DampingGiven::kAsRatio;
  bench.ac.params.stiffness.y() = 0.0;
  ASSERT_STATUS(bench.ac.start(), Status::kBadValue);
  bench.ac.params.translation = static_cast<AxisSet>(0b101);  // y is rigid: nothing to damp
  ASSERT_OK(bench.ac.start());
}

// Proves AD-1.

void the_pose_at_an_instant_does_not_depend_on_the_period(void**) {
  AdmittanceBench slow, middle, fast;
  for (AdmittanceBench* bench : {&slow, &middle, &fast}) ASSERT_OK(bench->ac.start());
  RandomVectors random;
  for (int i = 0; i < 250; ++i) {
    if (i % 25 == 0) slow.h = wrench(30.0 * random.vector(), 5.0 * random.vector());
    middle.h = fast.h = slow.h;
    slow.run(8e-3, 8e-3);
    fast.run(8e-3, 1e-3);
    middle.run(4e-3, 2e-3);
    middle.run(4e-3, 4e-3);  // a period may change
    assert_close(middle.moved(), slow.moved(), 1e-13);
    assert_close(fast.moved(), slow.moved(), 1e-13);
    assert_close(fast.turned(), slow.turned(), 1e-12);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(without_a_wrench_the_command_is_the_desired_pose),
      cmocka_unit_test(where_the_environment_pushes_the_tool_yields),
      cmocka_unit_test(pressing_with_a_force_takes_its_opposite_as_reference),
      cmocka_unit_test(without_stiffness_the_force_is_the_one_asked_for),
      cmocka_unit_test(without_a_wire_to_it_the_reference_wrench_is_zero),
      cmocka_unit_test(stiffness_is_meant_in_the_compliant_frames_axes),
      cmocka_unit_test(a_moment_turns_the_tool_on_so3_up_to_its_bound),
      cmocka_unit_test(a_ratio_of_one_is_critical_damping),
      cmocka_unit_test(a_ratio_cannot_damp_an_axis_without_stiffness),
      cmocka_unit_test(the_pose_at_an_instant_does_not_depend_on_the_period),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
