// Tests that three models of each robot agree. Each was typed separately from the published tables:
// the kernel's, the plant's MJCF and that of Orocos KDL. The states are random with a fixed seed,
// without friction, rotor inertia and payload.
#include <algorithm>
#include <cmath>
#include <random>

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/model/gravity.hpp"
#include "kernel/model/inverse_dynamics.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kStates = 1000;
constexpr std::uint64_t kSeed = 20260119;
constexpr double kTolerance = 1e-9;  // SI units, of each number

// Measured (x86-64, MuJoCo 2.2.2, KDL 1.5.1), FER: pose and Jacobian 1.4e-15, gravity 4.3e-14 N m,
// Coriolis 3.9e-14 N m, mass matrix 3.0e-14 kg m^2. UR10: 1.5e-15, 1.6e-13, 9.9e-14, 5.3e-14.

struct State {
  JointVector q, dq;  // rad, rad/s
};

/// A model's results at one state: pose and Jacobian of the flange in the base frame, g(q), C(q,
/// dq) dq and M(q).
struct Model {
  double p[3], R[3][3], J[6][kDof], g[kDof], c[kDof], M[kDof][kDof];
};

/// Joints anywhere in +-3.8 rad, more than a full turn; speeds up to 3 rad/s.
State random_state(std::mt19937_64& random) {
  const auto in = [&random](double bound) {
    return bound * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
  };
  State state;
  for (double& q : state.q) q = in(3.8);
  for (double& dq : state.dq) dq = in(3.0);
  return state;
}

template <class Matrix>
void put_by_rows(const Matrix& from, double* to) {
  for (int i = 0; i < from.rows(); ++i)
    for (int j = 0; j < from.cols(); ++j) *to++ = from(i, j);
}

/// Computes M column by column, as the torque of a unit acceleration at rest: the kernel has no M
/// of its own, but M is symmetric.
Model by_kernel(const State& state) {
  const Tool no_tool;
  const JointVector zero = JointVector::Zero();
  const JointTrig<Robot> trig = joint_trig<Robot>(state.q);
  const JointVector g = gravity<Robot>(trig, no_tool);
  Jacobian J;
  const Pose x = forward_kinematics<Robot>(trig, no_tool.tip, J);
  Model model;
  put_by_rows(x.p, model.p);
  put_by_rows(x.r.toRotationMatrix(), model.R[0]);
  put_by_rows(J, model.J[0]);
  put_by_rows(g, model.g);
  put_by_rows(inverse_dynamics<Robot>(trig, state.dq, zero, no_tool) - g, model.c);
  for (int i = 0; i < kDof; ++i) {
    const JointVector unit = JointVector::Unit(i);
    put_by_rows(inverse_dynamics<Robot>(trig, zero, unit, no_tool) - g, model.M[i]);
  }
  return model;
}

Model by_mujoco(const State& state) {
  Model model;
  mujoco_flange(state.q.data(), model.p, model.R);
  mujoco_jacobian(state.q.data(), model.J);
  mujoco_gravity(state.q.data(), model.g);
  mujoco_coriolis(state.q.data(), state.dq.data(), model.c);
  mujoco_mass_matrix(state.q.data(), model.M);
  return model;
}

Model by_kdl(const State& state) {
  const KdlTool no_tool;
  Model model;
  kdl_flange(state.q.data(), model.p, model.R);
  kdl_jacobian(state.q.data(), model.J);
  kdl_gravity(state.q.data(), no_tool, model.g);
  kdl_coriolis(state.q.data(), state.dq.data(), no_tool, model.c);
  kdl_mass_matrix(state.q.data(), no_tool, model.M);
  return model;
}

/// The largest difference between two models in one quantity over all states; NaN if any is NaN.
template <class Array>
double worst_difference(Model (*model_a)(const State&), Model (*model_b)(const State&),
                        Array Model::*quantity) {
  std::mt19937_64 random(kSeed);
  double worst = 0.0;
  for (int k = 0; k < kStates; ++k) {
    const State state = random_state(random);
    const Model a = model_a(state), b = model_b(state);
    const auto* x = reinterpret_cast<const double*>(&(a.*quantity));
    const auto* y = reinterpret_cast<const double*>(&(b.*quantity));
    for (std::size_t i = 0; i < sizeof(Array) / sizeof(double); ++i) {
      if (std::isnan(x[i] - y[i])) return x[i] - y[i];
      worst = std::max(worst, std::abs(x[i] - y[i]));
    }
  }
  return worst;
}

template <class Array>
void assert_the_three_agree(Array Model::*quantity) {
  const double mujoco = worst_difference(by_kernel, by_mujoco, quantity);
  const double kdl = worst_difference(by_kernel, by_kdl, quantity);
  const double oracles = worst_difference(by_mujoco, by_kdl, quantity);
  print_message("largest difference from MuJoCo %.2g, from KDL %.2g\n", mujoco, kdl);
  ASSERT_NEAR(mujoco, 0.0, kTolerance);
  ASSERT_NEAR(kdl, 0.0, kTolerance);
  ASSERT_NEAR(oracles, 0.0, kTolerance);
}

// Proves MOD-1.

void three_codes_agree_on_the_pose_of_the_flange(void**) {
  assert_the_three_agree(&Model::p);
  assert_the_three_agree(&Model::R);
}

void three_codes_agree_on_the_jacobian(void**) {
  assert_the_three_agree(&Model::J);
}

void three_codes_agree_on_gravity(void**) {
  assert_the_three_agree(&Model::g);
}

void three_codes_agree_on_coriolis(void**) {
  assert_the_three_agree(&Model::c);
}

void three_codes_agree_on_the_mass_matrix(void**) {
  assert_the_three_agree(&Model::M);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(three_codes_agree_on_the_pose_of_the_flange),
      cmocka_unit_test(three_codes_agree_on_the_jacobian),
      cmocka_unit_test(three_codes_agree_on_gravity),
      cmocka_unit_test(three_codes_agree_on_coriolis),
      cmocka_unit_test(three_codes_agree_on_the_mass_matrix),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
