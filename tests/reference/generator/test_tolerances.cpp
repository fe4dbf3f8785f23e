// Path and goal tolerances: a goal ends as it should when the robot is not where it should be.
// A robot that is not kept where its reference rests: found after the goal time, and only then.
#include <cmath>
#include <vector>

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// Sends a goal of 0.2 rad in one second on a bench with these tolerances.
std::uint32_t begin(ReferenceBench& bench, const Tolerances<JointSpace>& tolerances) {
  bench.params.tolerances = tolerances;
  assert_int_equal(static_cast<int>(bench.start(bench.home.q)), 0);
  return bench.go(0.2, 1.0, kVelocityField);
}

Tolerances<JointSpace> path_of(double rad) {
  Tolerances<JointSpace> tolerances;
  tolerances.path.q.setConstant(rad);
  return tolerances;
}

Tolerances<JointSpace> goal_of(double rad, double goal_time_s) {
  Tolerances<JointSpace> tolerances;
  tolerances.goal.q.setConstant(rad);
  tolerances.stopped_velocity = 0.05;
  tolerances.goal_time_s = goal_time_s;
  return tolerances;
}

/// Steps a robot that is off by `error` rad on axis 2 until the goal has ended; returns the final
/// report.
Report follow(ReferenceBench& bench, std::uint32_t id, double error, int cycles = 5000) {
  for (int k = 0; k < cycles; ++k) {
    JointSpace::Point measured = bench.out();
    measured.q[2] += error;
    if (bench.step(measured) != Status::kOk) break;
    const Report report = bench.final_of(id);
    if (report.outcome != Outcome::kStarted) return report;
  }
  Report none;
  none.outcome = Outcome::kStarted;
  return none;
}

// Proves RG-13.

void a_robot_beyond_the_path_tolerance_aborts_its_goal_with_joint_value_and_limit(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, path_of(0.05));
  const Report report = follow(bench, id, -0.06);
  ASSERT_OUTCOME(report, Outcome::kAborted);
  ASSERT_STATUS(report.verdict.status, Status::kPathTolerance);
  assert_int_equal(report.verdict.axis, 2);
  ASSERT_NEAR(report.verdict.value, 0.06, 1e-3);
  ASSERT_NEAR(report.verdict.limit, 0.05, 0.0);
}

void after_a_violation_the_reference_comes_to_rest_and_stays(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, path_of(0.05));
  JointSpace::Point measured;
  measured.q = bench.home.q;
  for (int k = 0; k < 3000; ++k) {
    const JointSpace::Point before = bench.out();
    ASSERT_OK(bench.step(measured));
    for (int j = 0; j < kDof; ++j) {
      ASSERT_NEAR(bench.out().q[j], before.q[j], 1e-3 * bench.channel.settings.limits.dq_max[j]);
      assert_true(bench.out().q[j] >= before.q[j]);
    }
  }
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kAborted);
  assert_true(bench.out().standing());
}

void an_error_that_is_nan_violates(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, path_of(10.0));
  const Report report = follow(bench, id, NAN);
  ASSERT_OUTCOME(report, Outcome::kAborted);
  ASSERT_STATUS(report.verdict.status, Status::kPathTolerance);
}

void a_goal_succeeds_only_inside_its_band(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, goal_of(0.01, 0.5));
  assert_int_equal(static_cast<int>(follow(bench, id, 0.02, 1200).outcome),
                   static_cast<int>(Outcome::kStarted));  // still outside, not yet late
  ASSERT_OUTCOME(follow(bench, id, 0.005, 10), Outcome::kSucceeded);
}

void a_goal_that_is_not_reached_in_time_is_aborted_with_joint_value_and_limit(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, goal_of(0.01, 0.5));
  const Report report = follow(bench, id, 0.02);
  ASSERT_OUTCOME(report, Outcome::kAborted);
  ASSERT_STATUS(report.verdict.status, Status::kGoalTolerance);
  assert_int_equal(report.verdict.axis, 2);
  ASSERT_NEAR(report.verdict.value, 0.02, 1e-9);
}

void a_goal_is_reached_only_when_the_robot_has_stopped(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, goal_of(0.01, 2.0));
  JointSpace::Point measured;
  for (int k = 0; k < 1500; ++k) {
    measured = bench.out();
    measured.dq[5] = 0.1;
    ASSERT_OK(bench.step(measured));
  }
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kStarted);
  ASSERT_OUTCOME(follow(bench, id, 0.0, 2), Outcome::kSucceeded);
}

void the_dwell_time_begins_anew_whenever_the_band_is_left(void**) {
  static ReferenceBench bench;
  Tolerances<JointSpace> tolerances = goal_of(0.01, 2.0);
  tolerances.dwell_s = 0.05;
  const std::uint32_t id = begin(bench, tolerances);
  assert_int_equal(static_cast<int>(follow(bench, id, 0.0, 1040).outcome),
                   static_cast<int>(Outcome::kStarted));
  assert_int_equal(static_cast<int>(follow(bench, id, 0.02, 1).outcome),
                   static_cast<int>(Outcome::kStarted));
  assert_int_equal(static_cast<int>(follow(bench, id, 0.0, 45).outcome),
                   static_cast<int>(Outcome::kStarted));
  ASSERT_OUTCOME(follow(bench, id, 0.0, 10), Outcome::kSucceeded);
}

void the_known_latency_of_a_robot_is_no_error(void**) {
  static ReferenceBench bench;
  bench.params.latency_cycles = 4;  // in addition to the one cycle that every robot takes
  const std::uint32_t id = begin(bench, path_of(1e-9));
  std::array<JointSpace::Point, 5> line;
  line.fill(bench.out());
  for (std::size_t k = 0; k < 1100; ++k) {  // the robot is at the reference of 5 cycles ago
    const JointSpace::Point late = line[k % line.size()];
    ASSERT_OK(bench.step(late));
    line[k % line.size()] = bench.out();
  }
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

void a_goal_may_bring_its_own_tolerances_or_switch_them_off(void**) {
  for (const double own : {-1.0, 0.1}) {
    static ReferenceBench benches[2];
    ReferenceBench& bench = benches[own > 0.0];
    bench.params.tolerances = path_of(0.01);
    ASSERT_OK(bench.start(bench.home.q));
    Trajectory<JointSpace>* motion = bench.trajectory(kVelocityField);
    bench.add(*motion, 1.0, 0.2);
    motion->tolerances.path.q.setConstant(own);
    std::uint32_t id = 0;
    assert_true(bench.client.send(*motion, id).ok());
    ASSERT_OUTCOME(follow(bench, id, 0.05), Outcome::kSucceeded);
  }
}

// Proves RG-5.

void of_cancels_where_a_path_has_ended_two_are_executed_and_no_more(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = begin(bench, goal_of(0.01, 10.0));
  ASSERT_OUTCOME(follow(bench, id, 0.05, 1500), Outcome::kStarted);
  assert_true(bench.generator.phase() == MotionPhase::kSettling);
  std::uint32_t cancels[3];
  for (std::uint32_t& cancel : cancels) assert_true(bench.client.cancel(cancel).ok());
  JointSpace::Point measured = bench.out();
  measured.q[2] += 0.05;
  ASSERT_OK(bench.step(measured));
  const Outcome expected[] = {Outcome::kExecuted, Outcome::kExecuted, Outcome::kRefused};
  Report report;
  for (int told = 0; bench.client.poll(report);) {
    if (report.id == id) continue;
    assert_int_equal(report.id, cancels[told]);
    ASSERT_OUTCOME(report, expected[told++]);
  }
  ASSERT_STATUS(report.verdict.status, Status::kNothingToCancel);
}

/// Joined when it is nearly over, or at its only waypoint, a path ends long before the reference is
/// there.
void a_goal_does_not_succeed_before_its_reference_is_there(void**) {
  for (const bool late : {false, true}) {
    static ReferenceBench benches[2];
    ReferenceBench& bench = benches[late];
    bench.params.start_tolerance.q.setConstant(0.5);
    bench.params.tolerances = goal_of(0.01, 0.0);
    ASSERT_OK(bench.start(bench.home.q));
    ASSERT_OK(bench.run(1990));
    Trajectory<JointSpace>* motion = bench.trajectory(kVelocityField | kAccelerationField);
    if (late) bench.add(*motion, 0.0, 0.0);
    bench.add(*motion, late ? 2.0 : 0.0, 0.4);
    motion->start_s = late ? 0.0 : kStartAtOnce;
    std::uint32_t id = 0;
    assert_true(bench.client.send(*motion, id).ok());
    ASSERT_OUTCOME(follow(bench, id, 0.0), Outcome::kSucceeded);
    ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4, 1e-9);
  }
}

constexpr double kTolerance_rad = 0.05, kGoalTime_s = 0.5;
constexpr double kSlowing_s = 0.3;  // of the slowest motion here, from the band to rest

ReferenceBench& fresh(ReferenceBench& bench, double goal_time_s = kGoalTime_s) {
  bench.params.tolerances = {};
  bench.params.tolerances.path.q.setConstant(kTolerance_rad);
  bench.params.tolerances.goal_time_s = goal_time_s;
  ASSERT_OK(bench.start(bench.home.q));
  return bench;
}

/// Steps a robot that swings about its reference until that is refused or `time_s` is over. Returns
/// the time since the reference was last a quarter of the tolerance from where it is then; infinity
/// if it was not refused.
double swing(ReferenceBench& bench, double amplitude_rad, double hertz, double time_s) {
  std::vector<double> way;
  for (double t = 0.0; t < time_s; t += ReferenceBench::kPeriod_s) {
    const JointSpace::Point before = bench.out();
    JointSpace::Point measured = before;
    measured.q[4] += amplitude_rad * std::sin(2.0 * M_PI * hertz * t);
    const Status status = bench.step(measured);
    way.push_back(bench.out().q[0]);
    if (status == Status::kOk) continue;
    ASSERT_STATUS(status, Status::kPathTolerance);
    const Verdict held = bench.generator.held();
    ASSERT_STATUS(held.status, status);
    assert_int_equal(held.axis, 4);
    assert_true(held.value > kTolerance_rad && held.limit == kTolerance_rad);
    assert_true(std::abs(measured.q[4] - before.q[4]) > kTolerance_rad);
    std::size_t rests = 0;
    while (rests < way.size() &&
           std::abs(way[way.size() - 1 - rests] - way.back()) <= 0.25 * kTolerance_rad)
      ++rests;
    return static_cast<double>(rests) * ReferenceBench::kPeriod_s;
  }
  return kInfinity;
}

/// Sends the present place, but for `noise_rad`.
void lead(ReferenceBench& bench, double noise_rad, Random& random) {
  JointSpace::Point point;
  point.q = bench.home.q;
  for (double& q : point.q) q += random.uniform(-noise_rad, noise_rad);
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id).ok());
  static_cast<void>(bench.final_of(id));
}

// Proves RG-39.

void a_swing_about_a_reference_that_rests_is_found_within_half_a_swing(void**) {
  Random random{11};
  for (int i = 0; i < 200; ++i) {
    static ReferenceBench bench;
    static_cast<void>(fresh(bench).final_of(0));
    bench.go(random.uniform(-0.2, 0.2), random.uniform(0.3, 1.0), kVelocityField);
    const double hertz = random.uniform(0.5, 8.0), share = random.uniform(0.5, 2.0);
    const double found_s = swing(bench, share * kTolerance_rad, hertz, 6.0);
    assert_true(std::isfinite(found_s) == (share > 1.0));
    if (share <= 1.0) continue;
    assert_true(found_s > kGoalTime_s - 2.0 * ReferenceBench::kPeriod_s);
    assert_true(found_s <= kGoalTime_s + kSlowing_s + 0.5 / hertz);
  }
}

void a_leader_whose_points_are_noisy_hides_no_swing(void**) {
  Random random{12};
  for (const double noise_rad : {1e-12, 1e-6, 1e-4, 1e-3}) {
    for (const OnlineMode online : {OnlineMode::kForward, OnlineMode::kLimit}) {
      static ReferenceBench bench;
      bench.params.online = online;
      fresh(bench);
      double found_s = kInfinity, time_s = 0.0;
      for (; std::isinf(found_s) && time_s < 3.0 * kGoalTime_s; time_s += 0.02) {
        lead(bench, noise_rad, random);
        found_s = swing(bench, 3.0 * kTolerance_rad, 25.0, 0.02);
      }
      assert_true(std::isfinite(found_s));
      assert_true(time_s > kGoalTime_s - 0.02 && time_s < kGoalTime_s + 0.1);
    }
  }
}

void a_reference_that_moves_again_in_time_is_never_refused(void**) {
  for (const OnlineMode online : {OnlineMode::kForward, OnlineMode::kLimit}) {
    static ReferenceBench benches[2];
    ReferenceBench& bench = benches[online == OnlineMode::kLimit];
    bench.params.online = online;
    fresh(bench);
    for (int i = 0; i < 40; ++i) {
      JointSpace::Point point;
      point.q = bench.home.q + JointVector::Constant(i % 2 == 0 ? 0.02 : -0.02);
      std::uint32_t id = 0;
      assert_true(bench.client.send(point, id).ok());
      assert_true(std::isinf(swing(bench, 3.0 * kTolerance_rad, 4.0, 0.9 * kGoalTime_s)));
      static_cast<void>(bench.final_of(id));
    }
  }
}

void without_a_tolerance_or_a_goal_time_nothing_is_refused(void**) {
  static ReferenceBench bench;
  fresh(bench, 0.0);
  assert_true(std::isinf(swing(bench, 1.0, 2.0, 20.0)));
  bench.params.tolerances.path.q.setZero();
  bench.params.tolerances.goal_time_s = kGoalTime_s;
  ASSERT_OK(bench.start(bench.home.q));
  assert_true(std::isinf(swing(bench, 1.0, 2.0, 20.0)));
}

void a_goal_that_pauses_is_judged_by_its_own_tolerance(void**) {
  for (const double own : {-1.0, 0.5}) {
    static ReferenceBench benches[2];
    ReferenceBench& bench = fresh(benches[own > 0.0]);
    Trajectory<JointSpace>* motion = bench.trajectory(kVelocityField);
    bench.add(*motion, 1.0, 0.2);
    motion->tolerances.path.q.setConstant(own);
    std::uint32_t id = 0, control = 0;
    assert_true(bench.client.send(*motion, id).ok());
    assert_true(std::isinf(swing(bench, 0.3, 2.0, 0.5)));
    assert_true(bench.client.pause(control).ok());
    assert_true(std::isinf(swing(bench, 0.3, 2.0, 10.0 * kGoalTime_s)));
    assert_int_equal(static_cast<int>(bench.final_of(id).outcome),
                     static_cast<int>(Outcome::kStarted));
    assert_true(bench.client.cancel(control).ok());
    assert_true(std::isfinite(swing(bench, 0.3, 2.0, 3.0 * kGoalTime_s)));
  }
}

void the_goal_time_of_a_goal_is_its_own(void**) {
  static ReferenceBench bench;
  bench.params.tolerances.goal.q.setConstant(0.01);
  bench.params.tolerances.goal_time_s = kGoalTime_s;
  ASSERT_OK(bench.start(bench.home.q));
  const std::uint32_t id = bench.go(0.2, 1.0, kVelocityField);
  int cycles = 0;
  while (bench.final_of(id).outcome == Outcome::kStarted) {
    JointSpace::Point measured = bench.out();
    measured.q[2] += 0.02;
    ASSERT_OK(bench.step(measured));
    ++cycles;
  }
  ASSERT_NEAR(cycles * ReferenceBench::kPeriod_s, 1.0 + kGoalTime_s, 0.01);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(
          a_robot_beyond_the_path_tolerance_aborts_its_goal_with_joint_value_and_limit),
      cmocka_unit_test(after_a_violation_the_reference_comes_to_rest_and_stays),
      cmocka_unit_test(an_error_that_is_nan_violates),
      cmocka_unit_test(a_goal_succeeds_only_inside_its_band),
      cmocka_unit_test(a_goal_that_is_not_reached_in_time_is_aborted_with_joint_value_and_limit),
      cmocka_unit_test(a_goal_is_reached_only_when_the_robot_has_stopped),
      cmocka_unit_test(the_dwell_time_begins_anew_whenever_the_band_is_left),
      cmocka_unit_test(the_known_latency_of_a_robot_is_no_error),
      cmocka_unit_test(a_goal_may_bring_its_own_tolerances_or_switch_them_off),
      cmocka_unit_test(of_cancels_where_a_path_has_ended_two_are_executed_and_no_more),
      cmocka_unit_test(a_goal_does_not_succeed_before_its_reference_is_there),
      cmocka_unit_test(a_swing_about_a_reference_that_rests_is_found_within_half_a_swing),
      cmocka_unit_test(a_leader_whose_points_are_noisy_hides_no_swing),
      cmocka_unit_test(a_reference_that_moves_again_in_time_is_never_refused),
      cmocka_unit_test(without_a_tolerance_or_a_goal_time_nothing_is_refused),
      cmocka_unit_test(a_goal_that_pauses_is_judged_by_its_own_tolerance),
      cmocka_unit_test(the_goal_time_of_a_goal_is_its_own),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
