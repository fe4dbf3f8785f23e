// Whatever takes the difference out of a replacement stays within the range of the joints, or the
// replacement is refused.
#include "tests/reference_bench.hpp"
#include "tests/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;

bool within_range(const ReferenceBench& bench) {
  const JointLimits& limits = bench.channel.settings.limits;
  return ((bench.out().q - limits.q_max).array() <= 1e-9).all() &&
         ((limits.q_min - bench.out().q).array() <= 1e-9).all();
}

/// A bench whose arm stands `room` beside the upper limits.
void stand_near_limit(ReferenceBench& bench, double room) {
  bench.home = JointLimits().q_max - JointVector::Constant(room);
  ASSERT_OK(bench.start(bench.home));
}

/// A trajectory that begins where the reference is, at rest, and stays there.
std::uint32_t stop_here(ReferenceBench& bench) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  if (motion == nullptr) return 0;
  const double offset = bench.out().q[0] - bench.home[0];
  bench.add(*motion, 0.0, offset);
  bench.add(*motion, 1.0, offset);
  std::uint32_t id = 0;
  return bench.client.send(*motion, id).ok() ? id : 0;
}

// Proves RG-11.

void a_fast_arm_near_a_limit_refuses_to_stop_at_once_and_goes_on(void**) {
  static ReferenceBench bench;
  stand_near_limit(bench, 0.6);
  const std::uint32_t going = bench.go(0.6, 0.75, kQuintic);
  ASSERT_OK(bench.run(440));
  assert_true(bench.out().dq[0] > 1.0);
  const std::uint32_t stop = stop_here(bench);
  ASSERT_OK(bench.step());
  Report report;
  assert_true(bench.client.poll(report) && bench.client.poll(report) && report.id == stop);
  assert_int_equal(static_cast<int>(report.outcome), static_cast<int>(Outcome::kRefused));
  ASSERT_STATUS(report.verdict.status, Status::kPositionLimit);
  assert_true(report.verdict.value > report.verdict.limit);
  for (int k = 0; k < 1000; ++k) {
    ASSERT_OK(bench.step());
    assert_true(within_range(bench));
  }
  assert_int_equal(static_cast<int>(bench.final_of(going).outcome),
                   static_cast<int>(Outcome::kSucceeded));
}

void with_room_to_spare_it_stops(void**) {
  static ReferenceBench bench;
  stand_near_limit(bench, 1.2);
  assert_true(bench.go(0.6, 0.75, kQuintic) != 0);
  ASSERT_OK(bench.run(440));
  const std::uint32_t stop = stop_here(bench);
  ASSERT_OK(bench.run(2000));
  assert_int_equal(static_cast<int>(bench.final_of(stop).outcome),
                   static_cast<int>(Outcome::kSucceeded));
}

void a_robot_that_stops_following_near_a_limit_is_braked_on_the_path(void**) {
  static ReferenceBench bench;
  bench.params.tolerances.path.q.setConstant(0.02);
  bench.channel.settings.limits.ddq_max.setConstant(4.0);
  stand_near_limit(bench, 0.6);
  const std::uint32_t id = bench.go(0.59, 1.2, kQuintic);
  ASSERT_OK(bench.run(720));
  JointSpace::Point stuck = bench.out();
  stuck.q.array() -= 0.03;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_OK(bench.step_measured(stuck));
    assert_true(within_range(bench));
  }
  assert_int_equal(static_cast<int>(bench.final_of(id).outcome),
                   static_cast<int>(Outcome::kAborted));
  assert_true(bench.out().standing());
  assert_true(bench.out().q[0] - bench.home[0] < 0.58);  // the path went on to 0.59
}

/// Something random: a path by way of its first waypoint or at once, a point, a cancel.
std::uint32_t ask(ReferenceBench& bench, Random& random) {
  std::uint32_t id = 0;
  const int kind = random.below(8);
  if (kind == 0) return bench.client.cancel(id).ok() ? id : 0;
  if (kind < 3) {
    JointSpace::Point point;
    point.q = bench.home + JointVector::Constant(random.uniform(-0.6, 0.2));
    return bench.client.send(point, id).ok() ? id : 0;
  }
  if (kind < 6) return stop_here(bench);
  return bench.go(random.uniform(-0.6, 0.2), random.uniform(0.5, 1.0), kQuintic);
}

void no_request_at_any_instant_leaves_the_range_of_a_joint(void**) {
  static ReferenceBench bench;
  bench.params.online = OnlineMode::kLimit;
  stand_near_limit(bench, 0.2);
  Random random{3};
  int refused = 0, executed = 0;
  for (int request = 0; request < 4000; ++request) {
    const std::uint32_t id = ask(bench, random);
    const int cycles = 1 + random.below(600);
    for (int k = 0; k < cycles; ++k) {
      ASSERT_OK(bench.step());
      assert_true(within_range(bench));
    }
    Report report;
    while (bench.client.poll(report)) {
      if (report.id != id || id == 0) continue;
      refused +=
          report.outcome == Outcome::kRefused && report.verdict.status == Status::kPositionLimit;
      executed += report.outcome == Outcome::kExecuted || report.outcome == Outcome::kStarted;
    }
  }
  assert_true(refused > 10 && executed > 1000);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_fast_arm_near_a_limit_refuses_to_stop_at_once_and_goes_on),
      cmocka_unit_test(with_room_to_spare_it_stops),
      cmocka_unit_test(a_robot_that_stops_following_near_a_limit_is_braked_on_the_path),
      cmocka_unit_test(no_request_at_any_instant_leaves_the_range_of_a_joint),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
