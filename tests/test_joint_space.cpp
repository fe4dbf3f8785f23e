// What a reference generator knows of the joints: how long a difference takes to be bridged, how a
// path is passed at a rate. Peaks are those of the segment's polynomials, exactly.
#include "kernel/reference/joint_space.hpp"

#include <algorithm>
#include <random>

#include "tests/testing.hpp"

namespace tactus {
namespace {

using Point = JointSpace::Point;
using Segment = JointSpace::Segment;

constexpr unsigned kSeed = 20260302;
constexpr int kTrials = 2000;
const JointLimits kLimits;
const JointVector kMiddle = 0.5 * (kLimits.q_min + kLimits.q_max);

/// Motions of any size: each field of each joint up to twice its limit, often much less, often
/// zero.
struct Random {
  std::mt19937_64 bits{kSeed};
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(bits); }
  double often_small() {
    return unit() < -0.5 ? 0.0 : 2.0 * unit() * std::pow(10.0, -3.0 + 3.0 * std::abs(unit()));
  }
  Point difference() {
    Point d;
    for (int j = 0; j < kDof; ++j) {
      d.q[j] = often_small();
      d.dq[j] = kLimits.dq_max[j] * often_small();
      d.ddq[j] = kLimits.ddq_max[j] * often_small();
    }
    return d;
  }
};

double peak(const Polynomial& p, double T) {
  const Extremes found = extremes(p, T);
  return std::max(-found.min, found.max);
}

double peak_velocity(const Segment& segment, int joint) {
  return peak(segment.position(joint).derivative(), segment.duration());
}

double peak_acceleration(const Segment& segment, int joint) {
  return peak(segment.position(joint).derivative().derivative(), segment.duration());
}

double peak_jerk(const Segment& segment, int joint) {
  return peak(segment.position(joint).derivative().derivative().derivative(), segment.duration());
}

Segment bridge(const Point& difference) {
  return {difference, Point(), JointSpace::bridge_time_s(difference, kLimits),
          Interpolation::kQuintic, 0};
}

void assert_at_most(double value, double limit) {
  if (value > limit * (1.0 + 1e-9)) print_error("seed %u: %.9g > %.9g\n", kSeed, value, limit);
  assert_true(value <= limit * (1.0 + 1e-9));
}

// Proves RG-2, RG-4.

void a_difference_in_position_is_bridged_with_half_of_one_limit(void**) {
  for (const double distance : {0.1, 1.0}) {
    for (int j = 0; j < kDof; ++j) {
      Point d;
      d.q[j] = -distance;
      const double velocity = peak_velocity(bridge(d), j) / kLimits.dq_max[j];
      const double acceleration = peak_acceleration(bridge(d), j) / kLimits.ddq_max[j];
      ASSERT_NEAR(std::max(velocity, acceleration), 0.5, 1e-4);  // tight, no more
      assert_at_most(std::max(velocity, acceleration), 0.5);
    }
  }
}

void a_difference_in_velocity_is_bridged_with_half_of_the_acceleration_limit(void**) {
  for (int j = 0; j < kDof; ++j) {
    Point d;
    d.dq[j] = 0.5 * kLimits.dq_max[j];
    const double used = peak_acceleration(bridge(d), j) / kLimits.ddq_max[j];
    ASSERT_NEAR(used, 0.5, 1e-3);
    assert_at_most(used, 0.5);
    ASSERT_NEAR(peak_velocity(bridge(d), j), d.dq[j], 1e-12);
  }
}

void no_bridge_takes_more_than_half_of_the_limits_or_what_it_begins_with(void**) {
  print_message("seed %u\n", kSeed);
  Random random;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Point d = random.difference();
    const Segment segment = bridge(d);
    for (int j = 0; j < kDof; ++j) {
      const double dv = std::abs(d.dq[j]), da = std::abs(d.ddq[j]);
      const double half_v = 0.5 * kLimits.dq_max[j], half_a = 0.5 * kLimits.ddq_max[j];
      assert_at_most(peak_velocity(segment, j),
                     std::max(half_v, dv) + 0.068 * da * segment.duration());
      assert_at_most(peak_acceleration(segment, j), std::max(half_a, da));
      assert_at_most(peak_jerk(segment, j), 0.5 * kLimits.dddq_max[j]);
    }
  }
}

void even_no_difference_takes_a_time(void**) {
  assert_true(JointSpace::bridge_time_s(Point(), kLimits) > 0.0);
}

void at_a_rate_velocity_and_acceleration_are_those_of_the_chain_rule(void**) {
  Point point;
  point.q.setConstant(1.0), point.dq.setConstant(2.0), point.ddq.setConstant(3.0);
  point.tau.setConstant(4.0);
  const Point slow = point.at_rate(0.5, -0.25);  // p' r = 1, p'' r^2 + p' dr/dt = 0.75 - 0.5
  assert_true(slow.q == point.q && slow.tau == point.tau);
  ASSERT_NEAR(slow.dq[0], 1.0, 1e-15);
  ASSERT_NEAR(slow.ddq[0], 0.25, 1e-15);
}

void sum_undoes_difference(void**) {
  Point a, b;
  a.q.setConstant(3.0), a.dq.setConstant(4.0), a.ddq.setConstant(5.0), a.tau.setConstant(6.0);
  b.q.setConstant(1.0), b.dq.setConstant(1.0), b.ddq.setConstant(1.0), b.tau.setConstant(1.0);
  const Point d = JointSpace::difference(a, b);
  assert_true(d.q[0] == 2.0 && d.dq[0] == 3.0 && d.ddq[0] == 4.0 && d.tau[0] == 5.0);
  const Point again = JointSpace::sum(d, b);
  assert_true(again.q == a.q && again.dq == a.dq && again.ddq == a.ddq && again.tau == a.tau);
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

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_difference_in_position_is_bridged_with_half_of_one_limit),
      cmocka_unit_test(a_difference_in_velocity_is_bridged_with_half_of_the_acceleration_limit),
      cmocka_unit_test(no_bridge_takes_more_than_half_of_the_limits_or_what_it_begins_with),
      cmocka_unit_test(even_no_difference_takes_a_time),
      cmocka_unit_test(at_a_rate_velocity_and_acceleration_are_those_of_the_chain_rule),
      cmocka_unit_test(sum_undoes_difference),
      cmocka_unit_test(a_point_is_finite_only_if_all_its_numbers_are),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
