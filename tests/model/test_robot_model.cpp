// Tests the robot_model block, and the robots against their published numbers.
#include "kernel/model/robot_model.hpp"

#include <limits>

#include "tests/oracles/published.hpp"
#include "tests/support/middle_of_range.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Proves MOD-1.

void flange_and_gravity_are_the_published_ones(void**) {
  for (const auto& row : published().states) {
    const JointVector q(row.q);
    const Pose flange = tip_pose(q, {});
    const JointVector g = gravity_at(q, {});
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(flange.p[i], row.flange[i], 1e-9);
    for (int i = 0; i < kDof; ++i) ASSERT_NEAR(g[i], row.g[i], 1e-9);
  }
}

void the_orientation_of_the_flange_is_the_published_one(void**) {
  const auto& row = published().orientation;
  const Matrix3 r = tip_pose(JointVector(row.q), {}).r.toRotationMatrix();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) ASSERT_NEAR(r(i, j), row.r[i][j], 1e-9);
}

/// One block, bound to values the test owns.
struct Bench {
  JointVector q = JointVector::Zero(), dq = JointVector::Zero();
  Tool tool = skew_tool();
  RobotModel model;
  Bench() {
    model.q.source = &q;
    model.dq.source = &dq;
    model.tool.source = &tool;
  }
};

void start_leaves_the_outputs_of_the_present_inputs(void**) {
  Bench bench;
  RandomStates state;
  state.next();
  bench.q = state.q;
  bench.dq = state.dq;
  ASSERT_OK(bench.model.start());
  const Pose x = tip_pose(state.q, bench.tool.tip);
  const Jacobian J = tip_jacobian(state.q, bench.tool.tip);
  assert_true(bench.model.x.value.p == x.p);
  ASSERT_NEAR(std::abs(bench.model.x.value.r.dot(x.r)), 1.0, 1e-15);
  assert_true(bench.model.x.value.r.w() >= 0.0);
  assert_true(bench.model.J.value == J);
  assert_true((bench.model.v.value - J * state.dq).cwiseAbs().maxCoeff() < 1e-15);
  assert_true(bench.model.g.value == gravity_at(state.q, bench.tool));
}

void without_a_tool_the_tip_is_the_bare_flange(void**) {
  Bench bench;
  bench.model.tool = {};
  ASSERT_OK(bench.model.start());
  const auto& zero = published().states[0];  // the published state of q = 0
  for (int i = 0; i < 3; ++i) ASSERT_NEAR(bench.model.x.value.p[i], zero.flange[i], 1e-9);
  for (int i = 0; i < kDof; ++i) ASSERT_NEAR(bench.model.g.value[i], zero.g[i], 1e-9);
}

void the_quaternion_never_changes_its_sign_by_a_jump(void**) {
  Bench bench;
  ASSERT_OK(bench.model.start());
  for (int i = 0; i < 4000; ++i) {  // several full turns about every axis
    for (int j = 0; j < kDof; ++j) bench.q[j] += 0.001 * (j + 1);
    const Eigen::Quaterniond before = bench.model.x.value.r;
    ASSERT_OK(bench.model.step(1e-3));
    assert_true(bench.model.x.value.r.dot(before) > 0.999);
  }
}

void starting_again_takes_the_quaternion_of_positive_w(void**) {
  Bench bench;
  ASSERT_OK(bench.model.start());
  while (bench.model.x.value.r.w() > -0.1) {
    bench.q[kFirstRevolute] += 0.01;
    ASSERT_OK(bench.model.step(1e-3));
  }
  ASSERT_OK(bench.model.start());
  assert_true(bench.model.x.value.r.w() > 0.0);
}

void an_input_that_is_not_finite_is_reported(void**) {
  Bench bench;
  ASSERT_OK(bench.model.start());
  for (int i = 0; i < kDof; ++i) {
    for (const double bad : {kNan, is_prismatic<Robot>(i) ? kInfinity : 2.0 * kSinCosMax_rad}) {
      bench.q[i] = bad;
      ASSERT_STATUS(bench.model.step(1e-3), Status::kStateNotFinite);
      ASSERT_STATUS(bench.model.start(), Status::kStateNotFinite);
      bench.q[i] = 0.0;
    }
    bench.dq[i] = kNan;
    ASSERT_STATUS(bench.model.step(1e-3), Status::kStateNotFinite);
    bench.dq[i] = 0.0;
    ASSERT_OK(bench.model.step(1e-3));
  }
  bench.tool.mass_kg = kNan;
  ASSERT_STATUS(bench.model.step(1e-3), Status::kStateNotFinite);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(flange_and_gravity_are_the_published_ones),
      cmocka_unit_test(the_orientation_of_the_flange_is_the_published_one),
      cmocka_unit_test(start_leaves_the_outputs_of_the_present_inputs),
      cmocka_unit_test(without_a_tool_the_tip_is_the_bare_flange),
      cmocka_unit_test(the_quaternion_never_changes_its_sign_by_a_jump),
      cmocka_unit_test(starting_again_takes_the_quaternion_of_positive_w),
      cmocka_unit_test(an_input_that_is_not_finite_is_reported),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
