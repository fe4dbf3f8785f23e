// Tests retiming of the tip: analytic least times, and corners.
#include "tests/gateway/ctl/tip_paths.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace tactus::ctl {
namespace {

double time_of(const std::vector<Numbers>& path, const RetimeSettings& settings) {
  const std::vector<TimedPoint> points = retime(path, settings);
  assert_true(points.size() >= 2);
  return points.back().time_s;
}

double bang_bang(double way, double v, double a) {
  return way < v * v / a ? 2.0 * std::sqrt(way / a) : way / v + v / a;
}

const Vector3 kOblique = Vector3(1.0, -2.0, 2.0) / 3.0;

// Proves CTL-17.

void a_straight_line_takes_the_time_of_bang_bang_in_any_direction(void**) {
  const RetimeSettings plain = settings(false);
  const Vector3 from(-0.5, 1.0, -1.0), phi(0.3, -0.8, 1.1);
  for (const double way : {0.001, 0.05, 0.3, 1.0, 2.5}) {
    const double least = bang_bang(way, kLimits.v_max, kReserve * kLimits.a_max);
    for (const Vector3& direction : {kOblique, Vector3(0.0, -1.0, 0.0)}) {
      const double taken =
          time_of({waypoint(from, phi), waypoint(from + way * direction, phi)}, plain);
      assert_true(taken >= least * (1.0 - 1e-9));
      ASSERT_NEAR(taken, least, 1e-5 * least);
    }
  }
}

void a_rotation_in_one_place_takes_the_time_of_bang_bang_about_any_axis(void**) {
  const Vector3 p(0.5, 0.2, 0.8);
  const Eigen::Quaterniond from = exp_so3(Vector3(1.2, 0.1, -0.4));
  for (const double turn : {0.01, 0.5, 1.5, 3.1}) {
    const double least = bang_bang(turn, kLimits.w_max, kReserve * kLimits.alpha_max);
    const double taken =
        time_of({waypoint(p, from), waypoint(p, from * exp_so3(turn * kOblique))}, settings(false));
    assert_true(taken >= least * (1.0 - 1e-9));
    print_message("a turn of %g rad takes %.5f of the least time\n", turn, taken / least);
    ASSERT_NEAR(taken, least, 2e-3 * least);  // admission's bounds of a long turn are above it
  }
}

/// Both keep pace, so that each bounds velocity and acceleration of the whole way by itself.
double least_time(double way, double turn) {
  const double v = std::min(kLimits.v_max / way, kLimits.w_max / turn);
  const double a = kReserve * std::min(kLimits.a_max / way, kLimits.alpha_max / turn);
  return bang_bang(1.0, v, a);
}

void the_slower_of_line_and_rotation_decides_from_stop_to_stop(void**) {
  Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Numbers> path = random_path(random, trial);
    double least = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i)
      least += least_time(distance(path[i - 1], path[i]), angle(path[i - 1], path[i]));
    const double taken = time_of(path, settings(false));
    assert_true(taken >= least * (1.0 - 1e-9));
    assert_true(taken <= least * 1.005);  // admission's bounds of a long turn are above it
  }
}

void a_jerk_bound_costs_the_tip_little_more_than_the_least_time(void**) {
  const RetimeSettings jerk = settings(true);
  const auto compare = [](const char* what, double taken, const SymmetricLimits& limits,
                          double way) {
    const double least = TimeOptimum(limits).time_s(0.0, 0.0, way);
    assert_true(taken >= least * (1.0 - 1e-9));
    print_message("%s of %g takes %.4f of the least time\n", what, way, taken / least);
    assert_true(taken <= least * (way >= 2.0 ? 1.03 : way >= 0.2 ? 1.05 : 1.15));
  };
  const Vector3 zero = Vector3::Zero();
  for (const double way : {0.02, 0.2, 2.0}) {
    compare("a line", time_of({waypoint(zero, zero), waypoint(way * kOblique, zero)}, jerk),
            {kLimits.v_max, kReserve * kLimits.a_max, kReserve * kLimits.j_max}, way);
    compare("a turn", time_of({waypoint(zero, zero), waypoint(zero, way * kOblique)}, jerk),
            {kLimits.w_max, kReserve * kLimits.alpha_max, kReserve * kLimits.dalpha_max}, way);
  }
}

/// In the middle of a blend at a right angle |p'| = sqrt(1/2) and |p''| = 3/4 sqrt(2) / L, across
/// it, so that the squared speed is at most 1/2 a L / (3/4 sqrt(2)), in whatever plane it lies.
void the_tip_passes_a_blend_at_the_speed_that_its_curvature_allows(void**) {
  RetimeSettings round = settings(false);
  round.bounds.v *= 100.0;
  round.bounds.j *= 100.0;
  round.corners.radius = 0.2;
  const Eigen::Quaterniond turned = exp_so3(Vector3(0.4, 0.9, -0.3));
  const Vector3 first = turned * Vector3::UnitX(), second = turned * Vector3::UnitY();
  const Vector3 zero = Vector3::Zero();
  const std::vector<Numbers> path = {waypoint(zero, zero), waypoint(first, zero),
                                     waypoint(first + second, zero)};
  double nearest = 1.0, speed = 0.0;
  for (const TimedPoint& now : retime(path, round)) {
    const Vector3 v = now.dq.head<3>();
    const double distance = std::abs(v.dot(first) - v.dot(second)) / v.norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    speed = v.norm();
  }
  assert_true(time_of(path, round) < time_of(path, settings(false)));
  ASSERT_NEAR(speed, std::sqrt(0.5 * round.bounds.a[0] * 0.2 / (0.75 * std::sqrt(2.0))), 0.01);
}

// Proves CTL-18.

/// By central differences; those of a rotation are in axes that do not turn.
void the_derivatives_of_a_rounded_corner_are_those_of_its_poses(void**) {
  const std::vector<PathSection> sections = blend(kBent, true, {two(0.1, 1.0), 0.0});
  assert_int_equal(sections.size(), 1);
  constexpr double h = 1e-4;
  for (const PathPiece& piece : sections[0].pieces) {
    for (int i = 0; i <= 20; ++i) {
      const double s = h + (piece.length - 2.0 * h) * i / 20.0;
      const PathPlace last = piece.at(s - h), now = piece.at(s), next = piece.at(s + h);
      const Eigen::Quaterniond r = orientation(last.q);
      const Vector3 turn = r * log_so3(r.conjugate() * orientation(next.q));
      ASSERT_NEAR((turn / (2.0 * h) - now.dq.tail<3>().matrix()).norm(), 0.0, 1e-5);
      const Numbers way = (next.q - last.q).head<3>();
      ASSERT_NEAR((way / (2.0 * h) - now.dq.head<3>()).matrix().norm(), 0.0, 1e-5);
      ASSERT_NEAR(((next.dq - last.dq) / (2.0 * h) - now.ddq).matrix().norm(), 0.0, 1e-5);
      ASSERT_NEAR(((next.ddq - last.ddq) / (2.0 * h) - now.dddq).matrix().norm(), 0.0, 1e-3);
    }
  }
}

// Proves CTL-19.

void a_rounded_corner_is_as_far_as_the_tolerances_of_place_and_orientation_allow(void**) {
  for (const bool jerk : {false, true}) {
    for (const Numbers& tolerance : {two(0.01, 1.0), two(1.0, 0.02), two(0.002, 0.002)}) {
      RetimeSettings round = settings(jerk);
      round.corners.tolerance = tolerance;
      double near = 1.0, turned = 1.0;
      for (const TimedPoint& now : retime(kBent, round)) {
        near = std::min(near, distance(now.q, kBent[1]));
        turned = std::min(turned, angle(now.q, kBent[1]));
      }
      const double used = std::max(near / tolerance[0], turned / tolerance[1]);
      assert_true(used >= 0.99 && used <= 1.2);  // no waypoint need be in the middle
    }
  }
}

void the_tip_stops_where_its_rotation_changes_and_has_no_tolerance(void**) {
  for (const bool turns : {false, true}) {
    std::vector<Numbers> path = kBent;
    for (Numbers& x : path)
      if (!turns) x.tail<4>() = kBent[0].tail<4>();
    RetimeSettings round = settings(true);
    round.corners.tolerance = two(0.01, 0.0);
    double slowest = 1.0;
    const std::vector<TimedPoint> points = retime(path, round);
    for (const TimedPoint& now : points)
      if (distance(now.q, path[1]) < 0.1)
        slowest = std::min(slowest, now.dq.head<3>().matrix().norm());
    assert_true(turns ? slowest == 0.0 : slowest > 0.1);
  }
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_line_takes_the_time_of_bang_bang_in_any_direction),
      cmocka_unit_test(a_rotation_in_one_place_takes_the_time_of_bang_bang_about_any_axis),
      cmocka_unit_test(the_slower_of_line_and_rotation_decides_from_stop_to_stop),
      cmocka_unit_test(a_jerk_bound_costs_the_tip_little_more_than_the_least_time),
      cmocka_unit_test(the_tip_passes_a_blend_at_the_speed_that_its_curvature_allows),
      cmocka_unit_test(the_derivatives_of_a_rounded_corner_are_those_of_its_poses),
      cmocka_unit_test(a_rounded_corner_is_as_far_as_the_tolerances_of_place_and_orientation_allow),
      cmocka_unit_test(the_tip_stops_where_its_rotation_changes_and_has_no_tolerance),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
