// Tests that a retimed trajectory, as the kernel plays it, passes every waypoint within tolerance,
// where the path bends so gently that few waypoints of the trajectory are in a rounded corner.
#include "kernel/reference/space/task_space.hpp"
#include "tests/gateway/ctl/tip_paths.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus::ctl {
namespace {

/// Returns the least of a function on [0, T]: of 101 samples and, twice, of as many around the
/// least of the last.
template <class Function>
double least(Function value, double T) {
  double begin = 0.0, end = T, lowest = value(0.0);
  for (int stage = 0; stage < 3; ++stage) {
    const double step = (end - begin) / 100.0, first = begin;
    for (int i = 0; i <= 100; ++i) {
      const double t = first + step * i, here = value(t);
      if (here > lowest) continue;
      lowest = here;
      begin = std::max(0.0, t - step);
      end = std::min(T, t + step);
    }
  }
  return lowest;
}

/// Distance of a waypoint from what is played between two points, as a fraction of the tolerances.
double distance_of_joints(const Numbers& wanted, const TimedPoint& from, const TimedPoint& to,
                          const RetimeSettings& settings) {
  const Interpolation order = settings.jerk ? Interpolation::kQuintic : Interpolation::kCubic;
  const auto away = [&](double t) {
    double most = 0.0;
    for (int k = 0; k < wanted.size(); ++k) {
      const Polynomial q = join(order, Boundary{from.q[k], from.dq[k], from.ddq[k]},
                                Boundary{to.q[k], to.dq[k], to.ddq[k]}, to.time_s - from.time_s);
      most = std::max(most, std::abs(q.at(t) - wanted[k]) / settings.corners.tolerance[k]);
    }
    return most;
  };
  return least(away, to.time_s - from.time_s);
}

double distance_of_tip(const Numbers& wanted, const TimedPoint& from, const TimedPoint& to,
                       const RetimeSettings& settings) {
  const auto point_of = [](const TimedPoint& one) {
    TaskSpace::Point point;
    point.x = {one.q.head<3>(), orientation(one.q)};
    point.v = one.dq;
    point.a = one.ddq;
    return point;
  };
  const TaskSpace::Segment segment = {
      point_of(from), point_of(to), to.time_s - from.time_s,
      settings.jerk ? Interpolation::kQuintic : Interpolation::kCubic, 0};
  const Numbers& tolerance = settings.corners.tolerance;
  const auto away = [&](double t) {
    const Pose x = segment.at(t).x;
    const Numbers there = waypoint(x.p, x.r);
    return std::max(distance(there, wanted) / tolerance[0], angle(there, wanted) / tolerance[1]);
  };
  return least(away, to.time_s - from.time_s);
}

/// Returns how far the motion stays away from a waypoint, as a fraction of the tolerances: least
/// beside the point of the motion that is nearest.
double missed_by(const Numbers& wanted, const std::vector<TimedPoint>& points,
                 const RetimeSettings& settings) {
  const auto far = [&](const TimedPoint& point) {
    return settings.tip ? distance(point.q, wanted) + angle(point.q, wanted)
                        : (point.q - wanted).matrix().norm();
  };
  const auto nearest =
      std::min_element(points.begin(), points.end(),
                       [&](const TimedPoint& a, const TimedPoint& b) { return far(a) < far(b); });
  const auto distance_of = settings.tip ? distance_of_tip : distance_of_joints;
  double least = std::numeric_limits<double>::infinity();
  if (nearest != points.begin()) least = distance_of(wanted, *(nearest - 1), *nearest, settings);
  if (nearest + 1 != points.end())
    least = std::min(least, distance_of(wanted, *nearest, *(nearest + 1), settings));
  return least;
}

/// Lines of the tip, or of three joints of six, whose direction changes little from each to the
/// next.
std::vector<Numbers> gently_bent_path(Random& random, bool tip) {
  const Vector3 zero = Vector3::Zero();
  std::vector<Numbers> path = {tip ? waypoint(zero, zero) : Numbers::Zero(6)};
  Vector3 way = anywhere(random, 1.0).normalized(), turn = anywhere(random, 1.0).normalized();
  for (int i = 0; i < 4; ++i) {
    const double bend = std::pow(10.0, between(random, -3.0, -0.5));
    const double far = std::pow(10.0, between(random, -2.5, -0.3));
    way = (way + bend * anywhere(random, 1.0)).normalized();
    turn = (turn + bend * anywhere(random, 1.0)).normalized();
    const Numbers& last = path.back();
    if (tip) {
      path.push_back(waypoint(last.head<3>().matrix() + far * way,
                              (orientation(last) * exp_so3(far * turn)).normalized()));
    } else {
      Numbers q(6);
      q << last.head<3>() + far * way.array(), last.tail<3>() + far * turn.array();
      path.push_back(q);
    }
  }
  return path;
}

// Proves CTL-22.

void no_waypoint_is_missed_by_more_than_the_tolerance(void**) {
  Random random(2027);
  double worst = 0.0;
  int missed = 0;
  for (int trial = 0; trial < tries(60, 16); ++trial) {
    const bool tip = trial % 2 == 0;
    RetimeSettings one = settings(trial % 3 != 0);
    if (!tip)
      one.bounds = {Numbers::Constant(6, 2.0), Numbers::Constant(6, 5.0),
                    Numbers::Constant(6, 500.0)};
    one.tip = tip;
    one.steps = 200;
    const std::vector<Numbers> path = gently_bent_path(random, tip);
    one.corners.tolerance =
        Numbers::Constant(one.bounds.v.size(), std::pow(10.0, between(random, -6.0, -4.0)));
    const std::vector<TimedPoint> points = retime(path, one);
    for (const Numbers& wanted : path) {
      const double by = missed_by(wanted, points, one);
      worst = std::max(worst, by);
      missed += by > 1.0 ? 1 : 0;
    }
  }
  print_message("at most %.3f of the tolerance away; %d waypoints missed\n", worst, missed);
  assert_int_equal(missed, 0);
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_waypoint_is_missed_by_more_than_the_tolerance),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
