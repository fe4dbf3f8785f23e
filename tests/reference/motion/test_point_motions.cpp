// Points under `online = limit`: the reference goes to them within limits, by the shortest way, in
// about the least time, from any state.
#include <array>

#include "tests/reference/motion/checked_motion.hpp"
#include "tests/reference/motion/motion_cases.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

/// Cycles that a point needs to the output.
constexpr int kTransport = 2;
constexpr int kMotions = tries(1000, 200);

/// Runs until all joints are at rest; returns how far joint `j` went beyond the end of an immediate
/// stop.
double beyond_its_stop(CheckedJoints& bench, int j, double begin, double dq) {
  const double stop =
      TimeOptimum(axis_limits(j)).stopping_way(dq) + kTransport * bench.period_s * dq;
  double most = 0.0;
  for (int k = 0; k < 5000; ++k) {
    bench.cycle();
    most = std::max(most, (bench.out().q[j] - begin) - 1.01 * stop);
  }
  assert_true(bench.out().standing());
  return most;
}

// Proves RG-21, RG-22.

void a_joint_told_to_stay_goes_no_farther_than_it_must(void**) {
  static CheckedJoints bench;
  cruise(bench, bench.home.q, only(0, 2.0), 0.5);
  JointSpace::Point point = bench.out().at_rest();
  point.q[1] += 1.5;
  const double begin = point.q[0];
  assert_int_not_equal(bench.send(point), 0);
  ASSERT_NEAR(beyond_its_stop(bench, 0, begin, 2.0), 0.0, 1e-12);
  ASSERT_NEAR((bench.out().q - point.q).norm(), 0.0, 1e-9);
}

void a_point_where_the_reference_is_now_stops_it_by_the_shortest_way(void**) {
  for (int i = 1; i <= 9; ++i) {
    CheckedJoints bench;
    const double dq = 0.1 * i * bench.channel.settings.limits.dq_max[0];
    cruise(bench, bench.home.q, only(0, dq), 0.5);
    const JointSpace::Point here = bench.out().at_rest();
    const double least_s = TimeOptimum(axis_limits(0)).time_s(dq, 0.0, 0.0);
    assert_int_not_equal(bench.send(here), 0);
    ASSERT_NEAR(beyond_its_stop(bench, 0, here.q[0], dq), 0.0, 1e-12);
    ASSERT_NEAR((bench.out().q - here.q).norm(), 0.0, 1e-9);
    ASSERT_OK(bench.start(here));
    bench.oracle.forget();
    cruise(bench, bench.home.q, only(0, dq), 0.5);
    assert_int_not_equal(bench.send(bench.out().at_rest()), 0);
    assert_true(bench.stop(5.0) <= 1.05 * least_s + kTransport * bench.period_s);
  }
}

/// Ratios of times to the optimum, and their percentiles.
struct Ratios {
  std::array<double, 1000> ratio{};
  std::size_t count = 0;
  int refused = 0;

  double at(double share) {
    std::sort(ratio.begin(), ratio.begin() + count);
    return ratio[static_cast<std::size_t>(share * static_cast<double>(count - 1))];
  }
};

/// Sends a point, waits until it is reached, and adds the ratio of that time to the least time.
void measure(CheckedJoints& bench, const JointSpace::Point& point, Ratios& ratios) {
  const JointSpace::Point from = bench.out();
  double least_s = 0.0;
  for (int j = 0; j < kDof; ++j) {
    const TimeOptimum axis(axis_limits(j));
    least_s = std::max(least_s, axis.time_s(from.dq[j], from.ddq[j], point.q[j] - from.q[j]));
  }
  const std::uint32_t id = bench.send(point);
  bench.cycle();
  const bool refused = bench.report_of(id).outcome == Outcome::kRefused;
  ratios.refused += refused;
  double time_s = bench.period_s;
  while (!refused && time_s < 30.0) {
    const bool there = (bench.out().q - point.q).norm() < 1e-9 && bench.out().standing();
    if (there) break;
    bench.cycle();
    time_s += bench.period_s;
  }
  if (refused) return;
  ratios.ratio[ratios.count++] = (time_s - kTransport * bench.period_s) / std::max(least_s, 0.02);
}

JointSpace::Point random_point(Dice& dice, const CheckedJoints& bench) {
  JointSpace::Point point;
  for (int j = 0; j < kDof; ++j) point.q[j] = bench.home.q[j] + dice.uniform(-1.0, 1.0);
  return point;
}

void from_rest_a_point_takes_the_least_time(void**) {
  static CheckedJoints bench;
  static Ratios ratios;
  Dice dice{20261122};
  for (int i = 0; i < tries(200, 50); ++i) measure(bench, random_point(dice, bench), ratios);
  print_message("duration against the optimum: median %.4f, worst %.4f\n", ratios.at(0.5),
                ratios.at(1.0));
  assert_int_equal(ratios.refused, 0);
  // The way is a straight line, where for each limit the joint that allows least counts.
  assert_true(ratios.at(0.5) <= 1.01 && ratios.at(1.0) <= 1.15);
}

/// Sends a quintic through random states, about as fast as is admitted.
bool set_off(CheckedJoints& bench, Dice& dice) {
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  const JointLimits& limits = bench.channel.settings.limits;
  double time_s = 0.0;
  JointSpace::Point from = bench.out();
  for (int i = 0; i < 3; ++i) {
    JointSpace::Point to = random_point(dice, bench);
    if (i < 2) MotionCases<JointSpace>::set_moving(dice, limits, 0.5, to);
    time_s += 0.3 * connecting_time_s<JointSpace>(from, to, limits) + 0.1;
    bench.add(*motion, time_s, to);
    from = to;
  }
  for (int i = 0; i < 40; ++i) {
    if (bench.send(*motion) != 0) return true;
    for (int k = 0; k < motion->count; ++k) {
      motion->waypoints[k].time_s *= 1.1;
      MotionCases<JointSpace>::scale_rates(motion->waypoints[k].point, 1.0 / 1.1);
    }
  }
  return false;
}

void out_of_a_motion_no_point_is_refused_and_the_least_time_is_taken(void**) {
  static CheckedJoints bench;
  static Ratios ratios;
  Dice dice{20261123};
  for (int i = 0; i < kMotions; ++i) {
    if (!set_off(bench, dice)) continue;
    bench.run(dice.uniform(0.1, 1.5));
    measure(bench, random_point(dice, bench), ratios);
    if (bench.executing()) bench.cancel();
    bench.stop(5.0);
    bench.report_of(0);
  }
  print_message("%d refused; duration against the optimum: median %.4f, worst %.4f\n",
                ratios.refused, ratios.at(0.5), ratios.at(1.0));
  assert_int_equal(ratios.refused, 0);
  assert_true(ratios.count > kMotions * 9 / 10);
  assert_true(ratios.at(0.5) <= 1.05 && ratios.at(0.99) <= 1.5);
}

// Proves RG-21.

/// Sends a quintic rotation and translation, about as fast as is admitted.
void set_off(CheckedTip& bench, Dice& dice) {
  TaskSpace::Point to = bench.home;
  to.x.p += 0.4 * dice.vector();
  to.x.r = (exp_so3(dice.uniform(0.5, 1.5) * dice.vector()) * bench.out().x.r).normalized();
  for (double T = 0.4; T < 5.0; T += 0.05) {
    Trajectory<TaskSpace>* motion = bench.trajectory(kQuintics);
    bench.add(*motion, T, to);
    const std::uint32_t id = bench.send(*motion);
    bench.cycle();
    if (id != 0 && bench.report_of(id).outcome == Outcome::kStarted) return;
  }
}

void half_a_turn_asked_of_a_tip_that_turns_keeps_its_limits(void**) {
  static CheckedTip bench;
  Dice dice{20261124};
  int refused = 0;
  for (int i = 0; i < tries(300, 60); ++i) {
    if (i % 3 != 0) set_off(bench, dice);
    bench.run(dice.uniform(0.1, 0.7));
    TaskSpace::Point point = bench.home;
    const double angle = i % 2 == 0 ? 3.14 : dice.uniform(2.0, 3.14);
    point.x.p += 0.3 * dice.vector();
    point.x.r = (exp_so3(angle * dice.vector().normalized()) * bench.out().x.r).normalized();
    const std::uint32_t id = bench.send(point);
    bench.run(i % 5 == 0 ? 5.0 : dice.uniform(0.0, 1.5));
    refused += bench.report_of(id).outcome == Outcome::kRefused;
    if (i % 5 != 0) continue;
    assert_true(bench.out().standing());
    ASSERT_NEAR((bench.out().x.p - point.x.p).norm(), 0.0, 1e-9);
    ASSERT_NEAR(std::abs(bench.out().x.r.dot(point.x.r)), 1.0, 1e-9);
  }
  assert_int_equal(refused, 0);
}

// Proves RG-22.

void the_effort_of_a_point_is_put_out_with_it(void**) {
  static CheckedJoints bench;
  JointSpace::Point point = bench.home;
  point.q[0] += 0.2;
  point.tau[3] = 2.0;
  assert_int_not_equal(bench.send(point), 0);
  bench.run(2.0);
  ASSERT_NEAR((bench.out().q - point.q).norm(), 0.0, 1e-9);
  ASSERT_NEAR(bench.out().tau[3], 2.0, 1e-9);
}

void the_wrench_of_a_point_is_put_out_with_it(void**) {
  static CheckedTip bench;
  TaskSpace::Point point = bench.home;
  point.x.p[0] += 0.1;
  point.h[2] = 15.0;
  assert_int_not_equal(bench.send(point), 0);
  bench.run(2.0);
  ASSERT_NEAR((bench.out().x.p - point.x.p).norm(), 0.0, 1e-9);
  ASSERT_NEAR(bench.out().h[2], 15.0, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_told_to_stay_goes_no_farther_than_it_must),
      cmocka_unit_test(a_point_where_the_reference_is_now_stops_it_by_the_shortest_way),
      cmocka_unit_test(from_rest_a_point_takes_the_least_time),
      cmocka_unit_test(out_of_a_motion_no_point_is_refused_and_the_least_time_is_taken),
      cmocka_unit_test(half_a_turn_asked_of_a_tip_that_turns_keeps_its_limits),
      cmocka_unit_test(the_effort_of_a_point_is_put_out_with_it),
      cmocka_unit_test(the_wrench_of_a_point_is_put_out_with_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
