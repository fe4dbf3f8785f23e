// Stop, pause, resume and override on the path, and the limits for any request at any time.
#include <cstdlib>

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;
constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// Asserts that the reference is on its path: all joints move by the same offset from home.
void assert_on_path(const ReferenceBench& bench) {
  for (int j = 1; j < kDof; ++j)
    ASSERT_NEAR(bench.out().q[j] - bench.home.q[j], bench.out().q[0] - bench.home.q[0], 1e-12);
}

/// Steps until the reference is at rest; returns the number of cycles.
int run_to_rest(ReferenceBench& bench) {
  int cycles = 0;
  do {
    ASSERT_OK(bench.step());
    assert_on_path(bench);
    ++cycles;
  } while (!bench.out().standing() && cycles < 100000);
  return cycles;
}

// Proves RG-11.

void a_cancel_stops_on_the_path_and_gives_the_store_back_at_rest(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(0.5, 2.0, kQuintic);
  ASSERT_OK(bench.run(800));
  std::uint32_t cancel = 0;
  assert_true(bench.client.cancel(cancel).ok());
  ASSERT_OK(bench.step());
  Report report;
  assert_true(bench.client.poll(report));
  ASSERT_OUTCOME(report, Outcome::kStarted);
  assert_true(bench.client.poll(report) && report.id == id);
  ASSERT_OUTCOME(report, Outcome::kCanceled);
  assert_int_equal(report.store, -1);
  assert_true(bench.client.poll(report) && report.id == cancel);
  ASSERT_OUTCOME(report, Outcome::kExecuted);
  const int cycles = run_to_rest(bench);
  assert_true(cycles > 10 && cycles < 1000);
  assert_true(bench.client.poll(report));
  ASSERT_OUTCOME(report, Outcome::kReleased);
  assert_int_equal(report.store, 0);
  assert_true(bench.out().q[0] - bench.home.q[0] < 0.5);
}

void a_pause_keeps_the_trajectory_and_a_resume_finishes_it(void**) {
  static ReferenceBench bench;
  const std::uint32_t id = bench.go(0.5, 2.0, kQuintic);
  ASSERT_OK(bench.run(800));
  std::uint32_t request = 0;
  assert_true(bench.client.pause(request).ok());
  run_to_rest(bench);
  const double paused_at = bench.out().q[0];
  ASSERT_OK(bench.run(500));
  assert_true(bench.out().q[0] == paused_at);
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kStarted);
  assert_true(bench.client.resume(request).ok());
  ASSERT_OK(bench.run(3000));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.5, 1e-12);
}

void a_paused_arm_takes_a_trajectory_and_does_not_move(void**) {
  static ReferenceBench bench;
  std::uint32_t request = 0;
  assert_true(bench.client.pause(request).ok());
  const std::uint32_t id = bench.go(0.5, 2.0, kQuintic);
  ASSERT_OK(bench.run(3000));
  assert_true(bench.out().q == bench.home.q);
  assert_true(bench.client.resume(request).ok());
  ASSERT_OK(bench.run(2500));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

void at_any_rate_a_trajectory_whose_first_waypoint_moves_is_joined_without_a_step(void**) {
  static ReferenceBench benches[3];
  for (const int half : {0, 1, 2}) {
    ReferenceBench& bench = benches[half];
    std::uint32_t id = 0;
    assert_true(bench.client.set_override(0.5 * half, id).ok());
    Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
    bench.add(*motion, 0.0, 0.0, 0.3);
    bench.add(*motion, 1.0, 0.2);
    assert_true(bench.client.send(*motion, id).ok());
    for (int k = 0; k < 100; ++k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      const JointLimits& limits = bench.channel.settings.limits;
      ASSERT_NEAR(bench.out().ddq[0], before.ddq[0], limits.dddq_max[0] * kPeriod_s * 1.05);
      ASSERT_NEAR(bench.out().dq[0], before.dq[0], limits.ddq_max[0] * kPeriod_s * 1.0025);
    }
  }
}

void at_half_override_a_trajectory_takes_twice_its_time(void**) {
  static ReferenceBench full, half;
  std::uint32_t request = 0;
  assert_true(half.client.set_override(0.5, request).ok());
  assert_true(full.go(0.5, 2.0, kQuintic) != 0);
  ASSERT_OK(half.step());
  const std::uint32_t id = half.go(0.5, 2.0, kQuintic);
  ASSERT_OK(full.run(1001));
  int cycles = 0;
  for (; half.final_of(id).outcome == Outcome::kStarted && cycles < 10000; ++cycles)
    ASSERT_OK(half.step());
  assert_true(cycles > 3990 && cycles < 4010);
}

void an_override_scales_velocity_once_and_acceleration_twice(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* line = bench.trajectory(0);
  bench.add(*line, 10.0, 0.5);
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok() && bench.client.set_override(0.25, id).ok());
  ASSERT_OK(bench.run(2000));
  ASSERT_NEAR(bench.out().dq[0], 0.25 * 0.05, 1e-12);
  ASSERT_NEAR(bench.out().ddq[0], 0.0, 1e-12);
}

void an_override_that_is_no_fraction_is_refused(void**) {
  static ReferenceBench bench;
  for (const double rate : {-0.1, 1.1, static_cast<double>(NAN), kInfinity}) {
    std::uint32_t id = 0;
    assert_true(bench.client.set_override(rate, id).ok());
    ASSERT_OK(bench.step());
    const Report report = bench.final_of(id);
    ASSERT_OUTCOME(report, Outcome::kRefused);
    ASSERT_STATUS(report.verdict.status, Status::kBadOverride);
  }
}

/// Requests of the property below.
constexpr int kRequests = tries(10000, 2000);

std::uint32_t ask_something(ReferenceBench& bench, Random& random, Fields fields) {
  std::uint32_t id = 0;
  switch (random.below(6)) {
    case 0: return bench.client.cancel(id).ok();
    case 1: return bench.client.set_override(random.uniform(0.0, 1.0), id).ok();
    case 2: return (random.below(2) != 0 ? bench.client.pause(id) : bench.client.resume(id)).ok();
    default: break;
  }
  Trajectory<JointSpace>* motion = bench.trajectory(fields);
  if (motion == nullptr) return 0;
  double time_s = 0.0;
  for (int i = 1 + random.below(4); i > 0; --i) {
    time_s += random.uniform(0.5, 1.5);
    bench.add(*motion, time_s, random.uniform(-0.5, 0.5), i > 1 ? random.uniform(-0.3, 0.3) : 0.0);
  }
  return bench.client.send(*motion, id).ok() ? id : 0;
}

/// Asserts that the reference moves from `before` to `after` in one period within its limits and
/// without a step. Between two samples acceleration and jerk may slightly exceed those at samples.
void assert_within_limits(const JointSpace::Point& before, const JointSpace::Point& after,
                          const JointLimits& limits, bool smooth) {
  constexpr double kOver = 1.0 + 1e-9, kBetween = 1.0 + 1e-3;
  for (int j = 0; j < kDof; ++j) {
    assert_true(after.q[j] <= limits.q_max[j] && after.q[j] >= limits.q_min[j]);
    assert_true(std::abs(after.dq[j]) <= limits.dq_max[j] * kOver);
    assert_true(std::abs(after.ddq[j]) <= limits.ddq_max[j] * kOver);
    ASSERT_NEAR(after.q[j], before.q[j], limits.dq_max[j] * kPeriod_s * kOver);
    ASSERT_NEAR(after.dq[j], before.dq[j], limits.ddq_max[j] * kPeriod_s * kBetween);
    if (smooth) ASSERT_NEAR(after.ddq[j], before.ddq[j], limits.dddq_max[j] * kPeriod_s * 1.05);
  }
}

void stay_within_limits(Fields fields) {
  static ReferenceBench benches[2];
  ReferenceBench& bench = benches[fields == kQuintic];
  Random random{20261121};
  int started = 0;
  ASSERT_OK(bench.step());
  for (int request = trials(kRequests); request > 0; --request) {
    ask_something(bench, random, fields);
    for (int k = 1 + random.below(600); k > 0; --k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      assert_within_limits(before, bench.out(), bench.channel.settings.limits, fields == kQuintic);
    }
    Report report;
    while (bench.client.poll(report)) started += report.outcome == Outcome::kStarted;
  }
  assert_true(started > trials(kRequests) / 8);
}

void no_request_at_any_instant_of_a_quintic_breaks_a_limit(void**) {
  stay_within_limits(kQuintic);
}

void no_request_at_any_instant_of_a_cubic_breaks_a_limit(void**) {
  stay_within_limits(kVelocityField);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cancel_stops_on_the_path_and_gives_the_store_back_at_rest),
      cmocka_unit_test(a_pause_keeps_the_trajectory_and_a_resume_finishes_it),
      cmocka_unit_test(a_paused_arm_takes_a_trajectory_and_does_not_move),
      cmocka_unit_test(
          at_any_rate_a_trajectory_whose_first_waypoint_moves_is_joined_without_a_step),
      cmocka_unit_test(at_half_override_a_trajectory_takes_twice_its_time),
      cmocka_unit_test(an_override_scales_velocity_once_and_acceleration_twice),
      cmocka_unit_test(an_override_that_is_no_fraction_is_refused),
      cmocka_unit_test(no_request_at_any_instant_of_a_quintic_breaks_a_limit),
      cmocka_unit_test(no_request_at_any_instant_of_a_cubic_breaks_a_limit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
