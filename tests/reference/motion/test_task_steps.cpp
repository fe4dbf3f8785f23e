// Straight lines of the tool tip: how much their velocities may step where they meet.
#include <array>

#include "kernel/math/so3.hpp"
#include "kernel/reference/motion/admission.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

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
      cmocka_unit_test(a_corner_steps_by_no_more_than_the_limit),
      cmocka_unit_test(a_way_begins_and_ends_with_a_step_from_rest),
      cmocka_unit_test(small_steps_in_a_row_count_as_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
