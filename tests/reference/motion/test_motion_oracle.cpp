// MotionOracle accepts every motion that keeps the limits and nothing else. The motions of this
// test are integrated from a jerk that also switches within the period.
#include "tests/reference/motion/motion_bench.hpp"
#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace {

using namespace tactus;

constexpr double kPeriods_s[] = {1e-3, 2e-3, 8e-3};
/// A zero of Bernoulli's second polynomial: the worst place in a period for a jerk to switch.
constexpr double kFirst = 0.21132486540518713;

/// One axis that moves at random with its jerk at the limit or below.
struct Wanderer {
  Dice dice{1};
  double p = 0.0, v = 0.0, a = 0.0;
  double jerk[3] = {}, part[3] = {};  // of this period; durations of its parts

  void choose(const SymmetricLimits& limits, double h) {
    const bool free = std::abs(v) < 0.7 * limits.v;
    const double to = free ? limits.a * dice.uniform(-0.9, 0.9) : (v > 0.0 ? -0.9 : 0.9) * limits.a;
    const double j = std::clamp((to - a) / h, -limits.j, limits.j);
    const double sign = dice.chance(0.5) ? limits.j : -limits.j;
    const bool deceives = free && std::abs(a) + limits.j * h < 0.9 * limits.a && dice.chance(0.5);
    const double parts[] = {kFirst * h, (1.0 - 2.0 * kFirst) * h, kFirst * h};
    for (int i = 0; i < 3; ++i) {
      part[i] = parts[i];
      jerk[i] = !deceives ? j : i == 1 ? -sign : sign;
    }
  }
  void move(int i, double share) {
    const double t = share * part[i], j = jerk[i];
    p += t * (v + t * (a / 2.0 + t * j / 6.0));
    v += t * (a + t * j / 2.0);
    a += t * j;
  }
};

void assert_accepted(const Excess& excess) {
  if (excess.what != nullptr)
    print_error("track %d: %s: %.17g, limit %.17g\n", excess.track, excess.what, excess.value,
                excess.limit);
  assert_null(excess.what);
}

JointLimits without_ends() {
  JointLimits limits;
  limits.q_min.setConstant(-kInfinity);
  limits.q_max.setConstant(kInfinity);
  return limits;
}

// Proves RG-21.

void it_accepts_joints_within_their_limits(void**) {
  const JointLimits limits = without_ends();
  for (const double h : kPeriods_s) {
    MotionOracle<JointSpace> oracle;
    oracle.begin(limits, h, Smoothness::kAcceleration, 0.0);
    Wanderer axes[kDof];
    JointSpace::Point point;
    for (int k = 0; k < 20000; ++k) {
      for (int j = 0; j < kDof; ++j) {
        if (k == 0) axes[j].dice.state = static_cast<std::uint64_t>(j + 1);
        axes[j].choose({limits.dq_max[j], limits.ddq_max[j], limits.dddq_max[j]}, h);
        for (int i = 0; i < 3; ++i) axes[j].move(i, 1.0);
        point.q[j] = axes[j].p;
        point.dq[j] = axes[j].v;
        point.ddq[j] = axes[j].a;
      }
      assert_accepted(oracle.check(point));
    }
  }
}

/// The orientation is integrated in a hundred steps per part of a period.
void it_accepts_a_tip_within_its_limits(void**) {
  const TaskLimits limits;
  const double share = 1.0 / std::sqrt(3.0);
  for (const double h : kPeriods_s) {
    MotionOracle<TaskSpace> oracle;
    oracle.begin(limits, h, Smoothness::kAcceleration, 0.0);
    Wanderer axes[3];
    TaskSpace::Point point;
    for (int k = 0; k < 2000; ++k) {
      for (int j = 0; j < 3; ++j) {
        if (k == 0) axes[j].dice.state = static_cast<std::uint64_t>(j + 1);
        axes[j].choose({share * limits.w_max, share * limits.alpha_max, share * limits.dalpha_max},
                       h);
      }
      for (int i = 0; i < 300; ++i) {
        const Vector3 before = {axes[0].p, axes[1].p, axes[2].p};
        for (Wanderer& axis : axes) axis.move(i / 100, 0.01);
        const Vector3 turn = Vector3(axes[0].p, axes[1].p, axes[2].p) - before;
        point.x.r = (exp_so3(turn) * point.x.r).normalized();
      }
      for (int j = 0; j < 3; ++j) {
        point.v[3 + j] = axes[j].v;
        point.a[3 + j] = axes[j].a;
      }
      assert_accepted(oracle.check(point));
    }
  }
}

/// A motion at half of each limit with one error in one cycle.
void it_accepts_nothing_else(void**) {
  const JointLimits limits = without_ends();
  constexpr double kH = 1e-3;
  const double v = limits.dq_max[0], a = limits.ddq_max[0], j = limits.dddq_max[0];
  const struct {
    double p, v, a;
  } wrongs[] = {{0.04 * j * kH * kH * kH, 0.0, 0.0},
                {0.0, 0.3 * j * kH * kH, 0.0},
                {0.0, 0.0, 1.001 * j * kH},
                {0.0, 1.001 * v, 0.0},
                {0.0, 0.0, 1.001 * a},
                {std::nan(""), 0.0, 0.0}};
  for (const auto& wrong : wrongs) {
    MotionOracle<JointSpace> oracle;
    oracle.begin(limits, kH, Smoothness::kAcceleration, 0.0);
    JointSpace::Point point;
    assert_accepted(oracle.check(point));
    point.q[0] += wrong.p;
    point.dq[0] += wrong.v;
    point.ddq[0] += wrong.a;
    assert_non_null(oracle.check(point).what);
  }
  JointLimits ends = limits;
  ends.q_min[3] = -1.0;
  ends.q_max[3] = 1.0;
  MotionOracle<JointSpace> oracle;
  oracle.begin(ends, kH, Smoothness::kVelocity, 0.0);
  JointSpace::Point point;
  point.q[3] = 1.0 + 1e-8;
  assert_non_null(oracle.check(point).what);
}

/// From rest to rest, once with a part at the largest velocity, once so short that only the jerk
/// limit matters.
void the_optimum_is_the_closed_form_where_there_is_one(void**) {
  const SymmetricLimits limits = {2.0, 15.0, 7500.0};
  const TimeOptimum axis(limits);
  for (const double way : {0.5, -1.0, 3.0}) {
    const double least_s = std::abs(way) / limits.v + limits.v / limits.a + limits.a / limits.j;
    ASSERT_NEAR(axis.time_s(0.0, 0.0, way), least_s, 1e-12);
  }
  for (const double way : {1e-6, -3e-5})
    ASSERT_NEAR(axis.time_s(0.0, 0.0, way), 4.0 * std::cbrt(std::abs(way) / (2.0 * limits.j)),
                1e-9);
  ASSERT_NEAR(axis.stopping_way(2.0), 0.5 * 2.0 * axis.stopping_time_s(2.0), 1e-12);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_accepts_joints_within_their_limits),
      cmocka_unit_test(it_accepts_a_tip_within_its_limits),
      cmocka_unit_test(it_accepts_nothing_else),
      cmocka_unit_test(the_optimum_is_the_closed_form_where_there_is_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
