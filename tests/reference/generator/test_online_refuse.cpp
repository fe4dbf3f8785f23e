// Points under `online = refuse`: put out as they came where the velocity limits let the reference
// go there within a period, refused beyond.
#include "tests/reference/motion/motion_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr double kPeriod_s = 2e-3;
constexpr Fields kQuintics = kVelocityField | kAccelerationField;

/// Sends a point and runs its cycle: the report. One that is executed is put out as it came, one
/// that is refused leaves the reference where it was.
template <class Space>
Report answer(MotionBench<Space>& bench, const typename Space::Point& point) {
  const typename Space::Point before = bench.out();
  const std::uint32_t id = bench.send(point);
  assert_int_not_equal(id, 0);
  ASSERT_OK(bench.step());
  const Report report = bench.report_of(id);
  const bool executed = report.outcome == Outcome::kExecuted;
  assert_true(executed || report.outcome == Outcome::kRefused);
  const typename Space::Difference left = Space::difference(bench.out(), executed ? point : before);
  assert_true(left.zero());
  return report;
}

void assert_refused(const Report& report, int axis, double value, double limit) {
  ASSERT_STATUS(report.outcome, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kVelocityLimit);
  assert_int_equal(report.verdict.axis, axis);
  ASSERT_NEAR(report.verdict.value, value, 1e-9);
  ASSERT_NEAR(report.verdict.limit, limit, 0.0);
}

// Proves RG-3, RG-6.

void a_joint_goes_no_farther_in_a_period_than_its_velocity_allows(void**) {
  for (int j = 0; j < kDof; ++j) {
    for (const double sign : {1.0, -1.0}) {
      MotionBench<JointSpace> bench(kPeriod_s, OnlineMode::kRefuse);
      const double most = bench.channel.settings.limits.dq_max[j];
      JointSpace::Point point = bench.home;
      for (int k = 0; k < 3; ++k) {  // from where the reference is, not from where it was
        point.q[j] += sign * 0.999 * most * kPeriod_s;
        ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
      }
      point.q[j] += sign * 1.001 * most * kPeriod_s;
      assert_refused(answer(bench, point), j, 1.001 * most, most);
    }
  }
}

void a_tip_goes_no_farther_in_a_period_than_its_speed_allows(void**) {
  MotionBench<TaskSpace> bench(kPeriod_s, OnlineMode::kRefuse);
  const double most = bench.channel.settings.limits.v_max;
  TaskSpace::Point point = bench.home;
  const Vector3 along = {0.6, 0.0, -0.8};
  point.x.p += 0.999 * most * kPeriod_s * along;
  ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
  point.x.p += 1.001 * most * kPeriod_s * along;
  assert_refused(answer(bench, point), 0, 1.001 * most, most);
}

void a_tip_turns_no_farther_in_a_period_than_its_speed_allows(void**) {
  MotionBench<TaskSpace> bench(kPeriod_s, OnlineMode::kRefuse);
  const double most = bench.channel.settings.limits.w_max;
  TaskSpace::Point point = bench.home;
  const Vector3 about = {0.0, -0.6, 0.8};
  point.x.r = bench.home.x.r * exp_so3(0.999 * most * kPeriod_s * about);
  ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
  point.x.r = bench.out().x.r * exp_so3(1.001 * most * kPeriod_s * about);
  assert_refused(answer(bench, point), 3, 1.001 * most, most);
}

/// Under any other setting the same point is taken.
void only_where_the_file_says_so(void**) {
  for (const OnlineMode online : {OnlineMode::kForward, OnlineMode::kLimit, OnlineMode::kRefuse}) {
    MotionBench<JointSpace> bench(kPeriod_s, online);
    JointSpace::Point point = bench.home;
    point.q[0] += 0.5;
    const std::uint32_t id = bench.send(point);
    ASSERT_OK(bench.step());
    ASSERT_STATUS(bench.report_of(id).outcome,
                  online == OnlineMode::kRefuse ? Outcome::kRefused : Outcome::kExecuted);
  }
}

// Proves RG-1.

void a_point_that_is_refused_leaves_a_trajectory_to_run(void**) {
  MotionBench<JointSpace> bench(kPeriod_s, OnlineMode::kRefuse);
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  JointSpace::Point goal = bench.home;
  goal.q[0] += 0.3;
  bench.add(*motion, 1.0, goal);
  const std::uint32_t id = bench.send(*motion);
  for (int k = bench.cycles(0.5); k > 0; --k) ASSERT_OK(bench.step());
  const std::uint32_t refused = bench.send(bench.home);
  ASSERT_OK(bench.step());
  ASSERT_STATUS(bench.report_of(refused).outcome, Outcome::kRefused);
  assert_true(bench.executing());
  for (int k = bench.cycles(0.6); k > 0; --k) ASSERT_OK(bench.step());
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
  ASSERT_NEAR((bench.out().q - goal.q).norm(), 0.0, 1e-12);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_goes_no_farther_in_a_period_than_its_velocity_allows),
      cmocka_unit_test(a_tip_goes_no_farther_in_a_period_than_its_speed_allows),
      cmocka_unit_test(a_tip_turns_no_farther_in_a_period_than_its_speed_allows),
      cmocka_unit_test(only_where_the_file_says_so),
      cmocka_unit_test(a_point_that_is_refused_leaves_a_trajectory_to_run),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
