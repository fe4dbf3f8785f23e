// Tests the rigid-body algorithms against Orocos KDL at seeded states. The tests print the
// differences; the bounds are at least ten times as large.
#include <algorithm>

#include "tests/oracles/kdl.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kStates = 1000;

KdlTool kdl_tool(const Tool& tool) {
  return {tool.mass_kg, {tool.com.x(), tool.com.y(), tool.com.z()}};
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

void gravity_is_that_of_kdl_with_and_without_a_tool(void**) {
  RandomStates state;
  double worst = 0.0;
  for (const Tool& tool : {Tool{}, skew_tool()}) {
    for (int n = 0; n < kStates; ++n) {
      state.next();
      JointVector expected;
      kdl_gravity(state.q.data(), kdl_tool(tool), expected.data());
      worst = std::max(worst, (gravity_at(state.q, tool) - expected).cwiseAbs().maxCoeff());
    }
  }
  print_message("gravity: worst difference %.1e N m\n", worst);
  assert_true(worst < 1e-12);
}

void inverse_dynamics_is_that_of_kdl_with_and_without_a_tool(void**) {
  RandomStates state;
  double worst = 0.0;
  for (const Tool& tool : {Tool{}, skew_tool()}) {
    for (int n = 0; n < kStates; ++n) {
      state.next();
      JointVector expected;
      kdl_inverse_dynamics(state.q.data(), state.dq.data(), state.ddq.data(), kdl_tool(tool),
                           expected.data());
      const JointVector tau = rnea(state.q, state.dq, state.ddq, tool);
      worst = std::max(worst, (tau - expected).cwiseAbs().maxCoeff());
    }
  }
  print_message("inverse dynamics: worst difference %.1e N m\n", worst);
  assert_true(worst < 1e-12);
}

void mass_matrix_and_coriolis_efforts_are_those_of_kdl(void**) {
  RandomStates state;
  const Tool tool = skew_tool();
  double worst = 0.0;
  for (int n = 0; n < kStates; ++n) {
    state.next();
    double m[kDof][kDof];
    JointVector c;
    kdl_mass_matrix(state.q.data(), kdl_tool(tool), m);
    kdl_coriolis(state.q.data(), state.dq.data(), kdl_tool(tool), c.data());
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
      cmocka_unit_test(gravity_is_that_of_kdl_with_and_without_a_tool),
      cmocka_unit_test(inverse_dynamics_is_that_of_kdl_with_and_without_a_tool),
      cmocka_unit_test(mass_matrix_and_coriolis_efforts_are_those_of_kdl),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
