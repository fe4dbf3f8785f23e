// The arm of the plant: reference numbers from other codes, and the laws of mechanics.
#include <Eigen/Geometry>
#include <cmath>

#include "sim_plant/arm.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/testing.hpp"

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
  /// J, of the links alone.
  double kinetic_energy(const JointVector& dq) const {
    return 0.5 * dq.dot(Rows<kDof, kDof>(M[0]) * dq);
  }
};

/// Unlike the default: no friction, no rotors; a pose in which every joint but the first feels
/// gravity.
PlantParams bare() {
  PlantParams params;
  params.initial_q << 1.2, -0.4, 0.9, -2.2, -0.7, 1.9, 0.4;
  params.friction = 0.0;
  params.rotor_inertia.setZero();
  return params;
}

JointVector joints(const double (&values)[kDof]) {
  return Eigen::Map<const JointVector>(values);
}

// What KDL, RBDL, DART and a computation in long double say of the inertias of Gaz et al., RA-L
// 2019; they agree to 1.4e-14 N m.
constexpr double kPi = 3.14159265358979323846;
struct Reference {
  double q[kDof], p[3], g[kDof];  // rad, m, N m
} constexpr kReference[] = {
    {{0, -kPi / 4, 0, -3 * kPi / 4, 0, kPi / 2, kPi / 4},
     {0.306890567, 0, 0.590282052},
     {0, -1.771375549, -0.644000320, 18.573590391, 0.633846185, 1.693684730, 0}},
    {{0, 0, 0, 0, 0, 0, 0},
     {0.088, 0, 0.926},
     {0, -3.434431908, 0, -3.257223812, 0, 1.694216799, 0}},
    {{0, 1.2, 0, -0.8, 0, 2, 0.785},
     {0.795921192, 0, 0.178828478},
     {0, -49.911774899, 0.848886279, 19.103078580, 0.576381989, 1.693697451, 0}},
    {{1.2, -0.4, 0.9, -2.2, -0.7, 1.9, 0.4},
     {-0.229961942, 0.417649531, 0.508307849},
     {0, -4.417651148, -7.653185171, 18.126851123, 0.364091699, 0.849760292, 0.066090034}},
    {{-0.5, 0.3, -1.1, -2.8, 1.3, 0.6, -1},
     {0.113909260, -0.242127928, 0.272754829},
     {0, -13.885631930, -4.286601610, 8.162908066, 0.412329069, -1.522871901, -0.064970161}},
};

// Proves MOD-1.

void flange_and_gravity_are_those_of_the_reference(void**) {
  for (const Reference& row : kReference) {
    const Model model(joints(row.q));
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(model.p[i], row.p[i], 1e-9);
    for (int i = 0; i < kDof; ++i) ASSERT_NEAR(model.g[i], row.g[i], 1e-9);
  }
}

void the_mass_matrix_at_the_ready_pose_is_that_of_the_reference(void**) {
  const JointVector diagonal = joints(
      {0.461178322, 1.444958892, 0.878925238, 0.788735575, 0.027854616, 0.032556770, 0.004909652});
  const Model model(joints(kReference[0].q));
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(model.M[i][i], diagonal[i], 1e-9);
}

void the_coriolis_torque_is_that_of_the_reference(void**) {
  const JointVector c = joints({0.0481, -0.9483, -0.3447, -0.0718, 0.0105, -0.0355, 0.0044});
  const Model model(joints({0.3, -0.6, 0.2, -2.1, -0.4, 1.9, 0.7}),
                    joints({0.5, -0.4, 0.3, 0.6, -0.7, 0.2, 1.0}));
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(model.c[i], c[i], 5e-5);
}

// Proves SIM-1.

void a_free_swing_without_friction_keeps_its_energy(void**) {
  static Arm arm;
  ASSERT_OK(arm.load(bare()));
  const double before = arm.energy();
  for (int k = 0; k < 1000; ++k) {
    arm.step(JointVector::Zero(), 1e-3);
    ASSERT_NEAR(arm.energy(), before, 1e-4);  // of 45 J; measured 6.6e-5, at 0.25 ms 2.4e-7
  }
}

void friction_only_ever_takes_energy(void**) {
  static Arm arm;
  PlantParams params = bare();
  params.friction = 1.0;
  ASSERT_OK(arm.load(params));
  double before = arm.energy();
  for (int k = 0; k < 1000; ++k) {
    arm.step(JointVector::Zero(), 1e-3);
    assert_true(arm.energy() < before);
    before = arm.energy();
  }
}

/// Power taken by the friction of Gaz et al., RA-L 2019, table I, W.
double friction_power(const JointVector& dq) {
  const JointVector a = joints({0.54615, 0.87224, 0.64068, 1.2794, 0.83904, 0.30301, 0.56489});
  const JointVector b = joints({5.1181, 9.0657, 10.136, 5.5903, 8.3469, 17.133, 10.336});
  const JointVector c =
      joints({0.039533, 0.025882, -0.04607, 0.036194, 0.026226, -0.021047, 0.0035526});
  double power = 0.0;
  for (int i = 0; i < kDof; ++i) {
    const double at_rest = a[i] / (1.0 + std::exp(-b[i] * c[i]));
    power += dq[i] * (a[i] / (1.0 + std::exp(-b[i] * (dq[i] + c[i]))) - at_rest);
  }
  return power;
}

void the_energy_lost_is_the_work_of_the_scaled_identified_friction(void**) {
  static Arm arm;
  PlantParams params = bare();
  params.friction = 2.0;
  ASSERT_OK(arm.load(params));
  const double before = arm.energy(), dt_s = 1e-4;
  double work = 0.0;  // J, by the trapezoidal rule
  for (int k = 0; k < 5000; ++k) {
    work += dt_s * friction_power(arm.dq());
    arm.step(JointVector::Zero(), dt_s);
    work += dt_s * friction_power(arm.dq());
  }
  assert_true(work > 1.0);
  ASSERT_NEAR(before - arm.energy(), work, 1e-5);
}

/// Where a fall of 64 ms with friction ends, integrated in steps of dt_s.
JointVector fall(double dt_s) {
  static Arm arm;
  PlantParams params = bare();
  params.friction = 1.0;
  ASSERT_OK(arm.load(params));
  for (int k = 0; k < std::lround(0.064 / dt_s); ++k) arm.step(JointVector::Zero(), dt_s);
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
  params.rotor_inertia = joints({0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05});
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
      cmocka_unit_test(the_mass_matrix_at_the_ready_pose_is_that_of_the_reference),
      cmocka_unit_test(the_coriolis_torque_is_that_of_the_reference),
      cmocka_unit_test(a_free_swing_without_friction_keeps_its_energy),
      cmocka_unit_test(friction_only_ever_takes_energy),
      cmocka_unit_test(the_energy_lost_is_the_work_of_the_scaled_identified_friction),
      cmocka_unit_test(halving_the_step_divides_the_error_by_sixteen),
      cmocka_unit_test(a_long_step_is_cut_into_steps_of_at_most_a_millisecond),
      cmocka_unit_test(a_payload_weighs_its_mass_times_its_lever),
      cmocka_unit_test(the_kinetic_energy_is_that_of_links_rotors_and_payload),
      cmocka_unit_test(a_setting_outside_its_range_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
