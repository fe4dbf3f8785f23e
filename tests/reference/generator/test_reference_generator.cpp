// The joint reference generator as a client sees it: its output and its reports.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kCubic = kVelocityField;
constexpr Fields kQuintic = kVelocityField | kAccelerationField;

// Proves EXE-2.

void the_first_reference_is_the_measured_position_at_rest(void**) {
  static ReferenceBench bench;
  ASSERT_OK(bench.step());
  for (int j = 0; j < kDof; ++j) {
    assert_true(bench.out().q[j] == bench.home.q[j]);
    assert_true(bench.out().dq[j] == 0.0 && bench.out().ddq[j] == 0.0 && bench.out().tau[j] == 0.0);
  }
}

// Proves RG-9.

void a_measured_position_that_is_not_finite_refuses_to_start(void**) {
  static ReferenceBench bench;
  JointVector q = bench.home.q;
  q[3] = NAN;
  ASSERT_STATUS(bench.start(q), Status::kStateNotFinite);
}

// Proves RG-3.

void a_point_is_forwarded_as_it_came_and_held(void**) {
  static ReferenceBench bench;
  JointSpace::Point point;
  point.q = bench.home.q + JointVector::Constant(0.1);
  point.tau = JointVector::Constant(2.0);
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id).ok());
  for (int k = 0; k < 3; ++k) {
    ASSERT_OK(bench.step());
    assert_true(bench.out().q == point.q && bench.out().tau == point.tau);
  }
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kExecuted);
}

// Proves RG-5.

void of_two_points_in_one_cycle_the_later_counts_and_both_are_reported(void**) {
  static ReferenceBench bench;
  JointSpace::Point first, second;
  first.q = bench.home.q + JointVector::Constant(0.1);
  second.q = bench.home.q - JointVector::Constant(0.1);
  std::uint32_t id[2] = {0, 0};
  assert_true(bench.client.send(first, id[0]).ok() && bench.client.send(second, id[1]).ok());
  ASSERT_OK(bench.step());
  assert_true(bench.out().q == second.q);
  Report report;
  assert_true(bench.client.poll(report) && report.id == id[0]);
  ASSERT_OUTCOME(report, Outcome::kSuperseded);
  assert_true(bench.client.poll(report) && report.id == id[1]);
  ASSERT_OUTCOME(report, Outcome::kExecuted);
  assert_false(bench.client.poll(report));
}

// Proves RG-5.

void a_completed_trajectory_holds_its_last_waypoint_and_succeeds(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(0.25, 0.5, kCubic);
  ASSERT_OK(bench.run(500));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kStarted);
  ASSERT_OK(bench.step());
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
  ASSERT_OK(bench.run(100));
  assert_true(bench.out().q == bench.home.q + JointVector::Constant(0.25));
  assert_true(bench.out().dq == JointVector::Zero());
  assert_int_equal(static_cast<int>(bench.generator.state()),
                   static_cast<int>(ReferenceState::kOnlineReference));
}

// Proves RG-7.

void a_first_waypoint_at_zero_must_be_near_the_reference(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* far = bench.trajectory(kCubic);
  bench.add(*far, 0.0, 0.0);
  far->waypoints[0].point.q[4] += 0.02;
  bench.add(*far, 1.0, 0.1);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*far, id).ok());
  ASSERT_OK(bench.step());
  const Report report = bench.final_of(id);
  ASSERT_OUTCOME(report, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kStartTolerance);
  assert_int_equal(report.verdict.axis, 4);
  ASSERT_NEAR(report.verdict.value, 0.02, 1e-12);
  ASSERT_NEAR(report.verdict.limit, 0.01, 0.0);
  assert_true(bench.out().q == bench.home.q);
}

void a_small_start_offset_is_bridged_without_a_step(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* near = bench.trajectory(kCubic);
  bench.add(*near, 0.0, 0.009);
  bench.add(*near, 1.0, 0.009);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*near, id).ok());
  double last = bench.home.q[0];
  for (int k = 0; k < 1001; ++k) {
    ASSERT_OK(bench.step());
    ASSERT_NEAR(bench.out().q[0], last, 1e-3 * bench.channel.settings.limits.dq_max[0]);
    last = bench.out().q[0];
  }
  ASSERT_NEAR(last - bench.home.q[0], 0.009, 1e-12);
}

// Proves RG-6.

void the_way_to_the_first_waypoint_is_judged_when_it_begins(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(1.0, 0.2, kCubic);  // 1 rad in 0.2 s: 7.5 rad/s
  assert_true(id != 0);
  ASSERT_OK(bench.step());
  const Report report = bench.final_of(id);
  ASSERT_OUTCOME(report, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kVelocityLimit);
  assert_int_equal(report.verdict.waypoint, 0);
  ASSERT_NEAR(report.verdict.value, 7.5, 1e-9);
}

// Proves RG-5.

void a_new_trajectory_preempts_the_old_one_and_is_told(void**) {
  static ReferenceBench bench;
  const std::uint32_t old = bench.go(0.5, 1.0, kQuintic);
  ASSERT_OK(bench.run(400));
  const std::uint32_t later = bench.go(-0.3, 1.5, kQuintic);
  ASSERT_OK(bench.step());
  Report report;
  assert_true(bench.client.poll(report) && report.id == old);
  ASSERT_OUTCOME(report, Outcome::kStarted);
  assert_true(bench.client.poll(report) && report.id == old);
  ASSERT_OUTCOME(report, Outcome::kPreempted);
  assert_true(bench.client.poll(report) && report.id == later);
  ASSERT_OUTCOME(report, Outcome::kStarted);
  ASSERT_OK(bench.run(1500));
  ASSERT_OUTCOME(bench.final_of(later), Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[2] - bench.home.q[2], -0.3, 1e-12);
}

void a_restart_aborts_what_ran_and_refuses_what_waited(void**) {
  static ReferenceBench bench;
  const std::uint32_t running = bench.go(0.5, 1.0, kCubic);
  ASSERT_OK(bench.run(100));
  const std::uint32_t waiting = bench.go(-0.5, 1.0, kCubic);
  ASSERT_OK(bench.start(bench.home.q));
  ASSERT_OK(bench.step());
  Report report;
  assert_true(bench.client.poll(report) && report.id == running);
  ASSERT_OUTCOME(report, Outcome::kStarted);
  assert_true(bench.client.poll(report) && report.id == running);
  ASSERT_OUTCOME(report, Outcome::kAborted);
  assert_true(bench.client.poll(report) && report.id == waiting);
  ASSERT_OUTCOME(report, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kNotStarted);
  assert_true(bench.out().q == bench.home.q);
  assert_true(bench.go(0.1, 1.0, kCubic) != 0);  // every store is free again
}

void a_point_aborts_a_running_trajectory(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(0.5, 1.0, kCubic);
  ASSERT_OK(bench.run(100));
  JointSpace::Point point;
  point.q = bench.home.q;
  std::uint32_t point_id = 0;
  assert_true(bench.client.send(point, point_id).ok());
  ASSERT_OK(bench.step());
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kAborted);
  assert_true(bench.out().q == bench.home.q);
}

// Proves RG-4.

void a_cancelled_trajectory_brakes_to_rest_and_holds(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(0.8, 1.0, kQuintic);
  ASSERT_OK(bench.run(500));
  const double speed = bench.out().dq[0], before = bench.out().q[0];
  std::uint32_t cancel = 0;
  assert_true(bench.client.cancel(cancel).ok());
  ASSERT_OK(bench.step());
  ASSERT_NEAR(bench.out().dq[0], speed, 20e-3);  // one period at 20 rad/s^2
  ASSERT_NEAR(bench.out().q[0], before + 1e-3 * speed, 1e-5);
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kCanceled);
  ASSERT_OK(bench.run(1000));
  assert_true(bench.out().dq == JointVector::Zero() && bench.out().ddq == JointVector::Zero());
  assert_true(bench.out().q[0] > before);
}

// Proves RG-5.

void a_cancel_with_nothing_to_cancel_is_refused(void**) {
  static ReferenceBench bench;
  std::uint32_t id = 0;
  assert_true(bench.client.cancel(id).ok());
  ASSERT_OK(bench.step());
  const Report report = bench.final_of(id);
  ASSERT_OUTCOME(report, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kNothingToCancel);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_first_reference_is_the_measured_position_at_rest),
      cmocka_unit_test(a_measured_position_that_is_not_finite_refuses_to_start),
      cmocka_unit_test(a_point_is_forwarded_as_it_came_and_held),
      cmocka_unit_test(of_two_points_in_one_cycle_the_later_counts_and_both_are_reported),
      cmocka_unit_test(a_completed_trajectory_holds_its_last_waypoint_and_succeeds),
      cmocka_unit_test(a_first_waypoint_at_zero_must_be_near_the_reference),
      cmocka_unit_test(a_small_start_offset_is_bridged_without_a_step),
      cmocka_unit_test(the_way_to_the_first_waypoint_is_judged_when_it_begins),
      cmocka_unit_test(a_new_trajectory_preempts_the_old_one_and_is_told),
      cmocka_unit_test(a_restart_aborts_what_ran_and_refuses_what_waited),
      cmocka_unit_test(a_point_aborts_a_running_trajectory),
      cmocka_unit_test(a_cancelled_trajectory_brakes_to_rest_and_holds),
      cmocka_unit_test(a_cancel_with_nothing_to_cancel_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
