// Open trajectories in the worst order of requests: the reference stays within limits, moves
// without a break, and never passes the last waypoint sent.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;
constexpr Fields kQuintic = kVelocityField | kAccelerationField;

/// Steps one cycle: no limit is exceeded, and the position changes as the velocities say.
void step(ReferenceBench& bench) {
  const JointLimits& limits = bench.channel.settings.limits;
  const JointSpace::Point before = bench.out();
  ASSERT_OK(bench.step());
  const JointSpace::Point& now = bench.out();
  for (int j = 0; j < kDof; ++j) {
    assert_true(std::fabs(now.dq[j]) <= limits.dq_max[j] * (1.0 + 1e-9));
    assert_true(std::fabs(now.ddq[j]) <= limits.ddq_max[j] * (1.0 + 1e-9));
    const double mean = 0.5 * (before.dq[j] + now.dq[j]);
    ASSERT_NEAR(now.q[j] - before.q[j], mean * kPeriod_s,
                0.5 * limits.ddq_max[j] * kPeriod_s * kPeriod_s);
  }
}

/// Returns a waypoint of a motion of all joints from rest at constant acceleration, a share of the
/// smallest limit.
Waypoint<JointSpace> speeding_up(const ReferenceBench& bench, double time_s, double share) {
  const double a = share * bench.channel.settings.limits.ddq_max.minCoeff();
  Waypoint<JointSpace> waypoint;
  waypoint.time_s = time_s;
  waypoint.point.q = bench.home.q + JointVector::Constant(0.5 * a * time_s * time_s);
  waypoint.point.dq.setConstant(a * time_s);
  return waypoint;
}

// Proves RG-14, RG-11.

void an_append_while_the_rate_goes_to_zero_leaves_the_rate_where_it_belongs(void**) {
  for (int cycles = 1; cycles < 60; cycles += 3) {
    ReferenceBench bench;
    Report report;
    Trajectory<JointSpace>* stream = bench.trajectory(kQuintic);
    stream->open = true;
    bench.add(*stream, 0.0, 0.0);
    bench.add(*stream, 1.0, 0.01);
    std::uint32_t id = 0;
    assert_true(bench.client.send(*stream, id).ok());
    for (int k = 0; k < 300; ++k) step(bench);
    assert_true(bench.client.set_override(0.0, id).ok());
    for (int k = 0; k < cycles; ++k) step(bench);
    Waypoint<JointSpace> next;
    next.time_s = 1.4;
    next.point.q = bench.home.q + JointVector::Constant(0.2);
    ASSERT_OK(bench.client.append(*stream, next).status);
    ASSERT_OK(bench.client.flush(*stream, true, id).status);
    assert_true(bench.client.set_override(0.0, id).ok());
    for (int k = 0; k < 500; ++k) step(bench);
    assert_true(bench.out().standing());
    assert_true(bench.out().q[0] - bench.home.q[0] <= 0.01);
    assert_true(bench.client.set_override(1.0, id).ok());
    for (int k = 0; k < 3000; ++k) {
      step(bench);
      static_cast<void>(bench.client.poll(report));
    }
    ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.2, 1e-9);
  }
}

void a_first_part_shorter_than_a_stop_is_begun_as_slowly_as_it_takes(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* stream = bench.trajectory(kVelocityField);
  stream->open = true;
  stream->waypoints[0] = speeding_up(bench, 0.0, 0.9);
  stream->waypoints[1] = speeding_up(bench, 0.15, 0.9);
  stream->count = 2;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*stream, id).ok());
  for (int k = 0; k < 1000; ++k) step(bench);
  const double end = stream->waypoints[1].point.q[0];
  assert_true(bench.out().standing() && bench.out().q[0] < end);
  assert_true(bench.out().q[0] - bench.home.q[0] > 0.9 * (end - bench.home.q[0]));
  ASSERT_OK(bench.client.append(*stream, speeding_up(bench, 0.25, 0.9)).status);
  Waypoint<JointSpace> last = speeding_up(bench, 0.25, 0.9);
  last.time_s = 0.75;
  last.point.q.array() += 0.25 * last.point.dq[0];
  last.point.dq.setZero();
  ASSERT_OK(bench.client.append(*stream, last).status);
  ASSERT_OK(bench.client.flush(*stream, true, id).status);
  Report report;
  for (int k = 0; k < 3000; ++k) {
    step(bench);
    static_cast<void>(bench.client.poll(report));
  }
  ASSERT_NEAR(bench.out().q[0], last.point.q[0], 1e-9);
}

/// Returns the cycles until the reference is at rest after a pause, on a slow path of joint 1 at
/// whose end joint 7 moves by `turn`.
int stop_cycles(double turn) {
  ReferenceBench bench;
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  bench.add(*motion, 0.0, 0.0);
  bench.add(*motion, 3.0, 0.0);
  motion->waypoints[1].point.q[0] += 0.6;
  bench.add(*motion, 3.6, 0.0);
  motion->waypoints[2].point.q = motion->waypoints[1].point.q;
  motion->waypoints[2].point.q[6] += turn;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  for (int k = 0; k < 1500; ++k) step(bench);
  assert_true(bench.client.pause(id).ok());
  int cycles = 0;
  for (; !bench.out().standing() && cycles < 3000; ++cycles) step(bench);
  return cycles;
}

// Proves RG-11.

void a_quick_segment_far_ahead_does_not_lengthen_a_stop(void**) {
  const int alone = stop_cycles(0.0);
  assert_true(alone > 5 && alone < 80);
  assert_int_equal(stop_cycles(0.75), alone);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_append_while_the_rate_goes_to_zero_leaves_the_rate_where_it_belongs),
      cmocka_unit_test(a_first_part_shorter_than_a_stop_is_begun_as_slowly_as_it_takes),
      cmocka_unit_test(a_quick_segment_far_ahead_does_not_lengthen_a_stop),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
