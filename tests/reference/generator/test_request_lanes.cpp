// Order of requests: a stop waits for nothing, and if several points arrive, only the newest
// counts.
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

/// Sends sixteen points, of which every other one is far away.
void fill_with_points(CheckedJoints& bench) {
  for (int i = 0; i < 16; ++i) {
    JointSpace::Point point = bench.home;
    point.q[0] += i % 2 == 0 ? 0.5 : -0.5;
    if (bench.send(point) == 0) return;
  }
}

/// Asserts that `id` has been reported in this cycle, with this outcome.
void assert_told_now(CheckedJoints& bench, std::uint32_t id, Outcome outcome) {
  assert_int_not_equal(id, 0);
  const Report report = bench.report_of(id);
  assert_int_equal(report.id, id);
  ASSERT_STATUS(report.outcome, outcome);
  ASSERT_NEAR(report.time_s, bench.generator.time_s(), 1e-9);
}

/// Sends a motion of joint 1 that lasts for 2 s.
std::uint32_t set_off(CheckedJoints& bench) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  JointSpace::Point point = bench.home;
  point.q[0] += 1.0;
  bench.add(*motion, 2.0, point);
  return bench.send(*motion);
}

/// Sends requests that are refused with a report until no more can be sent; fetches no report.
void leave_reports(CheckedJoints& bench, const Trajectory<JointSpace>& closed) {
  std::uint32_t id = 0;
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(bench.client.flush(closed, false, id));
    bench.cycle();
  }
}

constexpr double kPeriods_s[] = {1e-3, 8e-3};

// Proves RG-23.

void a_pause_takes_effect_in_the_next_cycle_whatever_waits(void**) {
  for (const double period_s : kPeriods_s) {
    CheckedJoints bench(period_s);
    bench.cycle();
    fill_with_points(bench);
    const std::uint32_t id = bench.pause();
    bench.cycle();
    assert_told_now(bench, id, Outcome::kExecuted);
  }
}

void an_override_takes_effect_in_the_next_cycle_whatever_waits(void**) {
  for (const double period_s : kPeriods_s) {
    CheckedJoints bench(period_s);
    bench.cycle();
    fill_with_points(bench);
    const std::uint32_t id = bench.set_override(0.5);
    bench.cycle();
    assert_told_now(bench, id, Outcome::kExecuted);
  }
}

void a_cancel_takes_effect_in_the_next_cycle_whatever_waits(void**) {
  for (const double period_s : kPeriods_s) {
    CheckedJoints bench(period_s);
    assert_int_not_equal(set_off(bench), 0);
    bench.run(0.5);
    fill_with_points(bench);
    const std::uint32_t id = bench.cancel();
    bench.cycle();
    assert_told_now(bench, id, Outcome::kExecuted);
  }
}

/// Each trajectory takes a cycle; one in the mailbox must not delay a pause of the running one.
void a_pause_of_what_runs_does_not_wait_for_what_is_sent(void**) {
  CheckedJoints bench(8e-3);
  assert_int_not_equal(set_off(bench), 0);
  bench.run(0.5);
  assert_int_not_equal(set_off(bench), 0);
  assert_int_not_equal(set_off(bench), 0);
  const std::uint32_t id = bench.pause();
  bench.cycle();
  assert_told_now(bench, id, Outcome::kExecuted);
}

void a_client_that_fetches_no_reports_can_stop_the_arm(void**) {
  const auto cancels = [](CheckedJoints& bench) { return bench.cancel(); };
  const auto pauses = [](CheckedJoints& bench) { return bench.pause(); };
  const auto overrides = [](CheckedJoints& bench) { return bench.set_override(0.0); };
  std::uint32_t (*const stops[])(CheckedJoints&) = {cancels, pauses, overrides};
  for (const auto& stop : stops) {
    CheckedJoints bench;
    assert_int_not_equal(set_off(bench), 0);
    bench.run(0.5);
    leave_reports(bench, bench.channel.stores[0]);
    const std::uint32_t id = stop(bench);
    assert_int_not_equal(id, 0);
    assert_true(bench.stop(1.0) < 0.5);
    assert_true(bench.out().q[0] < bench.home.q[0] + 0.9);
    bool told = false;
    for (int k = 0; k < 100; ++k) {
      told = told || bench.report_of(id).id == id;
      bench.cycle();
    }
    assert_true(told);
  }
}

void of_the_points_that_wait_the_newest_counts(void**) {
  for (const OnlineMode online : {OnlineMode::kLimit, OnlineMode::kForward}) {
    CheckedJoints bench(1e-3, online);
    std::uint32_t ids[5] = {};
    JointSpace::Point point = bench.home;
    for (std::uint32_t& id : ids) {
      point.q[0] += 0.02;
      id = bench.send(point);
      assert_int_not_equal(id, 0);
    }
    ASSERT_OK(bench.step());
    int superseded = 0;
    Outcome last = Outcome::kRefused;
    Report report;
    while (bench.client.poll(report)) {
      superseded += report.outcome == Outcome::kSuperseded && report.id != ids[4];
      if (report.id == ids[4]) last = report.outcome;
    }
    assert_int_equal(superseded, 4);
    ASSERT_STATUS(last, Outcome::kExecuted);
    for (int k = 0; k < 2000; ++k) ASSERT_OK(bench.step());
    ASSERT_NEAR(bench.out().q[0], point.q[0], 1e-9);
  }
}

/// Two points per cycle, more than any mailbox holds: none delays another.
void more_points_than_cycles_do_not_fill_the_way(void**) {
  CheckedJoints bench;
  JointSpace::Point point = bench.home;
  for (int k = 0; k < 200; ++k) {
    for (int i = 0; i < 2; ++i) {
      point.q[0] = bench.home.q[0] + 1e-4 * (2 * k + i);
      assert_int_not_equal(bench.send(point), 0);
    }
    bench.cycle();
    bench.report_of(0);
  }
  const double behind = point.q[0] - bench.out().q[0];
  print_message("%.4f rad behind 0.2 rad/s\n", behind);
  assert_true(behind < 0.2 * 0.020);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pause_takes_effect_in_the_next_cycle_whatever_waits),
      cmocka_unit_test(an_override_takes_effect_in_the_next_cycle_whatever_waits),
      cmocka_unit_test(a_cancel_takes_effect_in_the_next_cycle_whatever_waits),
      cmocka_unit_test(a_pause_of_what_runs_does_not_wait_for_what_is_sent),
      cmocka_unit_test(a_client_that_fetches_no_reports_can_stop_the_arm),
      cmocka_unit_test(of_the_points_that_wait_the_newest_counts),
      cmocka_unit_test(more_points_than_cycles_do_not_fill_the_way),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
