// Paths of straight lines under any request at any time: the position never steps, the velocity
// only where lines meet.
// Straight lines of the tool tip: how much their velocities may step where they meet.
#include <array>

#include "kernel/math/so3.hpp"
#include "kernel/reference/motion/admission.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// The corners of all trajectories sent: joint 0's offsets from home.
struct Corners {
  std::array<double, 4096> offsets{};
  int count = 0;
  void add(double offset) { offsets[static_cast<std::size_t>(count++)] = offset; }
  /// True if there is a corner between a and b, or no more than `margin` beyond.
  bool between(double a, double b, double margin) const {
    for (int i = 0; i < count; ++i) {
      const double corner = offsets[static_cast<std::size_t>(i)];
      if (corner >= std::min(a, b) - margin && corner <= std::max(a, b) + margin) return true;
    }
    return false;
  }
};

void send_lines(ReferenceBench& bench, Random& random, Corners& corners) {
  Trajectory<JointSpace>* lines = bench.trajectory(0);
  if (lines == nullptr) return;
  double time_s = 0.0;
  std::array<double, 4> offsets{};
  for (double& offset : offsets) {
    time_s += random.uniform(0.8, 2.0);
    offset = random.uniform(-0.2, 0.2);
    bench.add(*lines, time_s, offset);
  }
  std::uint32_t id = 0;
  if (!bench.client.send(*lines, id).ok()) return;
  for (const double offset : offsets) corners.add(offset);
}

void ask(ReferenceBench& bench, Random& random, Corners& corners) {
  std::uint32_t id = 0;
  switch (random.below(8)) {
    case 0: return static_cast<void>(bench.client.cancel(id));
    case 1: return static_cast<void>(bench.client.set_override(random.uniform(0.0, 1.0), id));
    case 2: return static_cast<void>(bench.client.pause(id));
    case 3:
    case 4: return static_cast<void>(bench.client.resume(id));
    default: return send_lines(bench, random, corners);
  }
}

// Proves RG-11.

void the_position_never_steps_and_the_velocity_only_at_waypoints(void**) {
  static ReferenceBench bench;
  static Corners corners;
  Random random{31};
  const JointLimits& limits = bench.channel.settings.limits;
  int steps = 0;
  bool beginning = false;
  for (int request = 0; request < 2000; ++request) {
    ask(bench, random, corners);
    const int cycles = 1 + random.below(800);
    for (int k = 0; k < cycles; ++k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      const JointSpace::Point& now = bench.out();
      const double moved = std::abs(now.q[0] - before.q[0]), dq = now.dq[0] - before.dq[0];
      const double fastest = std::max(std::abs(now.dq[0]), std::abs(before.dq[0]));
      assert_true(moved <= fastest * kPeriod_s + 4e-6);  // a dt^2 / 4 between two samples
      const double from = before.q[0] - bench.home.q[0], to = now.q[0] - bench.home.q[0];
      const bool stepped = std::abs(dq) > limits.ddq_max[0] * kPeriod_s * (1.0 + 1e-9);
      assert_true(!stepped || beginning || corners.between(from, to, fastest * kPeriod_s + 1e-9));
      assert_true(std::abs(dq) <= limits.velocity_step[0] + limits.ddq_max[0] * kPeriod_s);
      steps += stepped;
      Report report;  // the first line begins in the cycle after its trajectory is taken
      beginning = false;
      while (bench.client.poll(report)) beginning |= report.outcome == Outcome::kStarted;
    }
  }
  assert_true(steps > 100 && corners.count < 4096);
}

constexpr int kMost = 8;

/// Lines one after the other from a pose in front of the arm, each at a velocity of its own.
struct Lines {
  AdmissionSettings<TaskSpace> settings;
  std::array<Waypoint<TaskSpace>, kMost> waypoints;
  Trajectory<TaskSpace> trajectory;

  Lines() {
    settings.period_s = 1e-3;
    trajectory.waypoints = waypoints.data();
    trajectory.capacity = kMost;
    trajectory.count = 1;
    waypoints[0].point.x = {{0.4, 0.1, 0.5}, exp_so3({3.0, 0.2, -0.1})};
  }
  /// `v` m/s and `w` rad/s, base axes.
  void add(double time_s, const Vector3& v, const Vector3& w) {
    const Waypoint<TaskSpace>& last = waypoints[static_cast<std::size_t>(trajectory.count - 1)];
    Waypoint<TaskSpace>& next = waypoints[static_cast<std::size_t>(trajectory.count++)];
    next = last;
    next.time_s += time_s;
    next.point.x.p += time_s * v;
    next.point.x.r = exp_so3(time_s * w) * last.point.x.r;
  }
  Verdict judge() { return admit(trajectory, settings); }
};

constexpr double kLine_s = 0.5;  // long enough for a step to be forgotten

// Proves RG-6.

/// Out of rest, round a corner and to rest again, moving or turning; the corner is sharper by
/// sqrt(2) than either.
void a_corner_steps_by_no_more_than_the_limit(void**) {
  for (const bool turns : {false, true}) {
    for (const double share : {0.7, 0.72, 0.99}) {
      Lines lines;
      const TaskLimits& limits = lines.settings.limits;
      const double step = turns ? limits.w_step : limits.v_step;
      const Vector3 first = share * step * Vector3::UnitX(),
                    second = share * step * Vector3::UnitY();
      for (const Vector3& along : {first, second})
        lines.add(kLine_s, turns ? Vector3(Vector3::Zero()) : along,
                  turns ? along : Vector3(Vector3::Zero()));
      const Verdict verdict = lines.judge();
      if (share < std::sqrt(0.5)) {
        assert_true(verdict.ok());
        continue;
      }
      ASSERT_STATUS(verdict.status, Status::kVelocityStep);
      assert_int_equal(verdict.waypoint, 2);
      assert_int_equal(verdict.axis, turns ? 3 : 0);
      ASSERT_NEAR(verdict.value, std::sqrt(2.0) * share * step, 1e-9);
      ASSERT_NEAR(verdict.limit, step, 0.0);
    }
  }
}

void a_way_begins_and_ends_with_a_step_from_rest(void**) {
  for (const bool turns : {false, true}) {
    Lines fast, late;
    const TaskLimits& limits = fast.settings.limits;
    const double step = turns ? limits.w_step : limits.v_step;
    const Vector3 v = turns ? Vector3::Zero() : Vector3(step * Vector3::UnitZ());
    const Vector3 w = turns ? Vector3(step * Vector3::UnitZ()) : Vector3::Zero();
    fast.add(kLine_s, 1.01 * v, 1.01 * w);
    const Verdict begins = fast.judge();
    ASSERT_STATUS(begins.status, Status::kVelocityStep);
    assert_int_equal(begins.waypoint, 1);
    late.add(kLine_s, 0.6 * v, 0.6 * w);
    late.add(kLine_s, 1.2 * v, 1.2 * w);
    const Verdict ends = late.judge();
    ASSERT_STATUS(ends.status, Status::kVelocityStep);
    assert_int_equal(ends.waypoint, 2);
    ASSERT_NEAR(ends.value, 1.2 * step, 1e-9);
  }
}

/// Steps that follow each other quickly add up, but for what acceleration takes off meanwhile.
void small_steps_in_a_row_count_as_one(void**) {
  for (const bool turns : {false, true}) {
    Lines lines;
    const TaskLimits& limits = lines.settings.limits;
    const double step = turns ? limits.w_step : limits.v_step;
    const double fades = (turns ? limits.alpha_max : limits.a_max) * 2e-3;
    for (int i = 1; i <= 5; ++i) {
      const Vector3 along = 0.3 * i * step * Vector3::UnitX();
      lines.add(2e-3, turns ? Vector3(Vector3::Zero()) : along,
                turns ? along : Vector3(Vector3::Zero()));
    }
    const Verdict verdict = lines.judge();
    ASSERT_STATUS(verdict.status, Status::kVelocityStep);
    const int steps = verdict.waypoint;
    ASSERT_NEAR(verdict.value, steps * 0.3 * step - (steps - 1) * fades, 1e-9);
    assert_true(verdict.value > step && verdict.value - 0.3 * step + fades <= step);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_position_never_steps_and_the_velocity_only_at_waypoints),
      cmocka_unit_test(a_corner_steps_by_no_more_than_the_limit),
      cmocka_unit_test(a_way_begins_and_ends_with_a_step_from_rest),
      cmocka_unit_test(small_steps_in_a_row_count_as_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
