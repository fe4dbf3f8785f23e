// Online points: shaped within limits if the mode says so, and stopped when the stream goes silent.
// Points under `online = refuse`: put out as they came where the velocity limits let the reference
// go there within a period, refused beyond.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/reference/motion/motion_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

void send(ReferenceBench& bench, const JointSpace::Point& point) {
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id).ok());
}

/// Returns a reference `offset` rad from home with a velocity and an effort that nothing ends.
JointSpace::Point moving_point(const ReferenceBench& bench, double offset) {
  JointSpace::Point point;
  point.q = bench.home.q + JointVector::Constant(offset);
  point.dq.setConstant(0.2);
  point.tau.setConstant(3.0);
  return point;
}

// Proves RG-12.

void a_limited_point_is_reached_within_limits(void**) {
  static ReferenceBench bench;
  bench.params.online = OnlineMode::kLimit;
  ASSERT_OK(bench.start(bench.home.q));
  const JointLimits& limits = bench.channel.settings.limits;
  Random random{5};
  for (int n = 0; n < 300; ++n) {
    JointSpace::Point point;
    point.q = bench.home.q + JointVector::Constant(random.uniform(-0.5, 0.5));
    send(bench, point);
    for (int k = 1 + random.below(800); k > 0; --k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      for (int j = 0; j < kDof; ++j) {
        constexpr double kOver = 1.0 + 1e-9;
        assert_true(std::abs(bench.out().dq[j]) <= limits.dq_max[j] * kOver);
        assert_true(std::abs(bench.out().ddq[j]) <= limits.ddq_max[j] * kOver);
        ASSERT_NEAR(bench.out().ddq[j], before.ddq[j], limits.dddq_max[j] * kPeriod_s * kOver);
      }
    }
    static_cast<void>(bench.final_of(0));
  }
  JointSpace::Point last;
  last.q = bench.home.q;
  send(bench, last);
  ASSERT_OK(bench.run(3000));
  assert_true(bench.out().q == bench.home.q && bench.out().standing());
}

void a_stream_that_dries_up_comes_to_rest_without_a_step(void**) {
  static ReferenceBench bench;
  bench.params.timeout_s = 0.05;
  ASSERT_OK(bench.start(bench.home.q));
  send(bench, moving_point(bench, 0.0));
  ASSERT_OK(bench.run(49));
  ASSERT_NEAR(bench.out().dq[0], 0.2, 0.0);
  for (int k = 0; k < 1000; ++k) {
    const JointSpace::Point before = bench.out();
    ASSERT_OK(bench.step());
    ASSERT_NEAR(bench.out().dq[0], before.dq[0],
                bench.channel.settings.limits.ddq_max[0] * kPeriod_s * (1.0 + 1e-9));
  }
  assert_true(bench.out().idle());
}

void a_stream_that_goes_on_is_not_stopped(void**) {
  static ReferenceBench bench;
  bench.params.timeout_s = 0.05;
  ASSERT_OK(bench.start(bench.home.q));
  for (int k = 0; k < 20; ++k) {
    send(bench, moving_point(bench, 1e-3 * k));
    ASSERT_OK(bench.run(40));
    ASSERT_NEAR(bench.out().dq[0], 0.2, 0.0);
    static_cast<void>(bench.final_of(0));
  }
}

void the_effort_of_a_trajectory_is_taken_to_zero_at_its_end(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* push = bench.trajectory(kVelocityField | kEffortField);
  bench.add(*push, 1.0, 0.1);
  push->waypoints[0].point.tau.setConstant(5.0);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*push, id).ok());
  ASSERT_OK(bench.run(1000));
  ASSERT_NEAR(bench.out().tau[0], 5.0, 0.01);
  for (int k = 0; k < 200; ++k) {
    const double before = bench.out().tau[0];
    ASSERT_OK(bench.step());
    ASSERT_NEAR(bench.out().tau[0], before, 0.1);
  }
  assert_true(bench.out().idle());
}

/// A cancel ends what a held point feeds forward, sent alone or behind another point.
void a_cancel_takes_the_feed_forward_of_a_held_point_to_zero(void**) {
  for (const bool behind_a_point : {false, true}) {
    ReferenceBench b;
    b.params.online = OnlineMode::kLimit;
    ASSERT_OK(b.start(b.home.q));
    JointSpace::Point point;
    point.q = b.home.q;
    point.tau[0] = 20.0;
    std::uint32_t id = 0, cancel = 0;
    assert_true(b.client.send(point, id).ok());
    ASSERT_OK(b.run(200));
    ASSERT_NEAR(b.out().tau[0], 20.0, 0.0);
    if (behind_a_point) assert_true(b.client.send(point, id).ok());
    assert_true(b.client.cancel(cancel).ok());
    ASSERT_OK(b.run(110));
    assert_true(b.final_of(cancel).outcome == Outcome::kExecuted);
    ASSERT_NEAR(b.out().tau[0], 0.0, 0.0);
  }
}

constexpr double kRefusePeriod_s = 2e-3;
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
      MotionBench<JointSpace> bench(kRefusePeriod_s, OnlineMode::kRefuse);
      const double most = bench.channel.settings.limits.dq_max[j];
      JointSpace::Point point = bench.home;
      for (int k = 0; k < 3; ++k) {  // from where the reference is, not from where it was
        point.q[j] += sign * 0.999 * most * kRefusePeriod_s;
        ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
      }
      point.q[j] += sign * 1.001 * most * kRefusePeriod_s;
      assert_refused(answer(bench, point), j, 1.001 * most, most);
    }
  }
}

void a_tip_goes_no_farther_in_a_period_than_its_speed_allows(void**) {
  MotionBench<TaskSpace> bench(kRefusePeriod_s, OnlineMode::kRefuse);
  const double most = bench.channel.settings.limits.v_max;
  TaskSpace::Point point = bench.home;
  const Vector3 along = {0.6, 0.0, -0.8};
  point.x.p += 0.999 * most * kRefusePeriod_s * along;
  ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
  point.x.p += 1.001 * most * kRefusePeriod_s * along;
  assert_refused(answer(bench, point), 0, 1.001 * most, most);
}

void a_tip_turns_no_farther_in_a_period_than_its_speed_allows(void**) {
  MotionBench<TaskSpace> bench(kRefusePeriod_s, OnlineMode::kRefuse);
  const double most = bench.channel.settings.limits.w_max;
  TaskSpace::Point point = bench.home;
  const Vector3 about = {0.0, -0.6, 0.8};
  point.x.r = bench.home.x.r * exp_so3(0.999 * most * kRefusePeriod_s * about);
  ASSERT_STATUS(answer(bench, point).outcome, Outcome::kExecuted);
  point.x.r = bench.out().x.r * exp_so3(1.001 * most * kRefusePeriod_s * about);
  assert_refused(answer(bench, point), 3, 1.001 * most, most);
}

/// Under any other setting the same point is taken.
void only_where_the_file_says_so(void**) {
  for (const OnlineMode online : {OnlineMode::kForward, OnlineMode::kLimit, OnlineMode::kRefuse}) {
    MotionBench<JointSpace> bench(kRefusePeriod_s, online);
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
  MotionBench<JointSpace> bench(kRefusePeriod_s, OnlineMode::kRefuse);
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
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_limited_point_is_reached_within_limits),
      cmocka_unit_test(a_stream_that_dries_up_comes_to_rest_without_a_step),
      cmocka_unit_test(a_stream_that_goes_on_is_not_stopped),
      cmocka_unit_test(the_effort_of_a_trajectory_is_taken_to_zero_at_its_end),
      cmocka_unit_test(a_cancel_takes_the_feed_forward_of_a_held_point_to_zero),
      cmocka_unit_test(a_joint_goes_no_farther_in_a_period_than_its_velocity_allows),
      cmocka_unit_test(a_tip_goes_no_farther_in_a_period_than_its_speed_allows),
      cmocka_unit_test(a_tip_turns_no_farther_in_a_period_than_its_speed_allows),
      cmocka_unit_test(only_where_the_file_says_so),
      cmocka_unit_test(a_point_that_is_refused_leaves_a_trajectory_to_run),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
