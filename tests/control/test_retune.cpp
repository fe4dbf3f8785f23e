// Tests that laws go on without a step when their parameters change.
#include <algorithm>

#include "kernel/control/pd_gravity.hpp"
#include "kernel/control/wrench_front_end.hpp"
#include "tests/control/admittance_bench.hpp"
#include "tests/control/pose_bench.hpp"

namespace tactus {
namespace {

const JointVector zeros = JointVector::Zero(), ones = JointVector::Ones();

/// Returns a whole number from 0 to `count` - 1, or a number from `lowest` to `highest`.
int below(RandomVectors& random, int count) {
  return std::min(count - 1, static_cast<int>(0.5 * (1.0 + random.unit()) * count));
}
double uniform(RandomVectors& random, double lowest, double highest) {
  return lowest + 0.5 * (1.0 + random.unit()) * (highest - lowest);
}

/// PD control wired to values that a test sets, with limits of 100 N m and 1000 N m/s.
struct PdBench {
  JointVector q_d = zeros, q = zeros, dq = zeros;
  PdGravity pd;
  JointLimits limits;
  PdBench() {
    pd.params = {100.0 * ones, 10.0 * ones};
    limits.tau_max.setConstant(100.0);
    limits.dtau_max.setConstant(1000.0);
    pd.q_d.source = &q_d;
    pd.q.source = &q;
    pd.dq.source = &dq;
    ASSERT_OK(pd.start());
  }
};

// Proves PAR-4.

/// Random gains at random moments, also while others fade. The torque changes from one period to
/// the next as the law of the present gains does, plus the fade: at most half of 1000 N m/s.
void the_torque_of_pd_goes_on(void**) {
  PdBench b;
  RandomVectors random;
  PdGravity::Params now = b.pd.params;
  for (int k = 0; k < 50000; ++k) {
    const JointVector tau = b.pd.tau.value, q_d = b.q_d, dq = b.dq;
    if (below(random, 200) == 0) {
      PdGravity::Params next = {uniform(random, 0.0, 300.0) * ones,
                                uniform(random, 0.1, 30.0) * ones};
      if (b.pd.judge_change(next, b.limits).status == Status::kOk)
        b.pd.retune(now = next, b.limits);
    }
    b.q_d = 0.3 * std::sin(2e-3 * k) * ones;
    b.dq = 0.2 * std::cos(3e-3 * k) * ones;
    ASSERT_OK(b.pd.step(1e-3));
    const JointVector own = now.kp.cwiseProduct(b.q_d - q_d) - now.kd.cwiseProduct(b.dq - dq);
    assert_true((b.pd.tau.value - tau - own).cwiseAbs().maxCoeff() <= 0.5 + 1e-9);
  }
}

void what_differs_in_pd_is_gone_in_the_time_that_is_stated(void**) {
  PdBench b;
  b.q_d.setConstant(0.2);
  ASSERT_OK(b.pd.step(1e-3));
  b.pd.retune({150.0 * ones, 10.0 * ones}, b.limits);
  for (int k = 0; k < 499; ++k) ASSERT_OK(b.pd.step(1e-3));
  assert_true(b.pd.tau.value[0] < 30.0);
  for (int k = 0; k < 2; ++k) ASSERT_OK(b.pd.step(1e-3));
  assert_true(b.pd.tau.value[0] == 150.0 * 0.2);
}

/// A hold may end while a difference fades.
void a_law_that_resumes_keeps_what_is_left(void**) {
  PdBench b;
  b.q_d.setConstant(0.2);
  ASSERT_OK(b.pd.step(1e-3));
  b.pd.retune({150.0 * ones, 10.0 * ones}, b.limits);
  for (int k = 0; k < 100; ++k) ASSERT_OK(b.pd.step(1e-3));
  const double before = b.pd.tau.value[0];
  ASSERT_OK(b.pd.resume());
  ASSERT_NEAR(b.pd.tau.value[0], before, 1e-12);
  ASSERT_OK(b.pd.start());
  ASSERT_NEAR(b.pd.tau.value[0], 30.0, 1e-12);
}

/// The limit is 100 N m. What asks for more is taken only where the law already asks for more.
void pd_refuses_gains_that_ask_for_more_torque_than_there_is(void**) {
  PdBench b;
  b.q_d.setConstant(0.5);
  ASSERT_OK(b.pd.step(1e-3));
  ASSERT_OK(b.pd.judge_change({199.0 * ones, 10.0 * ones}, b.limits).status);
  JointVector stiff = 199.0 * ones;
  stiff[3] = 201.0;
  const Verdict verdict = b.pd.judge_change({stiff, 10.0 * ones}, b.limits);
  ASSERT_STATUS(verdict.status, Status::kEffortLimit);
  assert_true(verdict.axis == 3 && verdict.value == 100.5 && verdict.limit == 100.0);
  b.q_d.setConstant(2.0);  // 200 N m by the present gains
  ASSERT_OK(b.pd.step(1e-3));
  ASSERT_OK(b.pd.judge_change({99.0 * ones, 10.0 * ones}, b.limits).status);
  ASSERT_STATUS(b.pd.judge_change({101.0 * ones, 10.0 * ones}, b.limits).status,
                Status::kEffortLimit);
}

/// Compares with a twin that keeps its parameters: without the fade the velocities would part by
/// the difference of spring and damper times a period.
void the_force_on_an_admittances_mass_goes_on(void**) {
  constexpr double kShort_s = 1e-5;
  RandomVectors random;
  for (int trial = 0; trial < 100; ++trial) {
    AdmittanceBench b;
    ASSERT_OK(b.ac.start());
    b.h.head<3>() = Vector3(uniform(random, 5.0, 20.0), uniform(random, 5.0, 20.0), 5.0);
    b.run(uniform(random, 0.02, 0.2));
    Admittance twin = b.ac;
    Admittance::Params next = b.ac.params;
    next.stiffness = uniform(random, 30.0, 1000.0) * kOnes;
    next.damping = uniform(random, 5.0, 400.0) * kOnes;
    const Vector3 x = b.moved(), v = b.ac.v_c.value.head<3>();
    const Matrix3 to_axes = b.x_d.r.toRotationMatrix().transpose();
    b.ac.retune(next, JointLimits());
    ASSERT_OK(b.ac.step(kShort_s));
    ASSERT_OK(twin.step(kShort_s));
    const Vector3 apart = to_axes * (b.ac.v_c.value - twin.v_c.value).head<3>();
    const Vector3 difference =
        (next.stiffness[0] - 100.0) * (to_axes * x) + (next.damping[0] - 40.0) * (to_axes * v);
    for (int i = 0; i < 3; ++i)
      assert_true(std::abs(apart[i]) <=
                  1e-2 * kShort_s * std::abs(difference[i]) + 1e-9 * kShort_s);
    // Twenty times its slowest time constant, of an overdamped axis or of an underdamped one.
    b.run(0.5 + 20.0 * (next.damping[0] / next.stiffness[0] + 2.0 / next.damping[0]));
    ASSERT_NEAR((b.moved() - b.h.head<3>() / next.stiffness[0]).norm(), 0.0, 1e-6);
  }
}

/// The extremes of every range, in any combination, at any moment: the displacement moves no faster
/// than its velocity limit, and the velocity stays within it.
void an_admittance_with_the_extremes_of_its_parameters_keeps_its_bounds(void**) {
  constexpr double kMass[] = {1e-4, 1.0, 1e4}, kGain[] = {0.0, 50.0, 1e6};
  AdmittanceBench b;
  b.ac.params.max_displacement = 0.1;
  b.ac.params.max_velocity = 0.25;
  ASSERT_OK(b.ac.start());
  RandomVectors random;
  for (int k = 0; k < 100000; ++k) {
    b.h.head<3>() = 50.0 * Vector3(std::sin(0.01 * k), std::cos(0.02 * k), 1.0);
    const Vector3 before = b.moved();
    if (below(random, 50) == 0) {
      Admittance::Params next = b.ac.params;
      for (int i = 0; i < 3; ++i) {
        next.mass[i] = kMass[below(random, 3)];
        next.damping[i] = kGain[below(random, 3)];
        next.stiffness[i] = kGain[below(random, 3)];
      }
      // A spring without damper may not turn through more than its functions take.
      for (int i = 0; i < 3; ++i)
        if (next.damping[i] == 0.0) next.mass[i] = std::max(next.mass[i], 1.0);
      b.ac.retune(next, JointLimits());
    }
    ASSERT_OK(b.ac.step(1e-3));
    const Matrix3 to_axes = b.x_d.r.toRotationMatrix().transpose();
    assert_true((to_axes * (b.moved() - before)).cwiseAbs().maxCoeff() <= 0.25e-3 * (1 + 1e-9));
    assert_true((to_axes * b.moved()).cwiseAbs().maxCoeff() <= 0.1 * (1 + 1e-9));
    assert_true((to_axes * b.ac.v_c.value.head<3>()).cwiseAbs().maxCoeff() <= 0.25 * (1 + 1e-9));
  }
}

void the_wrench_goes_on_when_the_dead_band_changes(void**) {
  Vector6 ft = Vector6::Zero();
  Pose x;
  Tool tool;
  WrenchFrontEnd front;
  front.params.max_force = 300.0;
  front.params.max_moment = 30.0;
  front.params.tare_s = 0.0;
  front.ft.source = &ft;
  front.x.source = &x;
  front.tool.source = &tool;
  ft << 30.0, 0.0, 0.0, 0.0, 3.0, 0.0;
  ASSERT_OK(front.start());
  for (int k = 0; k < 1000; ++k) ASSERT_OK(front.step(1e-3));
  WrenchFrontEnd::Params next = front.params;
  next.dead_force = 10.0;
  next.dead_moment = 50.0;
  front.retune(next, JointLimits());
  for (int k = 0; k < 500; ++k) {
    const Vector6 last = front.h.value;
    ASSERT_OK(front.step(1e-3));
    assert_true(std::abs(front.h.value[0] - last[0]) <= 1.5 * 10.0 * 1e-3 / 0.5 + 1e-9);
    assert_true(std::abs(front.h.value[4] - last[4]) <= 1.5 * 3.0 * 1e-3 / 0.5 + 1e-9);
  }
  ASSERT_OK(front.step(1e-3));
  ASSERT_NEAR(front.h.value[0], 20.0, 1e-9);
  ASSERT_NEAR(front.h.value[4], 0.0, 1e-12);
}

/// A tip that lags behind a steady twist by v / K, without limits that act. Its velocity goes on,
/// and it then lags by v / K of the new gain.
void the_twist_of_the_pose_law_goes_on(void**) {
  PoseBench b;
  const JointVector begin = regular(0);
  ASSERT_OK(b.start(begin));
  const Pose home = b.x_d;
  const Vector3 v(0.02, -0.01, 0.01);
  b.law.v_d.source = nullptr;
  static const Vector6 none = Vector6::Zero();
  b.law.v_d.source = &none;
  JointVector last = zeros;
  double most = 0.0;
  int k = 0;
  const auto run = [&](int cycles) {
    most = 0.0;
    for (const int end = k + cycles; k < end; ++k) {
      b.x_d.p = home.p + 1e-3 * k * v;
      ASSERT_OK(b.step());
      most = std::max(most, (b.law.dq_c.value - last).cwiseAbs().maxCoeff());
      last = b.law.dq_c.value;
    }
  };
  run(1500);
  run(200);
  const double own = most;  // of a steady motion
  CartesianPose::Params next = b.law.params;
  next.position_gain.setConstant(25.0);
  b.law.retune(next, JointLimits());
  run(1);
  assert_true(most <= 2.0 * own + 1e-9);
  run(1500);
  b.measure();
  ASSERT_NEAR((b.x_d.p - b.x.p - v / 25.0).norm() / v.norm(), 0.0, 2e-3);  // half a period and one
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_torque_of_pd_goes_on),
      cmocka_unit_test(what_differs_in_pd_is_gone_in_the_time_that_is_stated),
      cmocka_unit_test(a_law_that_resumes_keeps_what_is_left),
      cmocka_unit_test(pd_refuses_gains_that_ask_for_more_torque_than_there_is),
      cmocka_unit_test(the_force_on_an_admittances_mass_goes_on),
      cmocka_unit_test(an_admittance_with_the_extremes_of_its_parameters_keeps_its_bounds),
      cmocka_unit_test(the_wrench_goes_on_when_the_dead_band_changes),
      cmocka_unit_test(the_twist_of_the_pose_law_goes_on),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
