// Tests the plant's arm: its model against published numbers of other codes, its motion against the
// laws of mechanics.
#include <Eigen/Geometry>
#include <cmath>

#include "kernel/core/joint_limits.hpp"
#include "sim_plant/arm/arm.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/oracles/published.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

template <int rows, int columns>
using Rows = Eigen::Matrix<double, rows, columns, Eigen::RowMajor>;

constexpr double kG = 9.81;  // m/s^2

/// The model without friction, rotors and payload at one state.
struct Model {
  double p[3], R[3][3], J[6][kDof], g[kDof], c[kDof], M[kDof][kDof];

  explicit Model(const JointVector& q, const JointVector& dq = JointVector::Zero()) {
    mujoco_flange(q.data(), p, R);
    mujoco_jacobian(q.data(), J);
    mujoco_gravity(q.data(), g);
    mujoco_coriolis(q.data(), dq.data(), c);
    mujoco_mass_matrix(q.data(), M);
  }
  /// Jacobian of a point r [m] of the flange frame: J_v + J_w x R r.
  Rows<3, kDof> point_jacobian(const Vector3& r) const {
    Rows<3, kDof> result(J[0]);
    const Vector3 lever = Rows<3, 3>(R[0]) * r;
    for (int i = 0; i < kDof; ++i) result.col(i) += Vector3(J[3][i], J[4][i], J[5][i]).cross(lever);
    return result;
  }
  /// Kinetic energy of the links alone, J.
  double kinetic_energy(const JointVector& dq) const {
    return 0.5 * dq.dot(Rows<kDof, kDof>(M[0]) * dq);
  }
};

/// Differs from the default: no friction, no rotors, and a pose in which gravity loads every joint
/// it can.
PlantParams bare() {
  PlantParams params;
  params.initial_q = JointVector(published().states[3].q);
  params.friction = 0.0;
  params.rotor_inertia.setZero();
  return params;
}

JointVector joints(const double (&values)[kDof]) {
  return Eigen::Map<const JointVector>(values);
}

// Proves MOD-1.

void flange_and_gravity_are_those_of_the_reference(void**) {
  for (const auto& row : published().states) {
    const Model model(joints(row.q));
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(model.p[i], row.flange[i], 1e-9);
    for (int i = 0; i < kDof; ++i) ASSERT_NEAR(model.g[i], row.g[i], 1e-9);
  }
}

void the_mass_matrix_is_that_of_the_reference(void**) {
  const auto& row = published().inertia;
  const Model model(joints(row.q));
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(model.M[i][i], row.diagonal[i], 1e-9);
}

// Proves SIM-1.

/// The energy is 31 to 45 J. Measured errors: 6.6e-5 J, 2.4e-7 J at 0.25 ms, 2.9e-4 J for an arm
/// whose wrist is light.
void a_free_swing_without_friction_keeps_its_energy(void**) {
  static Arm arm;
  ASSERT_OK(arm.load(bare()));
  const double before = arm.energy();
  for (int k = 0; k < 1000; ++k) {
    arm.step(JointVector::Zero(), 1e-3);
    ASSERT_NEAR(arm.energy(), before, 4e-4);
  }
}

/// Joint positions after 256 ms with the robot's friction and a twentieth of its torques,
/// integrated in steps of dt_s.
JointVector fall(double dt_s) {
  static Arm arm;
  PlantParams params = bare();
  params.friction = 1.0;
  ASSERT_OK(arm.load(params));
  // On a lifting column gravity turns no joint.
  const JointVector tau = (is_prismatic<Robot>(0) ? 0.01 : 0.0) * JointLimits().tau_max;
  for (int k = 0; k < std::lround(0.256 / dt_s); ++k) arm.step(tau, dt_s);
  return arm.q();
}

void halving_the_step_divides_the_error_by_sixteen(void**) {
  const JointVector exact = fall(0.0625e-3);
  const double coarse = (fall(1e-3) - exact).norm(), fine = (fall(0.5e-3) - exact).norm();
  ASSERT_NEAR(coarse / fine, 16.0, 2.0);
}

void a_long_step_is_cut_into_steps_of_at_most_a_millisecond(void**) {
  static Arm cut, whole;
  ASSERT_OK(cut.load(bare()));
  ASSERT_OK(whole.load(bare()));
  for (int k = 0; k < 8; ++k) cut.step(JointVector::Zero(), 1e-3);
  whole.step(JointVector::Zero(), 8e-3);
  assert_memory_equal(cut.q().data(), whole.q().data(), sizeof(JointVector));
}

// Proves SIM-2.

void a_payload_weighs_its_mass_times_its_lever(void**) {
  static Arm arm;
  PlantParams params = bare();
  params.payload_kg = 2.0;
  params.payload_com = Vector3(0.05, -0.02, 0.1);
  ASSERT_OK(arm.load(params));
  const Model model(params.initial_q);
  const JointVector lever = model.point_jacobian(params.payload_com).row(2).transpose();  // m
  const JointVector g = arm.stand();
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(g[i], model.g[i] + 2.0 * kG * lever[i], 1e-12);
}

void the_kinetic_energy_is_that_of_links_rotors_and_payload(void**) {
  static Arm arm;
  PlantParams params = bare();
  params.rotor_inertia = JointVector::LinSpaced(0.6, 0.05);
  params.payload_kg = 2.0;
  params.payload_com = Vector3(0.05, -0.02, 0.1);
  ASSERT_OK(arm.load(params));
  for (int k = 0; k < 300; ++k) arm.step(JointVector::Zero(), 1e-3);

  const JointVector dq = arm.dq();
  const Model model(arm.q());
  const Vector3 v = model.point_jacobian(params.payload_com) * dq;
  const double links = model.kinetic_energy(dq), payload = 0.5 * 2.0 * v.squaredNorm();
  const double rotors = 0.5 * dq.dot(params.rotor_inertia.cwiseProduct(dq));
  const double moving = arm.energy();
  arm.stand();
  assert_true(links > 0.1 && payload > 0.1 && rotors > 0.1);
  ASSERT_NEAR(moving - arm.energy(), links + payload + rotors, 1e-12);
}

void a_setting_outside_its_range_is_refused(void**) {
  static Arm arm;
  PlantParams negative = bare(), degrees = bare(), nan = bare(), late = bare();
  negative.rotor_inertia[3] = -0.1;
  degrees.initial_q[0] = 45.0;
  nan.payload_com[2] = std::nan("");
  late.delay_cycles = kMaxDelayCycles + 1;
  for (const PlantParams& params : {negative, degrees, nan, late})
    ASSERT_STATUS(arm.load(params), Status::kBadValue);
  assert_false(arm.loaded());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(flange_and_gravity_are_those_of_the_reference),
      cmocka_unit_test(the_mass_matrix_is_that_of_the_reference),
      cmocka_unit_test(a_free_swing_without_friction_keeps_its_energy),
      cmocka_unit_test(halving_the_step_divides_the_error_by_sixteen),
      cmocka_unit_test(a_long_step_is_cut_into_steps_of_at_most_a_millisecond),
      cmocka_unit_test(a_payload_weighs_its_mass_times_its_lever),
      cmocka_unit_test(the_kinetic_energy_is_that_of_links_rotors_and_payload),
      cmocka_unit_test(a_setting_outside_its_range_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
