// Tests the parts of the plant that only the FER has: identified friction against the published
// model, and the Coriolis torque against a published value.
#include <cmath>

#include "sim_plant/arm/arm.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

JointVector joints(const double (&values)[kDof]) {
  return Eigen::Map<const JointVector>(values);
}

/// An arm without rotors, away from the ready pose, its friction scaled.
PlantParams rubbing(double friction) {
  PlantParams params;
  params.initial_q << 1.2, -0.4, 0.9, -2.2, -0.7, 1.9, 0.4;
  params.friction = friction;
  params.rotor_inertia.setZero();
  return params;
}

// Proves MOD-1.

void the_coriolis_torque_is_that_of_the_reference(void**) {
  const JointVector c = joints({0.0481, -0.9483, -0.3447, -0.0718, 0.0105, -0.0355, 0.0044});
  double found[kDof];
  mujoco_coriolis(joints({0.3, -0.6, 0.2, -2.1, -0.4, 1.9, 0.7}).data(),
                  joints({0.5, -0.4, 0.3, 0.6, -0.7, 0.2, 1.0}).data(), found);
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(found[i], c[i], 5e-5);
}

// Proves SIM-1.

void friction_only_ever_takes_energy(void**) {
  static Arm arm;
  ASSERT_OK(arm.load(rubbing(1.0)));
  double before = arm.energy();
  for (int k = 0; k < 1000; ++k) {
    arm.step(JointVector::Zero(), 1e-3);
    assert_true(arm.energy() < before);
    before = arm.energy();
  }
}

/// Power dissipated by the friction model of Gaz et al., RA-L 2019, table I, W.
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
  ASSERT_OK(arm.load(rubbing(2.0)));
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

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_coriolis_torque_is_that_of_the_reference),
      cmocka_unit_test(friction_only_ever_takes_energy),
      cmocka_unit_test(the_energy_lost_is_the_work_of_the_scaled_identified_friction),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
