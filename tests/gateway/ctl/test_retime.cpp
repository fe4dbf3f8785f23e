// Tests retiming: analytic least times, corners, and every bound between waypoints over random
// paths. The polynomials between waypoints are evaluated here in Bernstein form, by de Casteljau.
#include <algorithm>
#include <random>

#include "gateway/ctl/retime/retimer.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace tactus::ctl {
namespace {

Numbers joints(std::initializer_list<double> values) {
  Numbers q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

RetimeSettings settings(Eigen::Index count, double v, double a, double j, bool jerk) {
  RetimeSettings settings;
  settings.bounds = {Numbers::Constant(count, v), Numbers::Constant(count, a),
                     Numbers::Constant(count, j)};
  settings.jerk = jerk;
  return settings;
}

double time_of(const std::vector<Numbers>& path, const RetimeSettings& settings) {
  const std::vector<TimedPoint> points = retime(path, settings);
  assert_true(points.size() >= 2);
  return points.back().time_s;
}

/// Value of a polynomial given by its Bernstein coefficients on [0, 1].
double casteljau(std::vector<double> c, double u) {
  for (std::size_t left = c.size(); left > 1; --left)
    for (std::size_t i = 0; i + 1 < left; ++i) c[i] += u * (c[i + 1] - c[i]);
  return c[0];
}

std::vector<double> derivative(const std::vector<double>& c, double T) {
  std::vector<double> d;
  for (std::size_t i = 0; i + 1 < c.size(); ++i)
    d.push_back(static_cast<double>(c.size() - 1) * (c[i + 1] - c[i]) / T);
  return d;
}

/// The segment between two waypoints: a quintic, or a cubic without accelerations.
std::vector<double> segment(const TimedPoint& a, const TimedPoint& b, int k, bool quintic) {
  const double T = b.time_s - a.time_s;
  if (!quintic) return {a.q[k], a.q[k] + T / 3 * a.dq[k], b.q[k] - T / 3 * b.dq[k], b.q[k]};
  const auto inner = [&](const TimedPoint& p, double h) {
    return p.q[k] + 2.0 * h / 5.0 * p.dq[k] + h * h / 20.0 * p.ddq[k];
  };
  return {a.q[k],       a.q[k] + T / 5 * a.dq[k], inner(a, T),
          inner(b, -T), b.q[k] - T / 5 * b.dq[k], b.q[k]};
}

struct Largest {
  double q = 0.0;
  double v = 0.0, a = 0.0, j = 0.0;  // as fractions of the bounds
};

Largest evaluated(const std::vector<TimedPoint>& points, const RetimeSettings& settings) {
  Largest most;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double T = points[i].time_s - points[i - 1].time_s;
    assert_true(T > 0.0);
    for (int k = 0; k < settings.bounds.v.size(); ++k) {
      const auto q = segment(points[i - 1], points[i], k, settings.jerk), v = derivative(q, T);
      const auto a = derivative(v, T), j = derivative(a, T);
      for (int n = 0; n <= 20; ++n) {
        most.q = std::max(most.q, std::abs(casteljau(q, n / 20.0)));
        most.v = std::max(most.v, std::abs(casteljau(v, n / 20.0)) / settings.bounds.v[k]);
        most.a = std::max(most.a, std::abs(casteljau(a, n / 20.0)) / settings.bounds.a[k]);
        most.j = std::max(most.j, std::abs(casteljau(j, n / 20.0)) / settings.bounds.j[k]);
      }
    }
  }
  return most;
}

// Proves CTL-10.

void a_line_from_rest_to_rest_takes_the_time_of_bang_bang(void**) {
  for (const double way : {0.01, 0.1, 0.8, 1.0, 3.0, 20.0}) {
    const double v = 2.0, a = 5.0;
    const double least = way < v * v / a ? 2.0 * std::sqrt(way / a) : way / v + v / a;
    const double taken =
        time_of({joints({0.3}), joints({0.3 + way})}, settings(1, v, a, 1.0, false));
    assert_true(taken >= least * (1.0 - 1e-9));
    ASSERT_NEAR(taken, least, 1e-5 * least);
  }
}

void the_slowest_joint_decides(void**) {
  RetimeSettings two = settings(2, 2.0, 5.0, 1.0, false);
  two.bounds.v[1] = 0.5;
  const double taken = time_of({joints({0.0, 0.0}), joints({1.0, -1.0})}, two);
  ASSERT_NEAR(taken, 1.0 / 0.5 + 0.5 / 5.0, 1e-4);
}

void a_corner_without_tolerance_is_a_stop(void**) {
  const std::vector<Numbers> path = {joints({0.0, 0.0}), joints({1.0, 0.0}), joints({1.0, 1.0})};
  const RetimeSettings plain = settings(2, 2.0, 5.0, 1.0, false);
  ASSERT_NEAR(time_of(path, plain), 2.0 * (1.0 / 2.0 + 2.0 / 5.0), 1e-4);
  for (const TimedPoint& point : retime(path, plain))
    if ((point.q - path[1]).abs().maxCoeff() < 1e-9)
      ASSERT_NEAR(point.dq.abs().maxCoeff(), 0.0, 1e-9);
}

/// In the middle of a blend of two joints at a right angle, q' = (1/2, 1/2) and q'' = 3/4 (-1, 1) /
/// L, so that the squared speed along the path is at most a L / (3/4).
void a_blend_is_passed_at_the_speed_that_its_curvature_allows(void**) {
  RetimeSettings round = settings(2, 100.0, 5.0, 1e5, false);
  round.corners.radius = 0.2;
  const std::vector<Numbers> path = {joints({0.0, 0.0}), joints({3.0, 0.0}), joints({3.0, 3.0})};
  double nearest = 1.0, dq = 0.0;
  for (const TimedPoint& point : retime(path, round)) {
    const double distance = std::abs(point.dq[0] - point.dq[1]);
    if (point.q[0] > 2.8 && point.q[1] < 0.2 && distance < nearest) {
      nearest = distance;
      dq = point.dq[0];
    }
  }
  ASSERT_NEAR(dq, 0.5 * std::sqrt(5.0 * 0.2 / 0.75), 0.01);
}

// Proves CTL-11.

void a_jerk_bound_costs_little_more_than_the_least_time(void**) {
  for (const double way : {0.05, 0.5, 2.0}) {
    for (const double j : {20.0, 100.0, 500.0}) {
      const double least = TimeOptimum({2.0, 5.0, j}).time_s(0.0, 0.0, way);
      const double taken = time_of({joints({0.0}), joints({way})}, settings(1, 2.0, 5.0, j, true));
      assert_true(taken >= least * (1.0 - 1e-9));
      assert_true(taken <= least * (way >= 0.5 && j >= 500.0 ? 1.03 : 1.25));
    }
  }
}

// Proves CTL-12.

void no_bound_is_exceeded_on_random_paths(void**) {
  std::mt19937 generator(18);
  constexpr double kEnd = 2.0;  // of a range, beyond which no path goes
  std::uniform_real_distribution<double> anywhere(-3.0, 3.0), share(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Index count = 1 + trial % 7;
    RetimeSettings one = settings(count, 1.0, 1.0, 1.0, trial % 2 == 0);
    one.steps = 200;
    for (Eigen::Index k = 0; k < count; ++k) {
      one.bounds.v[k] = 0.5 + 3.0 * share(generator);
      one.bounds.a[k] = 1.0 + 15.0 * share(generator);
      one.bounds.j[k] = one.bounds.a[k] * (5.0 + 300.0 * share(generator));
    }
    if (trial % 3 == 1)
      one.corners.tolerance =
          Numbers::Constant(count, std::pow(10.0, -3.0 + 2.0 * share(generator)));
    if (trial % 3 == 2) one.corners.radius = 0.01 + share(generator);
    std::vector<Numbers> path;
    for (int i = 0; i < 2 + trial % 5; ++i) {
      path.emplace_back(count);
      for (Eigen::Index k = 0; k < count; ++k)
        path.back()[k] = std::clamp(anywhere(generator), -kEnd, kEnd);
    }
    const std::vector<TimedPoint> points = retime(path, one);
    const Largest most = evaluated(points, one);
    assert_true(most.q <= kEnd + 1e-6);  // the room that the verb leaves
    assert_true(most.v <= 1.0 + 1e-8);
    assert_true(most.a <= 1.0 + 1e-8);
    assert_true(most.j <= 1.0 + 1e-6);  // without one.jerk it only steps at waypoints
    assert_true((points.front().q == path.front()).all());
    ASSERT_NEAR((points.back().q - path.back()).abs().maxCoeff(), 0.0, 1e-12);
    ASSERT_NEAR(points.back().dq.abs().maxCoeff(), 0.0, 1e-12);
  }
}

// Proves CTL-13.

/// The distance of a blend from its corner is 3/16 L |d2 - d1|; at a right angle in two joints,
/// each is 3/16 L away.
void a_blend_stays_within_tolerance_of_its_corner(void**) {
  const std::vector<Numbers> path = {joints({0.0, 0.0}), joints({1.0, 0.0}), joints({1.0, 1.0})};
  for (const bool jerk : {false, true}) {
    for (const double tolerance : {0.001, 0.01, 0.05}) {
      RetimeSettings round = settings(2, 2.0, 5.0, 500.0, jerk);
      round.corners.tolerance = Numbers::Constant(2, tolerance);
      double nearest = 1.0;
      for (const TimedPoint& point : retime(path, round))
        nearest = std::min(nearest, (point.q - path[1]).abs().maxCoeff());
      if (tolerance >= 0.01) assert_true(nearest >= tolerance * 0.99);  // else a stop may be faster
      assert_true(nearest <= tolerance * 1.2);  // no waypoint need be in the middle
    }
  }
}

void a_path_that_turns_back_stops_there(void**) {
  RetimeSettings round = settings(1, 2.0, 5.0, 500.0, true);
  round.corners.tolerance = Numbers::Constant(1, 0.1);
  bool there = false;
  for (const TimedPoint& point : retime({joints({0.0}), joints({1.0}), joints({0.0})}, round))
    there |= point.q[0] == 1.0 && point.dq[0] == 0.0;
  assert_true(there);
}

void waypoints_that_are_all_the_same_are_no_path(void**) {
  assert_true(retime({}, settings(1, 1.0, 1.0, 1.0, true)).empty());
  assert_true(retime({joints({1.0})}, settings(1, 1.0, 1.0, 1.0, true)).empty());
  assert_true(retime({joints({1.0}), joints({1.0})}, settings(1, 1.0, 1.0, 1.0, true)).empty());
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_from_rest_to_rest_takes_the_time_of_bang_bang),
      cmocka_unit_test(the_slowest_joint_decides),
      cmocka_unit_test(a_corner_without_tolerance_is_a_stop),
      cmocka_unit_test(a_blend_is_passed_at_the_speed_that_its_curvature_allows),
      cmocka_unit_test(a_jerk_bound_costs_little_more_than_the_least_time),
      cmocka_unit_test(no_bound_is_exceeded_on_random_paths),
      cmocka_unit_test(a_blend_stays_within_tolerance_of_its_corner),
      cmocka_unit_test(a_path_that_turns_back_stops_there),
      cmocka_unit_test(waypoints_that_are_all_the_same_are_no_path),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
