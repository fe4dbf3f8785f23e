// Tests trajectories of external control: splines against their polynomials, moves, results.
#include <Eigen/LU>

#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::string_view kPublishes = "    write_output_float_register(1, splineTimerTraveled)\n";

struct Knot {
  Joints q, dq, ddq;
  double time_s;  // from the beginning
};

Knot knot(double time_s, double way, double speed, double acceleration) {
  const Joints direction = joints({1.0, -0.5, 0.6, 0.3, -0.8, 0.9});
  return {kStart + way * direction, speed * direction, acceleration * direction, time_s};
}

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// The polynomial between two knots, from its conditions as linear equations.
Joints between(const Knot& from, const Knot& to, double t, bool quintic) {
  const double T = to.time_s - from.time_s;
  const int n = quintic ? 6 : 4;
  Matrix a = Matrix::Zero(n, n), b(n, 6);
  const auto condition = [&](int row, double at, int derivative) {
    for (int k = derivative; k < n; ++k) {
      double factor = 1.0;
      for (int i = 0; i < derivative; ++i) factor *= k - i;
      a(row, k) = factor * std::pow(at, k - derivative);
    }
  };
  condition(0, 0.0, 0);
  condition(1, T, 0);
  condition(2, 0.0, 1);
  condition(3, T, 1);
  b.row(0) = from.q;
  b.row(1) = to.q;
  b.row(2) = from.dq;
  b.row(3) = to.dq;
  if (quintic) {
    condition(4, 0.0, 2);
    condition(5, T, 2);
    b.row(4) = from.ddq;
    b.row(5) = to.ddq;
  }
  const Matrix c = a.fullPivLu().solve(b);
  Joints q = Joints::Zero();
  for (int k = 0; k < n; ++k) q += c.row(k).transpose() * std::pow(t, k);
  return q;
}

/// The published time is the end of the step under way: up to a cycle ahead, at the 0.6 rad/s of
/// these knots.
constexpr double kAhead = 5e-3;

/// Sends the knots after the first and compares the target in every cycle. Returns the time until
/// the result, s.
double follow(ExternalBench& bench, const Knot* knots, int count, bool quintic, double tolerance) {
  bench.forward(1, count - 1);
  for (int i = 1; i < count; ++i)
    bench.spline_point(knots[i].q, knots[i].dq, knots[i].ddq, knots[i].time_s - knots[i - 1].time_s,
                       quintic ? 2 : 1);
  int segment = 0;
  double before = 0.0;
  for (int k = 0; k < 3000; ++k) {
    bench.tick();
    const double t = bench.machine().io.output.doubles[1];
    if (t < before && segment + 2 < count) ++segment;
    before = t;
    if (t > 0.0)
      assert_joints(bench.image().target_q, between(knots[segment], knots[segment + 1], t, quintic),
                    tolerance);
    const std::int32_t result = bench.result();
    if (result < 0) continue;
    assert_int_equal(result, 0);
    assert_int_equal(segment, count - 2);
    assert_joints(bench.target(), knots[count - 1].q, tolerance);
    ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
    assert_int_equal(bench.image().safety_mode, 1);
    return k * kCycle_s;
  }
  assert_true(false);
  return 0.0;
}

void start(ExternalBench& bench, double slider = 1.0) {
  ExternalText text;
  text.spline = kPublishes;
  bench.machine().io.speed_fraction = slider;
  bench.machine().io.output.doubles[1] = 0.0;
  bench.start(text);
  bench.forward(0);
  bench.run(2);
}

const Knot kRest[] = {knot(0.0, 0.0, 0.0, 0.0), knot(1.0, 0.3, 0.4, 0.2), knot(1.7, 0.6, 0.3, -0.4),
                      knot(3.003, 0.2, 0.0, 0.0)};

// Proves URE-13, URP-7.

/// Half the speed is the same path in twice the time.
void splines_are_followed_at_every_speed(void**) {
  for (const bool quintic : {false, true})
    for (const double slider : {1.0, 0.5}) {
      ExternalBench& bench = *new ExternalBench;
      start(bench, slider);
      ASSERT_NEAR(follow(bench, kRest, 4, quintic, kAhead), 3.003 / slider, 0.05 / slider);
      ASSERT_NEAR(bench.image().target_speed_fraction, slider, 1e-9);
      ASSERT_NEAR(bench.image().speed_scaling, 1.0, 1e-9);  // the limiter lets all of it pass
      delete &bench;
    }
}

/// The last point has a velocity: the time slows down, the path stays.
void a_last_point_with_speed_is_reached_at_rest(void**) {
  for (const bool quintic : {false, true}) {
    static ExternalBench bench;
    start(bench);
    const Knot knots[] = {knot(0.0, 0.0, 0.0, 0.0), knot(1.0, 0.5, 1.0, 0.0),
                          knot(1.5, 1.0, 1.0, 0.0)};
    follow(bench, knots, 3, quintic, 0.02);
    bench.upload("movej([0.0, -1.2, 1.2, -0.1, 1.57, 0.0])\n");
    bench.run(2);
    bench.run_to_end();
  }
}

void slowing_down_stays_below_15_rad_s2(void**) {
  static ExternalBench bench;
  start(bench);
  bench.forward(1, 1);
  const Knot end = knot(1.0, 1.0, 2.0, 0.0);
  bench.spline_point(end.q, end.dq, end.ddq, 1.0, 1);
  Joints before = Joints::Zero();
  for (int k = 0; k < 400; ++k) {
    bench.tick();
    assert_true((bench.image().target_qd - before).cwiseAbs().maxCoeff() <= 15.0 * kCycle_s);
    before = bench.image().target_qd;
  }
  assert_int_equal(bench.result(), 0);
  ASSERT_NEAR(before.norm(), 0.0, 1e-9);
}

void the_spline_time_is_published_only_if_the_text_says_so(void**) {
  static ExternalBench bench;
  bench.start();
  bench.forward(1, 1);
  const Knot end = knot(0.5, 0.1, 0.0, 0.0);
  bench.spline_point(end.q, end.dq, end.ddq, 0.5, 1);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.machine().io.output.doubles[1], 0.0, 0.0);
}

void a_first_point_where_the_arm_is_needs_no_time(void**) {
  static ExternalBench bench;
  start(bench);
  bench.forward(1, 2);
  bench.spline_point(kStart, Joints::Zero(), Joints::Zero(), 0.0, 1);
  const Knot end = knot(0.5, 0.1, 0.0, 0.0);
  bench.spline_point(end.q, end.dq, end.ddq, 0.5, 1);
  assert_int_equal(bench.await_result(), 0);
  assert_joints(bench.target(), end.q, 1e-3);
}

void no_time_for_a_way_is_cancelled(void**) {
  static ExternalBench bench;
  start(bench);
  const Knot end = knot(0.0, 0.1, 0.0, 0.0);
  for (const double time_s : {0.0, -1.0, 0.004}) {  // the last: 25 rad/s
    bench.forward(1, 1);
    bench.spline_point(end.q, end.dq, end.ddq, time_s, 1);
    assert_int_equal(bench.await_result(), 1);
    assert_joints(bench.target(), kStart, 0.0);
  }
}

void a_missing_point_fails_at_rest_after_half_a_second(void**) {
  static ExternalBench bench;
  start(bench);
  bench.forward(1, 1);
  bench.run(60);
  assert_int_equal(bench.result(), -1);
  bench.run(5);
  assert_int_equal(bench.result(), 2);
}

void a_missing_point_fails_at_once_in_motion(void**) {
  static ExternalBench bench;
  start(bench);
  bench.forward(1, 2);
  const Knot end = knot(1.0, 0.2, 0.4, 0.0);
  bench.spline_point(end.q, end.dq, end.ddq, 1.0, 1);
  int cycles = 0;
  assert_int_equal(bench.await_result(400, [&] { ++cycles; }), 2);
  // One second, and braking from 0.4 rad/s at 4 rad/s^2.
  ASSERT_NEAR(cycles * kCycle_s, 1.1, 0.05);
  assert_int_equal(bench.image().safety_mode, 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(splines_are_followed_at_every_speed),
      cmocka_unit_test(a_last_point_with_speed_is_reached_at_rest),
      cmocka_unit_test(slowing_down_stays_below_15_rad_s2),
      cmocka_unit_test(the_spline_time_is_published_only_if_the_text_says_so),
      cmocka_unit_test(a_first_point_where_the_arm_is_needs_no_time),
      cmocka_unit_test(no_time_for_a_way_is_cancelled),
      cmocka_unit_test(a_missing_point_fails_at_rest_after_half_a_second),
      cmocka_unit_test(a_missing_point_fails_at_once_in_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
