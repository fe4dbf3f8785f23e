// The robot_model block, and the published numbers of the FER.
#include "kernel/model/robot_model.hpp"

#include <limits>

#include "tests/model_cases.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Five configurations computed with KDL 1.5.1, RBDL 3.3.1, MuJoCo 2.2.2 and DART 6.12.1, which
// agree to 2e-14; printed to nine decimals.
struct Published {
  double q[kDof], flange[3], g[kDof];
};
// clang-format off
constexpr Published kPublished[] = {
    {{0, 0, 0, 0, 0, 0, 0},
     {0.088000000, 0, 0.926000000},
     {0, -3.434431908, 0, -3.257223812, 0, 1.694216799, 0}},
    {{0, -kPi / 4, 0, -3 * kPi / 4, 0, kPi / 2, kPi / 4},
     {0.306890567, 0, 0.590282052},
     {0, -1.771375549, -0.644000320, 18.573590391, 0.633846185, 1.693684730, 0}},
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
// clang-format on

// Proves MOD-1.

void flange_and_gravity_are_the_published_ones(void**) {
  for (const Published& row : kPublished) {
    const JointVector q(row.q);
    const Pose flange = tip_pose(q, {});
    const JointVector g = gravity_at(q, {});
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(flange.p[i], row.flange[i], 1e-9);
    for (int i = 0; i < kDof; ++i) ASSERT_NEAR(g[i], row.g[i], 1e-9);
  }
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
  ASSERT_NEAR(bench.model.x.value.p.x(), 0.088, 1e-15);
  ASSERT_NEAR(bench.model.x.value.p.z(), 0.333 + 0.316 + 0.384 - 0.107, 1e-15);
  ASSERT_NEAR(bench.model.g.value[1], -3.434431908, 1e-9);
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
    bench.q[0] += 0.01;
    ASSERT_OK(bench.model.step(1e-3));
  }
  ASSERT_OK(bench.model.start());
  assert_true(bench.model.x.value.r.w() > 0.0);
}

void an_input_that_is_not_finite_is_reported(void**) {
  Bench bench;
  ASSERT_OK(bench.model.start());
  for (int i = 0; i < kDof; ++i) {
    for (const double bad : {kNan, 2.0 * kSinCosMax_rad}) {
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
      cmocka_unit_test(start_leaves_the_outputs_of_the_present_inputs),
      cmocka_unit_test(without_a_tool_the_tip_is_the_bare_flange),
      cmocka_unit_test(the_quaternion_never_changes_its_sign_by_a_jump),
      cmocka_unit_test(starting_again_takes_the_quaternion_of_positive_w),
      cmocka_unit_test(an_input_that_is_not_finite_is_reported),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
