// The way of the joints to what they follow, and to rest: limits from any state, the time of the
// slowest joint, straight lines from rest. The optimum of one joint comes from the law of one axis,
// which is tested against tables of another library.
#include <algorithm>
#include <vector>

#include "kernel/reference/space/joint_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;
using Point = JointSpace::Point;

const JointLimits kLimits;

AxisLimits axis_limits(int j) {
  return {-kLimits.dq_max[j], kLimits.dq_max[j], kLimits.ddq_max[j], kLimits.ddq_max[j],
          kLimits.dddq_max[j]};
}

/// Returns a state from which the joints can stop inside all limits.
Point random_state(Random& random) {
  Point point;
  for (int j = 0; j < kDof; ++j) {
    bool safe = false;
    while (!safe) {
      AxisState state = {random.uniform(kLimits.q_min[j], kLimits.q_max[j]),
                         random.uniform(-1.0, 1.0) * kLimits.dq_max[j],
                         random.uniform(-1.0, 1.0) * kLimits.ddq_max[j]};
      const double run_out = state.v + 0.5 * state.a * std::abs(state.a) / kLimits.dddq_max[j];
      const AxisRange stop = stop_range(state, axis_limits(j));
      safe = std::abs(run_out) <= kLimits.dq_max[j] && stop.lowest >= kLimits.q_min[j] &&
             stop.highest <= kLimits.q_max[j];
      point.q[j] = state.p;
      point.dq[j] = state.v;
      point.ddq[j] = state.a;
    }
  }
  return point;
}

Point random_place(Random& random) {
  Point point;
  for (int j = 0; j < kDof; ++j) point.q[j] = random.uniform(kLimits.q_min[j], kLimits.q_max[j]);
  return point;
}

/// Asserts that one period from a to b keeps every limit, and that velocity and position change as
/// their derivatives say, up to a jerk that changes within the period: half its limit times dt^2
/// and a sixth times dt^3.
void assert_within_limits(const Point& a, const Point& b, double dt) {
  constexpr double kOver = 1.0 + 1e-9;
  for (int j = 0; j < kDof; ++j) {
    const double jerk = kLimits.dddq_max[j];
    assert_true(b.q[j] <= kLimits.q_max[j] + 1e-9 && b.q[j] >= kLimits.q_min[j] - 1e-9);
    assert_true(std::abs(b.dq[j]) <= kLimits.dq_max[j] * kOver);
    assert_true(std::abs(b.ddq[j]) <= kLimits.ddq_max[j] * kOver);
    ASSERT_NEAR(b.ddq[j], a.ddq[j], jerk * dt * (1.0 + 1e-7));
    ASSERT_NEAR(b.dq[j] - a.dq[j], 0.5 * dt * (a.ddq[j] + b.ddq[j]), 0.5 * jerk * dt * dt);
    ASSERT_NEAR(b.q[j] - a.q[j], 0.5 * dt * (a.dq[j] + b.dq[j]), jerk * dt * dt * dt + 1e-3 * dt);
  }
}

Point next_towards(const Point& reference, const Point& from, const Point& to, double dt) {
  JointSpace::Difference offset = JointSpace::difference(reference, from);
  return JointSpace::approach(reference, offset, from, to, false, kLimits, dt);
}

// Proves RG-4, RG-11, RG-12.

void from_any_state_any_place_is_reached_in_the_time_of_the_slowest_joint(void**) {
  Random random{20261122};
  for (const double dt : {1e-3, 2e-3, 8e-3}) {
    std::vector<double> ratios;
    for (int trial = 0; trial < 100; ++trial) {
      Point point = random_state(random);
      const Point place = random_place(random);
      double optimum = 0.0;
      for (int j = 0; j < kDof; ++j)
        optimum = std::max(optimum, plan_to({point.q[j], point.dq[j], point.ddq[j]}, place.q[j],
                                            0.0, axis_limits(j))
                                        .duration());
      int cycles = 0;
      for (; cycles < 10000 && !(point.q == place.q && point.standing()); ++cycles) {
        const Point before = point;
        point = next_towards(before, place, place, dt);
        assert_within_limits(before, point, dt);
      }
      assert_true(cycles * dt <= 1.05 * optimum + 2.0 * dt);
      ratios.push_back(cycles * dt / optimum);
    }
    std::sort(ratios.begin(), ratios.end());
    assert_true(ratios[50] < 1.005);
  }
}

/// Moves away from the goal exactly on the line to it. Joint 1 can just stop before the end of its
/// range, joint 2 has half its acceleration, so that on the line joint 1 would stop too late.
void turning_back_on_a_line_leaves_no_range(void**) {
  Point point;
  point.q = 0.5 * (kLimits.q_min + kLimits.q_max);
  point.dq[0] = 1.5;
  point.dq[1] = 1.35;
  const double a = kLimits.ddq_max[0], j = kLimits.dddq_max[0];
  point.q[0] = kLimits.q_max[0] - 0.5 * 1.5 * (1.5 / a + a / j) - 1e-6;
  point.q[1] = 0.0;
  Point place = point.at_rest();
  place.q -= 0.4 * point.dq;
  for (int cycles = 0; cycles < 5000 && point.q != place.q; ++cycles) {
    const Point before = point;
    point = next_towards(before, place, place, 1e-3);
    assert_within_limits(before, point, 1e-3);
  }
  assert_true(point.q == place.q);
}

void from_rest_the_way_is_a_straight_line(void**) {
  Random random{7};
  for (int trial = 0; trial < 100; ++trial) {
    const Point from = random_place(random), to = random_place(random);
    Point point = from;
    const JointVector way = to.q - from.q;
    for (int cycles = 0; cycles < 10000 && point.q != to.q; ++cycles) {
      point = next_towards(point, to, to, 1e-3);
      const double part = (point.q - from.q).dot(way) / way.squaredNorm();
      ASSERT_NEAR((point.q - from.q - part * way).norm(), 0.0, 1e-9);
    }
    assert_true(point.q == to.q);
  }
}

void every_stop_is_the_shortest_and_never_comes_back(void**) {
  Random random{11};
  for (int trial = 0; trial < 300; ++trial) {
    Point point = random_state(random);
    double optimum = 0.0;
    for (int j = 0; j < kDof; ++j)
      optimum = std::max(
          optimum, plan_stop({point.q[j], point.dq[j], point.ddq[j]}, axis_limits(j)).duration());
    int cycles = 0;
    for (; cycles < 5000 && !point.standing(); ++cycles) {
      const Point before = point;
      point = JointSpace::come_to_rest(before, kLimits, 1e-3);
      assert_within_limits(before, point, 1e-3);
      for (int j = 0; j < kDof; ++j) {
        // Unless the velocity that is left at zero acceleration already has the other sign.
        const double a = before.ddq[j], run_out = 0.5 * a * std::abs(a) / kLimits.dddq_max[j];
        if (before.dq[j] * (before.dq[j] + run_out) > 1e-9)
          assert_true(before.dq[j] * point.dq[j] >= 0.0);
      }
    }
    assert_true(cycles * 1e-3 <= optimum + 2e-3);
  }
}

/// Returns a sum of sines that uses `share` of each limit.
Point moving(double t, double share, double w) {
  Point point;
  for (int j = 0; j < kDof; ++j) {
    const double a = share * std::min({kLimits.dq_max[j] / w, kLimits.ddq_max[j] / (w * w),
                                       kLimits.dddq_max[j] / (w * w * w),
                                       0.3 * (kLimits.q_max[j] - kLimits.q_min[j])});
    point.q[j] = 0.5 * (kLimits.q_min[j] + kLimits.q_max[j]) + a * std::sin(w * t + j);
    point.dq[j] = a * w * std::cos(w * t + j);
    point.ddq[j] = -a * w * w * std::sin(w * t + j);
  }
  return point;
}

void a_moving_base_is_joined_within_the_limits_of_the_sum(void**) {
  Random random{13};
  for (const double dt : {1e-3, 8e-3}) {
    for (int trial = 0; trial < 60; ++trial) {
      const double w = random.uniform(0.5, 6.0), share = random.uniform(0.1, 0.9);
      Point point = random_state(random);
      JointSpace::Difference offset = JointSpace::difference(point, moving(0.0, share, w));
      int cycles = 0;
      for (; cycles * dt < 20.0 && !offset.zero(); ++cycles) {
        const Point before = point, base = moving(cycles * dt, share, w),
                    next = moving((cycles + 1) * dt, share, w);
        point = JointSpace::approach(before, offset, base, next, false, kLimits, dt);
        assert_within_limits(before, point, dt);
      }
      assert_true(cycles * dt < 20.0);
      assert_true(point.q == moving(cycles * dt, share, w).q);
    }
  }
}

/// Returns the earliest time at which every joint by itself could meet the base at its velocity.
double least_meeting_s(const Point& from, double share, double w) {
  double least_s = 0.0;
  for (int j = 0; j < kDof; ++j) {
    const AxisState state = {from.q[j], from.dq[j], from.ddq[j]};
    const auto late = [&](double t) {
      const Point base = moving(t, share, w);
      return plan_to(state, base.q[j], base.dq[j], axis_limits(j)).duration() > t;
    };
    double t = 0.0;
    while (t < 10.0 && late(t)) t += 2e-3;
    least_s = std::max(least_s, t);
  }
  return least_s;
}

void a_base_that_uses_60_percent_of_the_limits_is_joined_in_about_the_least_time(void**) {
  constexpr double kDt = 1e-3, kShare = 0.6;
  Random random{14};
  std::vector<double> ratios;
  for (int trial = 0; trial < 200; ++trial) {
    const double w = random.uniform(0.5, 6.0);
    Point point = random_state(random);
    const double least_s = least_meeting_s(point, kShare, w);
    JointSpace::Difference offset = JointSpace::difference(point, moving(0.0, kShare, w));
    int cycles = 0;
    for (; cycles * kDt < 20.0 && !offset.zero(); ++cycles)
      point = JointSpace::approach(point, offset, moving(cycles * kDt, kShare, w),
                                   moving((cycles + 1) * kDt, kShare, w), false, kLimits, kDt);
    ratios.push_back(cycles * kDt / least_s);
  }
  std::sort(ratios.begin(), ratios.end());
  print_message("median %.3f, worst %.3f of the least time\n", ratios[ratios.size() / 2],
                ratios.back());
  assert_true(ratios[ratios.size() / 2] <= 1.05 && ratios.back() <= 2.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(from_any_state_any_place_is_reached_in_the_time_of_the_slowest_joint),
      cmocka_unit_test(turning_back_on_a_line_leaves_no_range),
      cmocka_unit_test(from_rest_the_way_is_a_straight_line),
      cmocka_unit_test(every_stop_is_the_shortest_and_never_comes_back),
      cmocka_unit_test(a_moving_base_is_joined_within_the_limits_of_the_sum),
      cmocka_unit_test(a_base_that_uses_60_percent_of_the_limits_is_joined_in_about_the_least_time),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
