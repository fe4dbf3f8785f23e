// The admittance by numbers one can check in the head, and by properties over seeded random
// inputs: signs, equilibrium, axes, bounds, start, bad input. Gains 100 N/m and 10 N m/rad.
#include "kernel/control/admittance.hpp"

#include <algorithm>

#include "kernel/math/sincos.hpp"
#include "tests/rotation_cases.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

const Vector3 kOnes = Vector3::Ones();

Vector6 wrench(const Vector3& f, const Vector3& m) {
  Vector6 both;
  both << f, m;
  return both;
}

/// The law, wired to values the test owns; wide bounds.
struct Bench {
  Pose x_d;
  Vector6 v_d = Vector6::Zero(), h = Vector6::Zero(), h_d = Vector6::Zero();
  Admittance ac;
  Bench() {
    ac.params.mass = ac.params.inertia = kOnes;
    ac.params.stiffness = 100.0 * kOnes, ac.params.damping = 40.0 * kOnes;
    ac.params.rotational_stiffness = 10.0 * kOnes, ac.params.rotational_damping = 12.0 * kOnes;
    ac.params.max_displacement = 1.0, ac.params.max_rotation = 1.8;
    ac.params.max_velocity = 2.0, ac.params.max_angular_velocity = 10.0;
    x_d = {{0.4, -0.2, 0.5}, exp_so3({0.7, -1.9, 0.4})};
    ac.x_d.source = &x_d, ac.v_d.source = &v_d, ac.h.source = &h, ac.h_d.source = &h_d;
  }
  void run(double duration_s, double dt_s = 1e-3) {
    for (int i = 0; i * dt_s < duration_s - 0.5 * dt_s; ++i) ASSERT_OK(ac.step(dt_s));
  }
  /// Displacement in base axes.
  Vector3 moved() const { return ac.x_c.value.p - x_d.p; }
  Vector3 turned() const { return log_so3(ac.x_c.value.r * x_d.r.conjugate()); }
};

const CompliantFrame kFrames[] = {CompliantFrame::kDesired, CompliantFrame::kBase};

// Proves AD-2.

void without_a_wrench_the_command_is_the_desired_pose(void**) {
  Bench bench;
  ASSERT_OK(bench.ac.start());
  bench.run(0.1);
  assert_true(bench.ac.x_c.value.p == bench.x_d.p && bench.ac.v_c.value.isZero(0.0));
  assert_true(distance(bench.ac.x_c.value.r, bench.x_d.r) == 0.0);
}

void where_the_environment_pushes_the_tool_yields(void**) {
  for (const CompliantFrame frame : kFrames)
    for (int i = 0; i < 3; ++i) {
      Bench bench;
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
  Bench bench;
  bench.h_d = wrench({0.0, 0.0, 20.0}, Vector3::Zero());  // the floor shall push up with 20 N
  ASSERT_OK(bench.ac.start());
  bench.run(8.0);
  assert_close(bench.moved(), {0.0, 0.0, -0.2}, 1e-9);  // so the tool seeks it below
  bench.h = bench.h_d;                                  // and there it is
  bench.run(8.0);
  assert_close(bench.moved(), Vector3::Zero(), 1e-9);
}

/// A floor of 2000 N/m at the desired height, pressed by a compliant axis without a spring.
void without_stiffness_the_force_is_the_one_asked_for(void**) {
  Bench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.stiffness.z() = 0.0, bench.ac.params.damping.z() = 400.0;
  bench.h_d = wrench({0.0, 0.0, 20.0}, Vector3::Zero());
  ASSERT_OK(bench.ac.start());
  for (int i = 0; i < 4000; ++i) {
    bench.h[2] = std::max(0.0, -2000.0 * bench.moved().z());
    ASSERT_OK(bench.ac.step(1e-3));
  }
  ASSERT_NEAR(bench.h[2], 20.0, 1e-6);
}

void without_a_wire_to_it_the_reference_wrench_is_zero(void**) {
  Bench bench;
  bench.h_d = wrench(50.0 * kOnes, kOnes), bench.ac.h_d = {};
  ASSERT_OK(bench.ac.start());
  bench.run(0.1);
  assert_close(bench.moved(), Vector3::Zero(), 0.0);
}

/// Stiff along x of its frame, soft along the others: the displacement tells which frame it is.
void stiffness_is_meant_in_the_compliant_frames_axes(void**) {
  for (const CompliantFrame frame : kFrames) {
    Bench bench;
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

/// About an axis that does not move the rotation is that of a torsion spring, at any angle.
void a_moment_turns_the_tool_on_so3_up_to_its_bound(void**) {
  Random random;
  for (int i = 0; i < 20; ++i) {
    Bench bench;
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
  Bench ratio, value;
  ratio.ac.params.damping_given = DampingGiven::kAsRatio;
  ratio.ac.params.mass = value.ac.params.mass = 4.0 * kOnes;
  ratio.ac.params.damping = ratio.ac.params.rotational_damping = kOnes;
  value.ac.params.damping = 40.0 * kOnes;  // 2 sqrt(4 100)
  ratio.h = value.h = wrench({7.0, 8.0, 9.0}, Vector3::Zero());
  ASSERT_OK(ratio.ac.start());
  ASSERT_OK(value.ac.start());
  ratio.run(0.3), value.run(0.3);
  assert_close(ratio.moved(), value.moved(), 1e-15);
}

void a_ratio_cannot_damp_an_axis_without_stiffness(void**) {
  Bench bench;
  bench.ac.params.damping_given = DampingGiven::kAsRatio;
  bench.ac.params.stiffness.y() = 0.0;
  ASSERT_STATUS(bench.ac.start(), Status::kBadValue);
  bench.ac.params.translation = static_cast<AxisSet>(0b101);  // y is rigid: nothing to damp
  ASSERT_OK(bench.ac.start());
}

// Proves AD-1.

void the_pose_at_an_instant_does_not_depend_on_the_period(void**) {
  Bench slow, middle, fast;
  for (Bench* bench : {&slow, &middle, &fast}) ASSERT_OK(bench->ac.start());
  Random random;
  for (int i = 0; i < 250; ++i) {
    if (i % 25 == 0) slow.h = wrench(30.0 * random.vector(), 5.0 * random.vector());
    middle.h = fast.h = slow.h;
    slow.run(8e-3, 8e-3), middle.run(8e-3, 2e-3), fast.run(8e-3, 1e-3);
    assert_close(middle.moved(), slow.moved(), 1e-13);
    assert_close(fast.moved(), slow.moved(), 1e-13);
    assert_close(fast.turned(), slow.turned(), 1e-12);
  }
}

// Proves AD-4.

void axes_that_are_not_in_the_set_do_not_yield(void**) {
  for (int set = 0; set < 8; ++set) {
    Bench bench;
    bench.ac.params.frame = CompliantFrame::kBase;
    bench.ac.params.translation = static_cast<AxisSet>(set);
    bench.ac.params.rotation = static_cast<AxisSet>(7 - set);
    bench.h = wrench(10.0 * kOnes, kOnes);
    ASSERT_OK(bench.ac.start());
    bench.run(0.2);
    const char* word = kAxisSetWords[static_cast<std::size_t>(set)];
    for (int i = 0; i < 3; ++i) {
      const char* letter = word;  // "none" has none of x, y, z
      while (*letter != 0 && *letter != "xyz"[i]) ++letter;
      assert_int_equal(bench.moved()[i] > 1e-3, *letter != 0);
    }
    if (set == 7) assert_close(bench.turned(), Vector3::Zero(), 1e-15);
    if (set == 6) assert_close(bench.turned().cross(Vector3::UnitX()), Vector3::Zero(), 1e-15);
  }
}

void bounds_are_kept_over_random_wrenches(void**) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    Bench bench;
    Admittance::Params& p = bench.ac.params;
    p.frame = CompliantFrame::kBase;
    p.mass = p.inertia = std::pow(10.0, random.between(-2.0, 2.0)) * kOnes;
    p.damping = p.rotational_damping = std::pow(10.0, random.between(-2.0, 3.0)) * kOnes;
    p.stiffness = p.rotational_stiffness = std::pow(10.0, random.between(-2.0, 5.0)) * kOnes;
    p.max_displacement = 0.05, p.max_velocity = 0.2;
    p.max_rotation = 0.3, p.max_angular_velocity = 0.5;
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
  Bench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.max_displacement = 0.05;
  bench.h[0] = 50.0;  // the spring would give 0.5 m
  ASSERT_OK(bench.ac.start());
  assert_false(bench.ac.limited.value);
  bench.run(5.0);
  ASSERT_NEAR(bench.moved().x(), 0.05, 1e-15);
  assert_true(bench.ac.v_c.value[0] == 0.0 && bench.ac.limited.value);
  bench.h[0] = 0.0;  // let go: it moves at once, as from rest there
  bench.run(1e-3);
  assert_true(bench.moved().x() < 0.05 && bench.ac.v_c.value[0] < 0.0);
  assert_false(bench.ac.limited.value);
}

void a_force_beyond_its_bound_counts_as_the_bound(void**) {
  Bench bench;
  bench.ac.params.frame = CompliantFrame::kBase;
  bench.ac.params.max_force = 20.0, bench.ac.params.max_moment = 2.0;
  bench.h = wrench({1e9, -1e9, 10.0}, {1e9, 0.0, 0.0});
  ASSERT_OK(bench.ac.start());
  bench.run(8.0);
  assert_close(bench.moved(), {0.2, -0.2, 0.1}, 1e-9);
  assert_close(bench.turned(), {0.2, 0.0, 0.0}, 1e-3);
  assert_true(bench.ac.limited.value);
}

// Proves AD-5.

void starting_moves_nothing_whatever_pushes_and_whatever_was_before(void**) {
  Bench bench;
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
      Bench bench;
      ASSERT_OK(bench.ac.start());
      double* values[] = {bench.x_d.p.data(), bench.x_d.r.coeffs().data(), bench.v_d.data(),
                          bench.h.data(), bench.h_d.data()};
      const int first[] = {0, 3, 7, 13, 19};
      int which = 4;
      while (first[which] > input) --which;
      double& value = values[which][input - first[which]];
      const double good = value;
      value = bad;
      ASSERT_STATUS(bench.ac.step(1e-3), Status::kCommandNotFinite);
      ASSERT_STATUS(bench.ac.start(), Status::kCommandNotFinite);
      value = good;  // and leaves no trace
      ASSERT_OK(bench.ac.step(1e-3));
      assert_close(bench.moved(), Vector3::Zero(), 0.0);
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
      cmocka_unit_test(axes_that_are_not_in_the_set_do_not_yield),
      cmocka_unit_test(bounds_are_kept_over_random_wrenches),
      cmocka_unit_test(behind_a_bound_nothing_winds_up),
      cmocka_unit_test(a_force_beyond_its_bound_counts_as_the_bound),
      cmocka_unit_test(starting_moves_nothing_whatever_pushes_and_whatever_was_before),
      cmocka_unit_test(what_is_not_finite_never_becomes_a_pose),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
