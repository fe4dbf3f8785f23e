// A robot that is not kept where its reference rests: found after the goal time, and only then.
#include <cmath>
#include <vector>

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr double kTolerance_rad = 0.05, kGoalTime_s = 0.5;
constexpr double kSlowing_s = 0.3;  // of the slowest motion here, from the band to rest

ReferenceBench& fresh(ReferenceBench& bench, double goal_time_s = kGoalTime_s) {
  bench.params.tolerances = {};
  bench.params.tolerances.path.q.setConstant(kTolerance_rad);
  bench.params.tolerances.goal_time_s = goal_time_s;
  ASSERT_OK(bench.start(bench.home));
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
    const Status status = bench.step_measured(measured);
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
  point.q = bench.home;
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
      point.q = bench.home + JointVector::Constant(i % 2 == 0 ? 0.02 : -0.02);
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
  ASSERT_OK(bench.start(bench.home));
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
  ASSERT_OK(bench.start(bench.home));
  const std::uint32_t id = bench.go(0.2, 1.0, kVelocityField);
  int cycles = 0;
  while (bench.final_of(id).outcome == Outcome::kStarted) {
    JointSpace::Point measured = bench.out();
    measured.q[2] += 0.02;
    ASSERT_OK(bench.step_measured(measured));
    ++cycles;
  }
  ASSERT_NEAR(cycles * ReferenceBench::kPeriod_s, 1.0 + kGoalTime_s, 0.01);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_swing_about_a_reference_that_rests_is_found_within_half_a_swing),
      cmocka_unit_test(a_leader_whose_points_are_noisy_hides_no_swing),
      cmocka_unit_test(a_reference_that_moves_again_in_time_is_never_refused),
      cmocka_unit_test(without_a_tolerance_or_a_goal_time_nothing_is_refused),
      cmocka_unit_test(a_goal_that_pauses_is_judged_by_its_own_tolerance),
      cmocka_unit_test(the_goal_time_of_a_goal_is_its_own),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
