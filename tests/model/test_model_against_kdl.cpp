// Tests the rigid-body algorithms against Orocos KDL at seeded states. The tests print the
// differences; the bounds are at least ten times as large.
#include <algorithm>
#include <vector>

#include "kernel/model/mounting.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kStates = 1000;

/// The tool of ours, on a base that is mounted as given.
struct Mounted {
  Tool tool;
  Vector3 mounting = Vector3::Zero();

  Tool ours() const {
    Tool mounted = tool;
    mounted.gravity = gravity_in_base(mounting);
    return mounted;
  }
  KdlTool kdls() const {
    return {tool.mass_kg,
            {tool.com.x(), tool.com.y(), tool.com.z()},
            {mounting.x(), mounting.y(), mounting.z()}};
  }
};

/// Upright, on a ceiling, on a wall, and at no angle in particular; bare and with a tool.
std::vector<Mounted> mounted_arms() {
  const double half_turn = M_PI;
  std::vector<Mounted> arms;
  for (const Vector3& mounting : {Vector3(0.0, 0.0, 0.0), Vector3(half_turn, 0.0, 0.0),
                                  Vector3(0.0, half_turn / 2, 0.0), Vector3(0.3, -1.1, 2.5)})
    for (const Tool& tool : {Tool{}, skew_tool()}) arms.push_back({tool, mounting});
  return arms;
}

// Proves MOD-1.

void pose_of_the_flange_is_that_of_kdl(void**) {
  RandomStates state;
  double worst = 0.0;
  for (int n = 0; n < kStates; ++n) {
    state.next();
    double p[3], r[3][3];
    kdl_flange(state.q.data(), p, r);
    const Pose flange = tip_pose(state.q, {});
    const Matrix3 rotation = flange.r.toRotationMatrix();
    ASSERT_NEAR(flange.r.norm(), 1.0, 1e-15);
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(flange.p[i] - p[i]));
      for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(rotation(i, j) - r[i][j]));
    }
  }
  print_message("pose: worst difference %.1e\n", worst);
  assert_true(worst < 1e-14);
}

void jacobian_of_the_flange_is_that_of_kdl(void**) {
  RandomStates state;
  double worst = 0.0;
  for (int n = 0; n < kStates; ++n) {
    state.next();
    double expected[6][kDof];
    kdl_jacobian(state.q.data(), expected);
    const Jacobian J = tip_jacobian(state.q, {});
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < kDof; ++j) worst = std::max(worst, std::abs(J(i, j) - expected[i][j]));
    }
  }
  print_message("jacobian: worst difference %.1e\n", worst);
  assert_true(worst < 1e-14);
}

/// The shortest way from the file to the axes of the base; yaw turns nothing.
void gravity_of_any_mounting_is_that_of_kdl(void**) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> angle(-6.3, 6.3);
  for (int n = 0; n < kStates; ++n) {
    Mounted arm;
    arm.mounting = {angle(random), angle(random), angle(random)};
    Vector3 expected;
    kdl_base_gravity(arm.kdls(), expected.data());
    ASSERT_NEAR((arm.ours().gravity - expected).norm(), 0.0, 1e-13);
    ASSERT_NEAR(expected.norm(), kGravity_m_s2, 1e-13);
  }
}

/// `difference(state, arm)` is none at random states of every mounted arm.
template <class Difference>
void assert_equal_however_mounted(const char* what, Difference difference) {
  RandomStates state;
  double worst = 0.0;
  for (const Mounted& arm : mounted_arms()) {
    for (int n = 0; n < kStates; ++n) {
      state.next();
      const JointVector off = difference(state, arm);
      worst = std::max(worst, off.cwiseAbs().maxCoeff());
    }
  }
  print_message("%s: worst difference %.1e N m\n", what, worst);
  assert_true(worst < 1e-12);
}

void gravity_is_that_of_kdl_with_and_without_a_tool_however_mounted(void**) {
  assert_equal_however_mounted("gravity", [](const RandomStates& state, const Mounted& arm) {
    JointVector expected;
    kdl_gravity(state.q.data(), arm.kdls(), expected.data());
    return JointVector(gravity_at(state.q, arm.ours()) - expected);
  });
}

void inverse_dynamics_is_that_of_kdl_with_and_without_a_tool_however_mounted(void**) {
  assert_equal_however_mounted("inverse dynamics", [](const RandomStates& at, const Mounted& arm) {
    JointVector expected;
    kdl_inverse_dynamics(at.q.data(), at.dq.data(), at.ddq.data(), arm.kdls(), expected.data());
    return JointVector(rnea(at.q, at.dq, at.ddq, arm.ours()) - expected);
  });
}

void mass_matrix_and_coriolis_efforts_are_those_of_kdl(void**) {
  RandomStates state;
  const Tool tool = skew_tool();
  const KdlTool kdls = Mounted{tool}.kdls();
  double worst = 0.0;
  for (int n = 0; n < kStates; ++n) {
    state.next();
    double m[kDof][kDof];
    JointVector c;
    kdl_mass_matrix(state.q.data(), kdls, m);
    kdl_coriolis(state.q.data(), state.dq.data(), kdls, c.data());
    const JointMatrix ours = mass_matrix(state.q, tool);
    for (int i = 0; i < kDof; ++i) {
      for (int j = 0; j < kDof; ++j) worst = std::max(worst, std::abs(ours(i, j) - m[i][j]));
    }
    const JointVector bias = rnea(state.q, state.dq, JointVector::Zero(), tool);
    worst = std::max(worst, (bias - gravity_at(state.q, tool) - c).cwiseAbs().maxCoeff());
  }
  print_message("M and C dq: worst difference %.1e\n", worst);
  assert_true(worst < 1e-12);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(pose_of_the_flange_is_that_of_kdl),
      cmocka_unit_test(jacobian_of_the_flange_is_that_of_kdl),
      cmocka_unit_test(gravity_of_any_mounting_is_that_of_kdl),
      cmocka_unit_test(gravity_is_that_of_kdl_with_and_without_a_tool_however_mounted),
      cmocka_unit_test(inverse_dynamics_is_that_of_kdl_with_and_without_a_tool_however_mounted),
      cmocka_unit_test(mass_matrix_and_coriolis_efforts_are_those_of_kdl),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
