// Trajectories with a start time: they wait for it, are joined late, or are refused, and each gets
// its final report.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kCubic = kVelocityField, kQuintic = kVelocityField | kAccelerationField;
constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// Sends a quintic from rest by `offset` in two seconds that begins at `start_s`.
std::uint32_t go_at(ReferenceBench& bench, double start_s, double offset, bool joinable = true) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  if (motion == nullptr) return 0;
  bench.add(*motion, 0.0, 0.0);
  bench.add(*motion, 2.0, offset);
  motion->start_s = start_s;
  motion->joinable = joinable;
  std::uint32_t id = 0;
  return bench.client.send(*motion, id).ok() ? id : 0;
}

/// Returns the quintic from 0 to 1, from rest to rest, at the share u of its time.
double blend(double u) {
  return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
}

/// A path that oscillates, one waypoint every 20 ms: x(t) = 0.05 (1 - cos 2t)
void add_oscillation(ReferenceBench& bench, Trajectory<JointSpace>& motion) {
  constexpr int kCount = ReferenceBench::kWaypoints;
  for (int i = 0; i < kCount; ++i) {
    const double t = 3.14159265358979323846 * i / (kCount - 1);
    bench.add(motion, t, 0.05 * (1.0 - std::cos(2.0 * t)), 0.1 * std::sin(2.0 * t));
  }
  motion.waypoints[kCount - 1].point.dq.setZero();
}

// Proves RG-17.

void a_trajectory_waits_for_its_start_time_to_half_a_period(void**) {
  static ReferenceBench benches[3];
  for (ReferenceBench& bench : benches) {
    ASSERT_OK(bench.step());
    const auto which = static_cast<double>(&bench - benches);
    const std::uint32_t id = go_at(bench, 0.4997 + 3e-4 * which, 0.4);
    for (int cycle = 2; cycle <= 2000; ++cycle) {
      ASSERT_OK(bench.step());
      const double u = std::max(0.0, cycle * kPeriod_s - 0.5) / 2.0;
      ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4 * blend(u), 1e-9);
    }
    Report report;
    assert_true(bench.client.poll(report) && report.id == id);
    ASSERT_OUTCOME(report, Outcome::kScheduled);
    ASSERT_NEAR(report.time_s, 0.002, 1e-12);
    assert_true(bench.client.poll(report) && report.id == id);
    ASSERT_OUTCOME(report, Outcome::kStarted);
    ASSERT_NEAR(report.time_s, 0.5, 1e-12);
    ASSERT_OK(bench.run(600));
    ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
  }
}

void one_that_ended_in_the_past_or_begins_after_a_day_is_refused(void**) {
  static ReferenceBench bench;
  ASSERT_OK(bench.run(3000));
  for (const double start_s : {0.5, 1.0, -1.0, static_cast<double>(NAN), kInfinity, 86'403.1}) {
    const std::uint32_t id = go_at(bench, start_s, 0.4);
    ASSERT_OK(bench.step());
    const Report report = bench.final_of(id);
    ASSERT_OUTCOME(report, Outcome::kRefused);
    ASSERT_STATUS(report.verdict.status, Status::kReferenceTime);
    assert_true(report.store == 0);
    assert_true(!(report.verdict.value < 3.0) || report.verdict.value == start_s);
    ASSERT_NEAR(report.verdict.limit, report.time_s + (start_s < 3.0 ? 0.0 : 86'400.0), 1e-9);
  }
  assert_true(bench.out().q == bench.home.q);
}

void a_first_waypoint_that_is_still_ahead_is_reached_in_time(void**) {
  static ReferenceBench bench;
  ASSERT_OK(bench.run(1000));
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  bench.add(*motion, 2.0, 0.3);
  motion->start_s = 0.5;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  for (int cycle = 1001; cycle <= 2500; ++cycle) {
    ASSERT_OK(bench.step());
    const double u = (cycle - 1001) * kPeriod_s / (2.5 - 1.001);
    ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.3 * blend(u), 1e-9);
  }
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
}

void one_that_runs_already_is_joined_where_it_would_be(void**) {
  static ReferenceBench on_time, late;
  for (ReferenceBench* bench : {&on_time, &late}) {
    // The path takes 0.4 of the limit, so the reference must meet it far ahead.
    bench->channel.settings.limits.ddq_max.setConstant(0.5);
    const int cycles = bench == &late ? 400 : 1;
    ASSERT_OK(bench->run(cycles));
    Trajectory<JointSpace>* motion = bench->trajectory(kCubic);
    add_oscillation(*bench, *motion);
    motion->start_s = 0.002;
    std::uint32_t id = 0;
    assert_true(bench->client.send(*motion, id).ok());
    ASSERT_OK(bench->run(401 - cycles));
  }
  int apart = 0;
  for (int cycle = 402; cycle < 3200; ++cycle) {
    const JointSpace::Point before = late.out();
    ASSERT_OK(on_time.step());
    ASSERT_OK(late.step());
    assert_true(std::abs(late.out().q[0] - before.q[0]) < 2.0 * kPeriod_s);
    const bool here = (late.out().q - on_time.out().q).cwiseAbs().maxCoeff() < 1e-12;
    assert_true(here || cycle == 402 + apart);  // once on the path, it stays there
    apart += !here;
  }
  assert_true(apart > 10 && apart < 1000);
  ASSERT_OUTCOME(late.final_of(1), Outcome::kSucceeded);
}

/// In the nearest cycle it begins, from its first waypoint on.
void one_that_may_not_be_joined_is_refused_from_half_a_period_on(void**) {
  static ReferenceBench benches[3];
  for (const double late_s : {0.0004, 0.0006, 0.5}) {
    ReferenceBench& bench = benches[late_s < 0.0005 ? 0 : late_s < 0.1 ? 1 : 2];
    ASSERT_OK(bench.run(999));
    const std::uint32_t id = go_at(bench, 1.0 - late_s, 0.4, false);
    ASSERT_OK(bench.run(500));
    const Report report = bench.final_of(id);
    if (late_s < 0.0005) {
      ASSERT_OUTCOME(report, Outcome::kStarted);
      ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4 * blend(0.499 / 2.0), 1e-9);
      continue;
    }
    ASSERT_OUTCOME(report, Outcome::kRefused);
    ASSERT_STATUS(report.verdict.status, Status::kReferenceTime);
    assert_true(report.store == 0 && report.verdict.value == 1.0 - late_s);
    ASSERT_NEAR(report.verdict.limit, 1.0, 1e-12);
    assert_true(bench.out().q == bench.home.q);
  }
}

void one_that_is_nearly_over_is_joined_at_its_end(void**) {
  static ReferenceBench bench;
  ASSERT_OK(bench.run(1950));
  const std::uint32_t id = go_at(bench, 0.0, 0.4);
  ASSERT_OK(bench.run(2000));
  ASSERT_OUTCOME(bench.final_of(id), Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4, 1e-9);
}

// Proves RG-5, RG-17.

void a_newer_trajectory_takes_the_place_of_one_that_waits(void**) {
  static ReferenceBench bench;
  const std::uint32_t first = go_at(bench, 0.5, 0.4), second = go_at(bench, 0.6, -0.4);
  ASSERT_OK(bench.step());
  const Report report = bench.final_of(first);
  ASSERT_OUTCOME(report, Outcome::kSuperseded);
  assert_int_equal(report.store, 0);
  ASSERT_OK(bench.run(3000));
  ASSERT_OUTCOME(bench.final_of(second), Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], -0.4, 1e-9);
}

void a_cancel_ends_what_runs_and_what_waits(void**) {
  static ReferenceBench bench;
  const std::uint32_t running = bench.go(0.3, 1.0, kQuintic);
  const std::uint32_t waiting = go_at(bench, 0.9, 0.4);
  ASSERT_OK(bench.run(500));
  std::uint32_t cancel = 0;
  assert_true(bench.client.cancel(cancel).ok());
  ASSERT_OK(bench.run(2000));
  std::array<Outcome, 4> last{};
  Report report;
  while (bench.client.poll(report)) last[report.id] = report.outcome;
  assert_true(last[running] == Outcome::kCanceled && last[waiting] == Outcome::kCanceled);
  assert_true(last[cancel] == Outcome::kExecuted);
  assert_true(bench.out().q[0] - bench.home.q[0] < 0.3);
}

void points_leave_one_that_waits_alone(void**) {
  static ReferenceBench bench;
  const std::uint32_t waiting = go_at(bench, 0.5, 0.2);
  JointSpace::Point point;
  point.q = bench.home.q;
  std::uint32_t id = 0;
  for (int k = 0; k < 400; ++k) {
    assert_true(bench.client.send(point, id).ok());
    ASSERT_OK(bench.step());
    if (k == 399) break;
    Report report;
    while (bench.client.poll(report)) assert_true(report.id != waiting || k == 0);
  }
  ASSERT_OK(bench.run(2200));
  ASSERT_OUTCOME(bench.final_of(waiting), Outcome::kSucceeded);
}

void a_restart_voids_one_that_waits(void**) {
  static ReferenceBench bench;
  const std::uint32_t waiting = go_at(bench, 0.5, 0.2);
  ASSERT_OK(bench.step());
  ASSERT_OK(bench.start(bench.home.q));
  const Report report = bench.final_of(waiting);
  ASSERT_OUTCOME(report, Outcome::kAborted);
  assert_int_equal(report.store, 0);
  ASSERT_OK(bench.run(1000));
  assert_true(bench.out().q == bench.home.q);
}

void whatever_start_times_every_request_has_one_final_report(void**) {
  static ReferenceBench bench;
  static std::array<int, 4000> finals;
  finals.fill(0);
  Random random{17};
  std::uint32_t sent = 0;
  const auto collect = [&] {
    Report report;
    while (bench.client.poll(report)) {
      if (report.outcome != Outcome::kStarted && report.outcome != Outcome::kScheduled)
        ++finals[report.id];
    }
  };
  for (int k = 0; k < 40000; ++k) {
    std::uint32_t id = 0;
    if (random.below(40) == 0)
      id = go_at(bench, 1e-3 * k + random.uniform(-1.0, 2.0), random.uniform(-0.2, 0.2));
    if (random.below(200) == 0) id = bench.client.cancel(id).ok() ? id : 0;
    sent = std::max(sent, id);
    ASSERT_OK(bench.step());
    if (random.below(20) == 0) collect();
  }
  ASSERT_OK(bench.run(10000));
  collect();
  assert_true(sent > 500 && sent < finals.size());
  for (std::uint32_t id = 1; id <= sent; ++id) assert_int_equal(finals[id], 1);
  assert_non_null(bench.client.acquire());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_waits_for_its_start_time_to_half_a_period),
      cmocka_unit_test(one_that_ended_in_the_past_or_begins_after_a_day_is_refused),
      cmocka_unit_test(a_first_waypoint_that_is_still_ahead_is_reached_in_time),
      cmocka_unit_test(one_that_runs_already_is_joined_where_it_would_be),
      cmocka_unit_test(one_that_may_not_be_joined_is_refused_from_half_a_period_on),
      cmocka_unit_test(one_that_is_nearly_over_is_joined_at_its_end),
      cmocka_unit_test(a_newer_trajectory_takes_the_place_of_one_that_waits),
      cmocka_unit_test(a_cancel_ends_what_runs_and_what_waits),
      cmocka_unit_test(points_leave_one_that_waits_alone),
      cmocka_unit_test(a_restart_voids_one_that_waits),
      cmocka_unit_test(whatever_start_times_every_request_has_one_final_report),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
