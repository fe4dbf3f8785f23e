// The way of the tool tip to what it follows, and to rest: velocity, acceleration and jerk of
// translation and rotation within their limits, from any motion, and exact derivatives.
#include <algorithm>

#include "tests/reference/space/task_cases.hpp"

namespace tactus {
namespace {

const TaskLimits kLimits;

TaskPoint random_pose(RandomVectors& random) {
  TaskPoint point;
  point.x = {0.5 * random.vector(), exp_so3(1.5 * random.vector())};
  return point;
}

/// Returns a state in motion at up to `share` of the limits.
TaskPoint random_state(RandomVectors& random, double share) {
  TaskPoint point = random_pose(random);
  const auto size = [&] { return share * random.between(0.0, 1.0); };
  point.v = six(size() * kLimits.v_max * random.axis(), size() * kLimits.w_max * random.axis());
  point.a = six(size() * kLimits.a_max * random.axis(), size() * kLimits.alpha_max * random.axis());
  return point;
}

void assert_length(const Vector3& vector, double limit) {
  assert_true(vector.norm() <= limit * (1.0 + 1e-9) + 1e-12);
}

/// Asserts that in one period from a to b every length is within its limit, and that the state
/// changes as its derivatives say, up to what jerk can do within the period.
void assert_within_limits(const TaskPoint& a, const TaskPoint& b, double dt) {
  const double dt3 = dt * dt * dt, most = 1.0 + 1e-6;
  assert_length(b.v.head<3>(), kLimits.v_max);
  assert_length(b.v.tail<3>(), kLimits.w_max);
  assert_length(b.a.head<3>(), kLimits.a_max);
  assert_length(b.a.tail<3>(), kLimits.alpha_max);
  assert_length((b.a - a.a).head<3>(), kLimits.j_max * dt * most);
  assert_length((b.a - a.a).tail<3>(), kLimits.dalpha_max * dt * most);
  const Vector6 mean = 0.5 * dt * (a.v + b.v);
  assert_length(b.x.p - a.x.p - mean.head<3>(),
                0.25 * dt * dt * dt * kLimits.j_max + dt * dt / 6.0 * kLimits.a_max);
  const Vector3 turned = log_so3(b.x.r * a.x.r.conjugate());
  assert_length(turned - mean.tail<3>(),
                dt3 * (kLimits.dalpha_max + kLimits.w_max * kLimits.alpha_max) +
                    dt * dt / 6.0 * kLimits.alpha_max);
}

TaskPoint next_towards(const TaskPoint& reference, const TaskPoint& place, double dt) {
  TaskSpace::Difference offset = TaskSpace::difference(reference, place);
  return offset.zero() ? place
                       : TaskSpace::approach(reference, offset, place, place, false, kLimits, dt);
}

int cycles_to(const TaskPoint& place, TaskPoint point, double dt) {
  int cycles = 0;
  while (cycles * dt < 20.0 && !TaskSpace::difference(point, place).zero()) {
    const TaskPoint before = point;
    point = next_towards(before, place, dt);
    assert_within_limits(before, point, dt);
    ++cycles;
  }
  assert_true(cycles * dt < 20.0);
  return cycles;
}

// Proves RG-4, RG-10, RG-11, RG-12.

void sum_undoes_difference(void**) {
  over_task_ends(3.0, [](const TaskEnds& ends) {
    const TaskPoint& a = ends.to;
    const TaskPoint again = TaskSpace::sum(ends.from, TaskSpace::difference(a, ends.from));
    assert_close(again.x.p, a.x.p, 1e-15);
    ASSERT_NEAR(angle_between(again.x.r, a.x.r), 0.0, 1e-14);
    ASSERT_NEAR((again.v - a.v).norm() * ends.T, 0.0, 1e-12);
    ASSERT_NEAR((again.a - a.a).norm() * ends.T * ends.T, 0.0, 1e-11);
    assert_true(again.h == ends.from.h && again.dh == ends.from.dh);
  });
}

void from_any_motion_any_pose_is_reached(void**) {
  RandomVectors random;
  for (const double dt : {1e-3, 2e-3, 8e-3})
    for (int trial = 0; trial < 60; ++trial)
      cycles_to(random_pose(random), random_state(random, 0.9), dt);
}

void from_rest_the_way_is_straight_and_as_short_as_the_limits_allow(void**) {
  RandomVectors random;
  for (int trial = 0; trial < 100; ++trial) {
    const TaskPoint from = random_pose(random), to = random_pose(random);
    const double way = (to.x.p - from.x.p).norm(), angle = angle_between(from.x.r, to.x.r);
    const double v = std::min(kLimits.v_max / way, kLimits.w_max / angle);
    const double a = std::min(kLimits.a_max / way, kLimits.alpha_max / angle);
    const double j = std::min(kLimits.j_max / way, kLimits.dalpha_max / angle);
    const double optimum = plan_to({}, 1.0, 0.0, {-v, v, a, a, j}).duration();
    ASSERT_NEAR(cycles_to(to, from, 1e-3) * 1e-3, optimum, 3e-3);
  }
}

void every_stop_comes_to_rest_on_a_line(void**) {
  RandomVectors random;
  for (const double dt : {1e-3, 8e-3}) {
    for (int trial = 0; trial < 200; ++trial) {
      TaskPoint point = random_state(random, 0.95);
      int cycles = 0;
      for (; cycles < 5000 && !point.standing(); ++cycles) {
        const TaskPoint before = point;
        point = TaskSpace::come_to_rest(before, kLimits, dt);
        assert_within_limits(before, point, dt);
      }
      const double slowest =
          std::max(kLimits.v_max / kLimits.a_max + kLimits.a_max / kLimits.j_max,
                   kLimits.w_max / kLimits.alpha_max + kLimits.alpha_max / kLimits.dalpha_max);
      assert_true(cycles * dt <= 1.5 * slowest + 2.0 * dt);
    }
  }
}

/// Returns a point of a motion around a tilted circle, with a rotation about another axis, at
/// `share` of the limits.
TaskPoint circling(double t, double share) {
  const double w = share * std::min(kLimits.w_max, std::sqrt(kLimits.alpha_max));
  const double r = 0.5 * share * std::min(kLimits.v_max / w, kLimits.a_max / (w * w));
  const Vector3 x = Vector3(1.0, 0.0, 0.3).normalized(), y = Vector3::UnitY();
  const double s = std::sin(w * t), c = std::cos(w * t);
  TaskPoint point;
  point.x = {r * (c * x + s * y), exp_so3(w * t * Vector3::UnitZ())};
  point.v = six(r * w * (c * y - s * x), w * Vector3::UnitZ());
  point.a = six(-r * w * w * (c * x + s * y), Vector3::Zero());
  return point;
}

void a_moving_base_is_joined_within_the_limits_of_the_sum(void**) {
  RandomVectors random;
  const double dt = 1e-3;
  for (const double share : {0.1, 0.3, 0.5}) {
    for (int trial = 0; trial < 20; ++trial) {
      TaskPoint point = random_state(random, 0.5);
      TaskSpace::Difference offset = TaskSpace::difference(point, circling(0.0, share));
      int cycles = 0;
      for (; cycles < 20000 && !offset.zero(); ++cycles) {
        const TaskPoint before = point, base = circling(cycles * dt, share),
                        next = circling((cycles + 1) * dt, share);
        point = TaskSpace::approach(before, offset, base, next, false, kLimits, dt);
        assert_within_limits(before, point, dt);
      }
      assert_true(cycles < 20000);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(sum_undoes_difference),
      cmocka_unit_test(from_any_motion_any_pose_is_reached),
      cmocka_unit_test(from_rest_the_way_is_straight_and_as_short_as_the_limits_allow),
      cmocka_unit_test(every_stop_comes_to_rest_on_a_line),
      cmocka_unit_test(a_moving_base_is_joined_within_the_limits_of_the_sum),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
