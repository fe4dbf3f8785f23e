// Points of the joint space, their differences, and the way to one that stands.
#include "kernel/reference/space/joint_space.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace tactus {
namespace {

using Point = JointSpace::Point;

// Proves RG-2, RG-4.

void at_a_rate_velocity_and_acceleration_are_those_of_the_chain_rule(void**) {
  Point point;
  point.q.setConstant(1.0);
  point.dq.setConstant(2.0);
  point.ddq.setConstant(3.0);
  point.tau.setConstant(4.0);
  const Point slow = point.at_rate(0.5, -0.25);  // p' r = 1, p'' r^2 + p' dr/dt = 0.75 - 0.5
  assert_true(slow.q == point.q && slow.tau == point.tau);
  ASSERT_NEAR(slow.dq[0], 1.0, 1e-15);
  ASSERT_NEAR(slow.ddq[0], 0.25, 1e-15);
}

void sum_undoes_difference(void**) {
  Point a, b;
  a.q.setConstant(3.0);
  a.dq.setConstant(4.0);
  a.ddq.setConstant(5.0);
  a.tau.setConstant(6.0);
  b.q.setConstant(1.0);
  b.dq.setConstant(1.0);
  b.ddq.setConstant(1.0);
  b.tau.setConstant(1.0);
  const JointSpace::Difference d = JointSpace::difference(a, b);
  assert_true(d.x[0] == 2.0 && d.dx[0] == 3.0 && d.ddx[0] == 4.0);
  Point again = JointSpace::sum(b, d);
  assert_true(again.q == a.q && again.dq == a.dq && again.ddq == a.ddq && again.tau == b.tau);
  JointSpace::add_effort(again, JointSpace::effort_beyond(a, b), 1.0, 0.0);
  assert_true(again.tau == a.tau);
}

void a_point_is_finite_only_if_all_its_numbers_are(void**) {
  assert_true(Point().finite());
  for (JointVector Point::*field : {&Point::q, &Point::dq, &Point::ddq, &Point::tau}) {
    for (int j = 0; j < kDof; ++j) {
      for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
        Point point;
        (point.*field)[j] = bad;
        assert_false(point.finite());
      }
    }
  }
}

// Proves MOT-4.

/// Joint 1 goes towards an end of its range so fast that its shortest stop would end a millionth of
/// a radian beyond, and a harder one, that swings back, inside; it is to stand at that end, and
/// joint 2 a little aside.
void an_approach_to_what_stands_stays_inside_the_range_where_it_can(void**) {
  const JointLimits limits;
  constexpr double kBeyond = 1e-6, kSpeed = 1.0, kPeriod_s = 1e-3;
  const double way =
      TimeOptimum({limits.dq_max[0], limits.ddq_max[0], limits.dddq_max[0]}).stopping_way(kSpeed);
  for (const double side : {1.0, -1.0}) {
    Point base, now;
    base.q = now.q = 0.5 * (limits.q_min + limits.q_max);
    const double end = side > 0.0 ? limits.q_max[0] : limits.q_min[0];
    base.q[0] = end;
    now.q[0] = end - side * (way - kBeyond);
    now.dq[0] = side * kSpeed;
    now.q[1] += 0.1;
    JointSpace::Difference offset = JointSpace::difference(now, base);
    double farthest = -1.0;
    for (int k = 0; k < 5000; ++k) {
      now = JointSpace::approach(now, offset, base, base, false, limits, kPeriod_s);
      farthest = std::max(farthest, side * (now.q[0] - end));
    }
    assert_true(offset.zero() && now.q == base.q && now.standing());
    assert_true(farthest <= 1e-9);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_a_rate_velocity_and_acceleration_are_those_of_the_chain_rule),
      cmocka_unit_test(sum_undoes_difference),
      cmocka_unit_test(a_point_is_finite_only_if_all_its_numbers_are),
      cmocka_unit_test(an_approach_to_what_stands_stays_inside_the_range_where_it_can),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
