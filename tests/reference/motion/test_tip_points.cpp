// Points for the tool tip under `online = limit`: on the sides of its workspace, out of a motion,
// half a turn away, streamed around a circle.
#include "tests/reference/motion/checked_motion.hpp"
#include "tests/reference/motion/motion_cases.hpp"

namespace {

using namespace tactus;

const Vector3 kLowest = {0.1, -0.3, 0.1}, kHighest = {0.7, 0.3, 0.7};

/// A tip in a box, checked in every cycle.
struct TipInABox : CheckedTip {
  explicit TipInABox(double period = 1e-3) : CheckedTip(period) {
    TaskLimits& limits = channel.settings.limits;
    limits.p_min = kLowest;
    limits.p_max = kHighest;
    oracle.begin(limits, period, Smoothness::kAcceleration, kRateJerk);
  }
  /// Sends `point` and returns the seconds until the tip is at rest there.
  double reach(const Point& point, double most_s) {
    const double begun_s = generator.time_s();
    assert_int_not_equal(send(point), 0);
    for (int k = cycles(most_s); k > 0 && !arrived(point); --k) cycle();
    assert_true(arrived(point));
    return generator.time_s() - begun_s;
  }
  bool arrived(const Point& point) const {
    return generator.phase() == MotionPhase::kHolding && (out().x.p - point.x.p).norm() < 1e-9 &&
           log_so3(out().x.r * point.x.r.conjugate()).norm() < 1e-9;
  }
};

TaskSpace::Point turned(const TaskSpace::Point& from, const Vector3& p, const Vector3& rotation) {
  TaskSpace::Point point;
  point.x = {p, exp_so3(rotation) * from.x.r};
  return point;
}

/// Returns a position inside the box, with the first `sides` axes on a side of it.
Vector3 on_sides(Dice& dice, int sides) {
  Vector3 p;
  for (int i = 0; i < 3; ++i) p[i] = dice.uniform(kLowest[i] + 0.02, kHighest[i] - 0.02);
  for (int i = 0; i < sides; ++i) p[i] = dice.chance(0.5) ? kLowest[i] : kHighest[i];
  return p;
}

// Proves RG-21, RG-22.

void sides_edges_and_corners_of_the_workspace_are_reached(void**) {
  Dice dice{61};
  for (const double period : {1e-3, 8e-3}) {
    for (int trial = 0; trial < 120; ++trial) {
      TipInABox bench(period);
      bench.reach(turned(bench.home, on_sides(dice, trial % 4), 1.5 * dice.vector()), 10.0);
      bench.reach(turned(bench.home, on_sides(dice, 3), 1.5 * dice.vector()), 10.0);
    }
  }
}

void a_tip_outside_its_workspace_comes_back_and_goes_no_further_out(void**) {
  TipInABox bench;
  bench.home.x.p = {0.8, 0.0, 0.75};
  ASSERT_OK(bench.start(bench.home));
  bench.oracle.begin(TaskLimits(), bench.period_s, Smoothness::kAcceleration, 0.0);
  const TaskSpace::Point inside = turned(bench.home, {0.5, 0.1, 0.5}, {0.1, 0.2, 0.3});
  assert_int_not_equal(bench.send(inside), 0);
  Vector3 last = bench.home.x.p;
  for (int k = 0; k < 3000 && !bench.arrived(inside); ++k) {
    bench.cycle();
    assert_true(bench.out().x.p.x() <= last.x() && bench.out().x.p.z() <= last.z());
    last = bench.out().x.p;
  }
  assert_true(bench.arrived(inside));
}

/// Half a turn has two directions; the tip takes one of them to its end.
void half_a_turn_is_finished(void**) {
  Dice dice{62};
  constexpr double kHalf = 3.14159265358979323846;
  for (int trial = 0; trial < 100; ++trial) {
    TipInABox bench;
    const Vector3 axis = dice.vector().normalized();
    bench.reach(turned(bench.home, bench.home.x.p, kHalf * axis), 10.0);
  }
}

/// Out of a motion a point takes at most the time of the stop and of the way from there, each in
/// its least time, and the acceleration reverses no more often than in these.
void out_of_a_motion_the_tip_stops_at_most_and_goes(void**) {
  // Translation and rotation share one law of time, which keeps the lower limit of each kind.
  constexpr double kTogether = 1.1;
  Dice dice{63};
  const TaskLimits limits;
  const TimeOptimum p({limits.v_max, limits.a_max, limits.j_max});
  const TimeOptimum r({limits.w_max, limits.alpha_max, limits.dalpha_max});
  for (int trial = 0; trial < 100; ++trial) {
    TipInABox bench;
    assert_int_not_equal(bench.send(turned(bench.home, on_sides(dice, 0), 1.5 * dice.vector())), 0);
    bench.run(dice.uniform(0.26, 0.5));
    const TaskSpace::Point begin = bench.out();
    const double v = begin.v.head<3>().norm(), w = begin.v.tail<3>().norm();
    const double run_out_s = limits.a_max / limits.j_max + limits.alpha_max / limits.dalpha_max;
    const double stop_s = run_out_s + std::max(p.stopping_time_s(v), r.stopping_time_s(w));
    const TaskSpace::Point to = turned(begin, on_sides(dice, 0), 1.0 * dice.vector());
    const double way = (to.x.p - begin.x.p).norm() + v * stop_s;
    const double angle = log_so3(to.x.r * begin.x.r.conjugate()).norm() + w * stop_s;
    const double go_s = std::max(p.time_s(0.0, 0.0, way), r.time_s(0.0, 0.0, angle));
    assert_true(bench.reach(to, 20.0) <= stop_s + kTogether * go_s + 6.0 * bench.period_s);
  }
}

/// Counts how often the acceleration changes by a fifth of its limit and back within two cycles.
void its_acceleration_does_not_chatter(void**) {
  Dice dice{64};
  const double fifth = 0.2 * TaskLimits().a_max;
  for (int trial = 0; trial < 60; ++trial) {
    TipInABox bench;
    int swings = 0;
    Vector3 before = Vector3::Zero(), change = Vector3::Zero();
    for (int point = 0; point < 3; ++point) {
      assert_int_not_equal(
          bench.send(turned(bench.home, on_sides(dice, 3 * point / 2), dice.vector())), 0);
      for (int k = 0; k < 400; ++k) {
        bench.cycle();
        const Vector3 a = bench.out().a.head<3>(), now = a - before;
        if (now.dot(change) < 0.0 && now.norm() > fifth && change.norm() > fifth) ++swings;
        before = a;
        change = now;
      }
    }
    assert_true(swings <= 9);  // where a stop and a way begin, turn and end
  }
}

void the_sign_of_its_quaternion_never_jumps(void**) {
  Dice dice{65};
  TipInABox bench;
  for (int k = 0; k < 8000; ++k) {
    if (k % 400 == 0) {
      TaskSpace::Point point = turned(bench.home, on_sides(dice, 0), 3.0 * dice.vector());
      if (dice.chance(0.5)) point.x.r.coeffs() *= -1.0;
      assert_int_not_equal(bench.send(point), 0);
      bench.report_of(0);
    }
    const Eigen::Quaterniond before = bench.out().x.r;
    bench.cycle();
    assert_true(bench.out().x.r.dot(before) > 0.99);
  }
}

/// Thirty noisy positions per second on a circle of 0.1 m radius, one turn in two seconds.
void a_circle_of_points_is_followed_at_its_speed(void**) {
  constexpr double kRadius = 0.1, kOmega = 3.14159265358979323846;
  Dice dice{66};
  TipInABox bench;
  double slowest = kInfinity, fastest = 0.0, arrival_s = 0.0, error = 0.0;
  const auto at = [&](double t) -> Vector3 {
    return bench.home.x.p +
           kRadius * Vector3(std::sin(kOmega * t), std::cos(kOmega * t) - 1.0, 0.0);
  };
  for (int sent = 0; bench.generator.time_s() < 6.0;) {
    const double t = bench.generator.time_s();
    if (t >= arrival_s) {
      const Vector3 p = at(sent / 30.0) + 1e-4 * dice.vector();
      assert_int_not_equal(bench.send(turned(bench.home, p, 1e-4 * dice.vector())), 0);
      arrival_s = ++sent / 30.0 + dice.uniform(0.0, 0.005);
    }
    bench.cycle();
    bench.report_of(0);
    if (t <= 2.0) continue;
    const double v = bench.out().v.head<3>().norm();
    slowest = std::min(slowest, v);
    fastest = std::max(fastest, v);
    error = std::max(error, (bench.out().x.p - at(t)).norm());
  }
  const double speed = kRadius * kOmega;
  print_message("speed %.3f to %.3f of %.3f m/s, at most %.4f m away\n", slowest, fastest, speed,
                error);
  assert_true(slowest > 0.9 * speed && fastest < 1.1 * speed && error < 0.002);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(sides_edges_and_corners_of_the_workspace_are_reached),
      cmocka_unit_test(a_tip_outside_its_workspace_comes_back_and_goes_no_further_out),
      cmocka_unit_test(half_a_turn_is_finished),
      cmocka_unit_test(out_of_a_motion_the_tip_stops_at_most_and_goes),
      cmocka_unit_test(its_acceleration_does_not_chatter),
      cmocka_unit_test(the_sign_of_its_quaternion_never_jumps),
      cmocka_unit_test(a_circle_of_points_is_followed_at_its_speed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
