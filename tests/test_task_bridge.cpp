// Differences of references of the tool tip and the bridges that take them to zero: nothing steps,
// and half of every limit is left to the motion underneath.
#include <algorithm>

#include "tests/task_cases.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

using Bridge = TaskSpace::Bridge;
using Difference = TaskSpace::Difference;

constexpr double kRate = 3.0;
const TaskLimits kLimits;

/// Ends within `share` of the limits, no further apart than the arm reaches.
TaskEnds slow_ends(Random& random, int kind, double share) {
  TaskEnds ends = task_ends(random, kind, kRate);
  ends.T = 1.0;
  for (TaskPoint* point : {&ends.from, &ends.to}) {
    const double v = share * random.between(0.0, 1.0), a = share * random.between(0.0, 1.0);
    point->v = six(v * kLimits.v_max * random.axis(), v * kLimits.w_max * random.axis());
    point->a = six(a * kLimits.a_max * random.axis(), a * kLimits.alpha_max * random.axis());
  }
  return ends;
}

// Proves RG-4.

void sum_undoes_difference(void**) {
  over_task_ends(kRate, [](TaskEnds ends) {
    ends.from.dh = six({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0});
    const TaskPoint& a = ends.to;
    const TaskPoint again = TaskSpace::sum(ends.from, TaskSpace::difference(a, ends.from));
    assert_close(again.x.p, a.x.p, 1e-15);
    ASSERT_NEAR(angle_between(again.x.r, a.x.r), 0.0, 1e-14);
    ASSERT_NEAR((again.v - a.v).norm() * ends.T, 0.0, 1e-12);
    ASSERT_NEAR((again.a - a.a).norm() * ends.T * ends.T, 0.0, 1e-11);
    ASSERT_NEAR((again.h - a.h).norm() + (again.dh - a.dh).norm(), 0.0, 1e-13);
  });
}

void a_point_and_no_difference_is_the_point(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    const TaskPoint sum = TaskSpace::sum(ends.from, Difference());
    assert_true(sum.x.p == ends.from.x.p && sum.v == ends.from.v && sum.a == ends.from.a);
    ASSERT_NEAR(distance(sum.x.r, ends.from.x.r), 0.0, 1e-15);
  });
}

void a_bridge_and_a_moving_base_are_one_motion_without_a_step(void**) {
  over_task_ends(kRate, [](const TaskEnds& ends) {
    const TaskSegment base = ends.join(Interpolation::kQuintic);
    TaskPoint before = ends.to;  // where the reference was when it left for the base
    before.x.r = ends.from.x.r * exp_so3({0.5, -1.0, 1.5});
    const double T = 0.8 * ends.T;
    const Bridge bridge(TaskSpace::difference(before, ends.from), T);
    const auto reference = [&](double t) { return TaskSpace::sum(base.at(t), bridge.at(t)); };
    const TaskPoint begin = reference(0.0), end = reference(T);
    assert_close(begin.x.p, before.x.p, 1e-14);
    ASSERT_NEAR(angle_between(begin.x.r, before.x.r), 0.0, 1e-14);
    ASSERT_NEAR((begin.v - before.v).norm() * T, 0.0, 1e-11);
    ASSERT_NEAR((begin.a - before.a).norm() * T * T, 0.0, 1e-10);
    ASSERT_NEAR((begin.h - before.h).norm(), 0.0, 1e-13);
    ASSERT_NEAR((end.v - base.at(T).v).norm() * T, 0.0, 1e-11);
    ASSERT_NEAR((end.a - base.at(T).a).norm() * T * T, 0.0, 1e-10);
    ASSERT_NEAR(distance(end.x.r, base.at(T).x.r) + (end.h - base.at(T).h).norm(), 0.0, 1e-12);
    const double fast = 20.0 / T + 2.0 * fastest(base);
    for (const double share : {0.05, 0.3, 0.5, 0.8, 0.95}) {
      const double t = share * T;
      assert_derivatives([&](double dt) { return reference(t + dt); }, fast);
    }
  });
}

void the_wrench_falls_without_overshoot(void**) {
  Difference difference;
  difference.h = six({10.0, -20.0, 0.0}, {1.0, 2.0, -3.0});
  difference.dh = Vector6::Constant(1000.0);
  const Bridge bridge(difference, 0.5);
  double last = 1.0;
  for (int k = 1; k <= 100; ++k) {
    const double left = bridge.at(0.005 * k).h[1] / difference.h[1];
    assert_true(left <= last + 1e-14 && left >= -1e-14);
    last = left;
  }
  ASSERT_NEAR(last, 0.0, 1e-14);
}

// Proves RG-11.

void a_bridge_leaves_half_of_every_limit_to_the_motion_underneath(void**) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const TaskEnds ends = slow_ends(random, i, 0.0);
    TaskLimits limits = kLimits.scaled(random.between(0.1, 1.0));
    limits.alpha_max *= std::pow(10.0, -2.0 * random.between(0.0, 1.0));
    Difference difference = TaskSpace::difference(ends.to, ends.from);
    const double smaller = std::pow(10.0, -2.0 * random.between(0.0, 1.0));
    difference.p *= smaller, difference.phi *= smaller;
    const Bridge bridge(difference, TaskSpace::bridge_time_s(difference, limits));
    TaskPoint base = ends.from;  // turning as fast as the robot may
    base.v.tail<3>() = kLimits.w_max * random.axis();
    double v = 0.0, a = 0.0, w = 0.0, alpha = 0.0;
    for (int k = 0; k <= 200; ++k) {
      const TaskPoint sum = TaskSpace::sum(base, bridge.at(bridge.duration() * k / 200));
      const Vector6 dv = sum.v - base.v, da = sum.a - base.a;
      v = std::max(v, dv.head<3>().norm()), w = std::max(w, dv.tail<3>().norm());
      a = std::max(a, da.head<3>().norm()), alpha = std::max(alpha, da.tail<3>().norm());
    }
    assert_true(v <= 0.5 * limits.v_max + 1e-9 && w <= 0.5 * limits.w_max + 1e-9);
    assert_true(a <= 0.5 * limits.a_max + 1e-9 && alpha <= 0.5 * limits.alpha_max + 1e-9);
  }
}

void a_bridge_out_of_a_motion_takes_no_more_than_half_or_what_it_begins_with(void**) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    TaskEnds ends = slow_ends(random, i, 0.8);
    for (TaskPoint* point : {&ends.from, &ends.to}) point->a.setZero();
    const Difference begin = TaskSpace::difference(ends.to, ends.from);
    const Bridge bridge(begin, TaskSpace::bridge_time_s(begin, kLimits));
    const double v = std::max(0.5 * kLimits.v_max, begin.dp.norm());
    const double w = std::max(0.5 * kLimits.w_max, begin.dphi.norm()) + 0.068 * begin.ddphi.norm();
    for (int k = 0; k <= 200; ++k) {
      const Difference now = bridge.at(bridge.duration() * k / 200);
      assert_true(now.dp.norm() <= v + 1e-9 && now.dphi.norm() <= w * (1.0 + bridge.duration()));
      assert_true(now.ddp.norm() <= 0.5 * kLimits.a_max + 1e-9);
    }
  }
}

void tighter_limits_never_make_a_bridge_impossible(void**) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    TaskLimits limits = kLimits.scaled(std::pow(10.0, -3.0 * random.between(0.0, 1.0)));
    limits.alpha_max *= std::pow(10.0, -3.0 * random.between(0.0, 1.0));
    const TaskEnds ends = slow_ends(random, i, 1.0);
    const Difference difference = TaskSpace::difference(ends.to, ends.from);
    const double T = TaskSpace::bridge_time_s(difference, limits);
    assert_true(T > 0.0 && std::isfinite(T));
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(sum_undoes_difference),
      cmocka_unit_test(a_point_and_no_difference_is_the_point),
      cmocka_unit_test(a_bridge_and_a_moving_base_are_one_motion_without_a_step),
      cmocka_unit_test(the_wrench_falls_without_overshoot),
      cmocka_unit_test(a_bridge_leaves_half_of_every_limit_to_the_motion_underneath),
      cmocka_unit_test(a_bridge_out_of_a_motion_takes_no_more_than_half_or_what_it_begins_with),
      cmocka_unit_test(tighter_limits_never_make_a_bridge_impossible),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
