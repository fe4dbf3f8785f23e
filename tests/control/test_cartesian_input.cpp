// Inputs of Cartesian pose control that are not finite: every number of every input, one at a time.
#include "tests/control/pose_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const JointVector zero = JointVector::Zero();

// Proves CP-9.

/// Sets number `index` of all inputs to `bad`; false if there is no such number.
bool poison(PoseBench& bench, int index, double bad, Status& expected) {
  double* numbers[] = {bench.x.p.data(), bench.x.r.coeffs().data(), bench.J.data(),
                       bench.q.data(),   bench.x_d.p.data(),        bench.x_d.r.coeffs().data(),
                       bench.v_d.data(), bench.q_posture.data()};
  const int counts[] = {3, 4, 6 * kDof, kDof, 3, 4, 6, kDof};
  for (int i = 0; i < 8; ++i) {
    expected = i < 4 ? Status::kStateNotFinite : Status::kReferenceFault;
    if (index < counts[i]) {
      numbers[i][index] = bad;
      return true;
    }
    index -= counts[i];
  }
  return false;
}

void no_number_that_is_not_finite_comes_out(void**) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (int index = 0;; ++index) {
      PoseBench bench;
      bench.law.q_posture.source = &bench.q_posture;
      ASSERT_OK(bench.start(regular(7)));
      bench.x_d.p += Vector3(0.1, 0.0, 0.0);
      ASSERT_OK(bench.run(0.02));
      bench.measure();
      const JointVector held = bench.q_c();
      Status expected = Status::kOk;
      if (!poison(bench, index, bad, expected)) break;
      ASSERT_STATUS(bench.law.step(bench.dt_s), expected);
      assert_true(bench.q_c() == held && bench.dq_c() == zero);
    }
}

void numbers_too_large_for_the_arithmetic_are_refused(void**) {
  PoseBench bench;
  ASSERT_OK(bench.start(regular(8)));
  bench.J *= 1e200;
  ASSERT_STATUS(bench.law.step(bench.dt_s), Status::kCommandNotFinite);
  assert_true(bench.q_c() == bench.q && bench.dq_c() == zero);
  bench.measure();
  bench.x_d.r.coeffs().setZero();
  ASSERT_STATUS(bench.law.step(bench.dt_s), Status::kReferenceFault);
  bench.q[0] = std::nan("");
  ASSERT_STATUS(bench.law.start(bench.dt_s), Status::kStateNotFinite);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_number_that_is_not_finite_comes_out),
      cmocka_unit_test(numbers_too_large_for_the_arithmetic_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
