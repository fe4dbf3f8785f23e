// Online points: shaped within limits if the mode says so, and stopped when the stream goes silent.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

void send(ReferenceBench& bench, const JointSpace::Point& point) {
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id).ok());
}

/// Returns a reference `offset` rad from home with a velocity and an effort that nothing ends.
JointSpace::Point moving_point(const ReferenceBench& bench, double offset) {
  JointSpace::Point point;
  point.q = bench.home + JointVector::Constant(offset);
  point.dq.setConstant(0.2);
  point.tau.setConstant(3.0);
  return point;
}

// Proves RG-12.

void a_limited_point_is_reached_within_limits(void**) {
  static ReferenceBench bench;
  bench.params.online = OnlineMode::kLimit;
  ASSERT_OK(bench.start(bench.home));
  const JointLimits& limits = bench.channel.settings.limits;
  Random random{5};
  for (int n = 0; n < 300; ++n) {
    JointSpace::Point point;
    point.q = bench.home + JointVector::Constant(random.uniform(-0.5, 0.5));
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
  last.q = bench.home;
  send(bench, last);
  ASSERT_OK(bench.run(3000));
  assert_true(bench.out().q == bench.home && bench.out().standing());
}

void a_stream_that_dries_up_comes_to_rest_without_a_step(void**) {
  static ReferenceBench bench;
  bench.params.timeout_s = 0.05;
  ASSERT_OK(bench.start(bench.home));
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
  ASSERT_OK(bench.start(bench.home));
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
    ASSERT_OK(b.start(b.home));
    JointSpace::Point point;
    point.q = b.home;
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_limited_point_is_reached_within_limits),
      cmocka_unit_test(a_stream_that_dries_up_comes_to_rest_without_a_step),
      cmocka_unit_test(a_stream_that_goes_on_is_not_stopped),
      cmocka_unit_test(the_effort_of_a_trajectory_is_taken_to_zero_at_its_end),
      cmocka_unit_test(a_cancel_takes_the_feed_forward_of_a_held_point_to_zero),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
