// PD with gravity compensation, with numbers that can be checked by hand: gains 100 and 10,
// errors 1.
#include "kernel/control/pd_gravity.hpp"

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const JointVector zero = JointVector::Zero(), ones = JointVector::Ones();

/// The law wired to values that a test sets.
struct Bench {
  JointVector q_d = zero, q = zero, dq = zero, g = zero;
  PdGravity pd;
  Bench() {
    pd.params.kp = 100.0 * ones;
    pd.params.kd = 10.0 * ones;
    pd.q_d.source = &q_d;
    pd.q.source = &q;
    pd.dq.source = &dq;
    pd.g.source = &g;
  }
  void torque_is(const JointVector& expected) {
    ASSERT_OK(pd.step(1e-3));
    ASSERT_NEAR((pd.tau.value - expected).cwiseAbs().maxCoeff(), 0.0, 1e-12);
  }
};

// Proves LAW-1.

void at_rest_on_the_reference_the_torque_is_gravity(void**) {
  Bench bench;
  bench.q_d = bench.q = ones;
  bench.g = 3.0 * ones;
  bench.torque_is(3.0 * ones);
}

void the_torque_points_from_the_robot_to_the_reference(void**) {
  Bench bench;
  bench.q_d = ones;
  bench.torque_is(100.0 * ones);
  bench.q = 2.0 * ones;
  bench.torque_is(-100.0 * ones);
}

void damping_opposes_the_velocity(void**) {
  Bench bench;
  bench.dq = ones;
  bench.torque_is(-10.0 * ones);
}

void every_joint_has_its_own_gains(void**) {
  Bench bench;
  for (int i = 0; i < kDof; ++i) {
    bench.pd.params.kp[i] = i;
    bench.pd.params.kd[i] = 2 * i;
  }
  bench.q_d = 3.0 * ones;
  bench.dq = ones;
  bench.torque_is(JointVector::LinSpaced(0.0, kDof - 1.0));  // 3 i - 2 i
}

void without_a_wire_to_g_there_is_no_gravity(void**) {
  Bench bench;
  bench.g = 3.0 * ones;
  bench.pd.g = {};
  bench.torque_is(zero);
}

void starting_on_the_measured_position_is_bumpless(void**) {
  Bench bench;
  bench.q_d = bench.q = ones;
  bench.g = 3.0 * ones;
  ASSERT_OK(bench.pd.start());
  assert_true(bench.pd.tau.value == bench.g);
}

void a_number_that_is_not_finite_never_becomes_a_torque(void**) {
  for (JointVector Bench::*input : {&Bench::q_d, &Bench::q, &Bench::dq, &Bench::g})
    for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
      Bench bench;
      (bench.*input)[kDof - 1] = bad;
      ASSERT_STATUS(bench.pd.step(1e-3), Status::kCommandNotFinite);
    }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_rest_on_the_reference_the_torque_is_gravity),
      cmocka_unit_test(the_torque_points_from_the_robot_to_the_reference),
      cmocka_unit_test(damping_opposes_the_velocity),
      cmocka_unit_test(every_joint_has_its_own_gains),
      cmocka_unit_test(without_a_wire_to_g_there_is_no_gravity),
      cmocka_unit_test(starting_on_the_measured_position_is_bumpless),
      cmocka_unit_test(a_number_that_is_not_finite_never_becomes_a_torque),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
