// Single references of the tool tip: those that admission accepts and refuses, and the ranges of
// the limits in a file.
#include "kernel/reference/space/judge_channels.hpp"
#include "tests/reference/space/task_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const TaskLimits kLimits;

void assert_refused(const Verdict& verdict, Status status, int axis, double value, double limit) {
  ASSERT_STATUS(verdict.status, status);
  assert_int_equal(verdict.axis, axis);
  ASSERT_NEAR(verdict.value, value, 1e-12);
  ASSERT_NEAR(verdict.limit, limit, 1e-12);
}

/// Returns number `i` of the 31 of a point, and its axis in a verdict.
double& number(TaskPoint& point, int i, int& axis) {
  axis = i < 3 ? i : i < 7 ? 3 : (i - 7) % 6;
  if (i < 3) return point.x.p[i];
  if (i < 7) return point.x.r.coeffs()[i - 3];
  Vector6* const vectors[] = {&point.v, &point.a, &point.h, &point.dh};
  return (*vectors[(i - 7) / 6])[(i - 7) % 6];
}

// Proves RG-9.

void a_number_that_is_not_finite_is_refused_and_named(void**) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    for (int i = 0; i < 31; ++i) {
      TaskPoint point;
      int axis = 0;
      number(point, i, axis) = bad;
      assert_false(point.finite());
      const Verdict verdict = judge_online<TaskSpace>(point, kLimits);
      ASSERT_STATUS(verdict.status, Status::kReferenceNotFinite);
      assert_int_equal(verdict.axis, axis);
    }
  }
  assert_true(TaskPoint().finite() && judge_online<TaskSpace>(TaskPoint(), kLimits).ok());
}

// Proves RG-6, RG-10.

void a_quaternion_further_from_unit_than_a_thousandth_is_refused(void**) {
  RandomVectors random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond r = exp_so3(kPi * random.vector());
    TaskPoint point;
    for (const double length : {0.999, 1.0, 1.001}) {
      point.x.r.coeffs() = length * r.coeffs();
      assert_true(judge_online<TaskSpace>(point, kLimits).ok());
    }
    for (const double length : {0.0, 0.5, 0.99899, 1.00101, 2.0}) {
      point.x.r.coeffs() = length * r.coeffs();
      assert_refused(judge_online<TaskSpace>(point, kLimits), Status::kQuaternion, 3, length,
                     length > 1.0 ? 1.001 : 0.999);
    }
  }
}

// Proves RG-6.

void a_point_outside_the_workspace_is_refused(void**) {
  TaskLimits limits;
  limits.p_min = {-0.1, -0.2, 0.3};
  limits.p_max = {0.4, 0.5, 0.6};
  TaskPoint point;
  for (int i = 0; i < 3; ++i) {
    point.x.p = 0.5 * (limits.p_min + limits.p_max);
    for (const double good : {limits.p_min[i], limits.p_max[i]}) {
      point.x.p[i] = good;
      assert_true(judge_online<TaskSpace>(point, limits).ok());
    }
    point.x.p[i] = limits.p_max[i] + 1e-6;
    assert_refused(judge_online<TaskSpace>(point, limits), Status::kWorkspace, i,
                   limits.p_max[i] + 1e-6, limits.p_max[i]);
    point.x.p[i] = limits.p_min[i] - 1e-6;
    assert_refused(judge_online<TaskSpace>(point, limits), Status::kWorkspace, i,
                   limits.p_min[i] - 1e-6, limits.p_min[i]);
  }
}

void speeds_and_wrenches_are_judged_by_their_length(void**) {
  struct Case {
    Vector6 TaskPoint::*field;
    int axis;
    double limit;
    Status status;
  };
  const Case cases[] = {
      {&TaskPoint::v, 0, kLimits.v_max, Status::kVelocityLimit},
      {&TaskPoint::v, 3, kLimits.w_max, Status::kVelocityLimit},
      {&TaskPoint::h, 0, kLimits.force_max, Status::kEffortLimit},
      {&TaskPoint::h, 3, kLimits.moment_max, Status::kEffortLimit},
  };
  for (const Case& c : cases) {
    TaskPoint point;
    (point.*c.field).segment<3>(c.axis) = c.limit * Vector3(2.0, -1.0, 2.0) / 3.0;
    assert_true(judge_online<TaskSpace>(point, kLimits).ok());
    point.*c.field *= 1.0 + 1e-6;
    assert_refused(judge_online<TaskSpace>(point, kLimits), c.status, c.axis,
                   c.limit * (1.0 + 1e-6), c.limit);
  }
}

void whoever_arrives_at_the_end_must_stand(void**) {
  TaskPoint end;
  end.h.setConstant(1.0);
  assert_true(judge_end<TaskSpace>(end).ok());
  for (int i = 0; i < 6; ++i) {
    TaskPoint moving;
    moving.a[i] = 1.0;  // it may still decelerate when it arrives
    assert_true(judge_end<TaskSpace>(moving).ok());
    moving.v[i] = -2e-6;
    assert_refused(judge_end<TaskSpace>(moving), Status::kNotAtRest, i, -2e-6, 0.0);
    moving.v[i] = std::nan("");
    ASSERT_STATUS(judge_end<TaskSpace>(moving).status, Status::kNotAtRest);
  }
}

// Proves RG-7.

void near_is_a_distance_and_an_angle(void**) {
  const TaskSpace::Tolerance tolerance = {0.01, 0.1};
  TaskPoint a, b;
  b.x = {{0.005, -0.005, 0.005}, negative(exp_so3({0.0, 0.0, 0.09}))};
  assert_true(TaskSpace::judge_near(a, b, tolerance).ok());
  b.x.p[1] = -0.02;
  assert_refused(TaskSpace::judge_near(a, b, tolerance), Status::kStartTolerance, 0,
                 (b.x.p - a.x.p).norm(), 0.01);
  b.x = {Vector3::Zero(), exp_so3({0.0, -0.11, 0.0})};
  assert_refused(TaskSpace::judge_near(a, b, tolerance), Status::kStartTolerance, 3, 0.11, 0.1);
  b.x.p[0] = std::nan("");
  assert_false(TaskSpace::judge_near(a, b, tolerance).ok());
}

// Proves CFG-5.

/// Counts the limits whose range accepts, and refuses, a share of their value.
struct Setter {
  double share;
  int passed = 0, refused = 0;
  void param(const char*, double& value, const Range& range, const char*) {
    (range.contains(share * value) ? passed : refused) += 1;
  }
  void param(const char*, Vector3& value, const Range& range, const char*) {
    (range.contains(share * value[0]) ? passed : refused) += 1;
  }
};

void limits_may_be_tightened_and_not_widened(void**) {
  for (const double share : {1e-3, 0.5, 1.0, 1.001, 0.0, -1.0}) {
    TaskLimits limits;
    Setter setter{share};
    limits.describe(setter);
    const bool allowed = share > 0.0 && share <= 1.0;
    // zero and a mirrored box are places within the workspace
    const int places = share <= 0.0 ? 2 : 0;
    assert_true(allowed ? setter.refused == 0 : setter.passed == places);
    assert_true(setter.passed + setter.refused >= 10);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_number_that_is_not_finite_is_refused_and_named),
      cmocka_unit_test(a_quaternion_further_from_unit_than_a_thousandth_is_refused),
      cmocka_unit_test(a_point_outside_the_workspace_is_refused),
      cmocka_unit_test(speeds_and_wrenches_are_judged_by_their_length),
      cmocka_unit_test(whoever_arrives_at_the_end_must_stand),
      cmocka_unit_test(near_is_a_distance_and_an_angle),
      cmocka_unit_test(limits_may_be_tightened_and_not_widened),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
