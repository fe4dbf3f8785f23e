// Tests that rounding corners never makes a motion longer than stops in all of them, and how far
// apart the waypoints of a retimed motion are.
#include <algorithm>

#include "tests/gateway/ctl/tip_paths.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus::ctl {
namespace {

constexpr double kShortest_s = 0.001;
constexpr double kExact = 1.0 + 1e-9;
constexpr int kPaths = tries(40, 24);

double time_of(const std::vector<Numbers>& path, const RetimeSettings& settings) {
  const std::vector<TimedPoint> points = retime(path, settings);
  assert_true(points.size() >= 2);
  return points.back().time_s;
}

/// Of six joints with the bounds of a UR10.
RetimeSettings of_joints(bool jerk) {
  RetimeSettings settings;
  settings.bounds = {Numbers::Constant(6, 2.0), Numbers::Constant(6, 5.0),
                     Numbers::Constant(6, 500.0)};
  settings.jerk = jerk;
  return settings;
}

/// Ways of all lengths from 1e-7 to 1 beside each other.
std::vector<Numbers> mixed_path(Random& random, bool tip) {
  const Vector3 zero = Vector3::Zero();
  std::vector<Numbers> path = {tip ? waypoint(zero, zero) : Numbers::Zero(6)};
  for (int i = 0; i < 5; ++i) {
    const auto far = [&random] { return std::pow(10.0, between(random, -7.0, 0.0)); };
    const Vector3 first = anywhere(random, 1.0) * far(), second = anywhere(random, 1.0) * far();
    const Numbers& last = path.back();
    const Vector3 p = last.head<3>().matrix() + first;
    if (tip) {
      path.push_back(waypoint(p, (orientation(last) * exp_so3(second)).normalized()));
    } else {
      Numbers q(6);
      q << p.array(), last.tail<3>() + second.array();
      path.push_back(q);
    }
  }
  return path;
}

// Proves CTL-20.

void a_rounded_path_never_takes_longer_than_with_stops(void**) {
  Random random(77);
  int shorter = 0;
  for (int trial = 0; trial < kPaths; ++trial) {
    const bool tip = trial % 2 == 0;
    const std::vector<Numbers> path = mixed_path(random, tip);
    RetimeSettings one = tip ? settings(trial % 3 != 0) : of_joints(trial % 3 != 0);
    one.steps = 200;
    const double stops_s = time_of(path, one);
    Corners& corners = one.corners;
    const auto tolerance = [&random] { return std::pow(10.0, between(random, -5.0, -1.0)); };
    if (tip)
      corners.tolerance = two(tolerance(), tolerance());
    else if (trial % 4 == 1)
      corners.radius = tolerance();
    else
      corners.tolerance = Numbers::Constant(6, tolerance());
    const double rounded_s = time_of(path, one);
    assert_true(rounded_s <= stops_s * kExact);
    shorter += rounded_s < 0.99 * stops_s ? 1 : 0;
  }
  print_message("%d of %d paths are shorter\n", shorter, kPaths);
  assert_true(shorter > kPaths / 10);
}

// Proves CTL-21.

void waypoints_are_at_least_a_millisecond_apart_without_jerk(void**) {
  Random random(9);
  for (int trial = 0; trial < kPaths; ++trial) {
    const bool tip = trial % 2 == 0;
    RetimeSettings one = tip ? settings(false) : of_joints(false);
    if (trial % 3 == 0) one.corners.tolerance = Numbers::Constant(one.bounds.v.size(), 1e-3);
    const std::vector<TimedPoint> points = retime(mixed_path(random, tip), one);
    for (std::size_t i = 1; i < points.size(); ++i)
      assert_true(points[i].time_s - points[i - 1].time_s >= kShortest_s * (1.0 - 1e-9));
  }
}

/// Where the motion neither bends nor changes its acceleration one polynomial is exact.
void a_slow_motion_has_as_many_waypoints_as_a_fast_one(void**) {
  const Vector3 zero = Vector3::Zero();
  for (const bool tip : {false, true}) {
    RetimeSettings one = tip ? settings(true) : of_joints(true);
    one.bounds.v *= 0.5;
    const std::vector<Numbers> path =
        tip ? std::vector<Numbers>{waypoint(zero, zero),
                                   waypoint(Vector3(1.0, 0.5, 0.0), Vector3(0.3, 0.2, 0.9))}
            : std::vector<Numbers>{Numbers::Zero(6), Numbers::LinSpaced(6, -1.0, 2.0)};
    const std::size_t fast = retime(path, one).size();
    one.bounds.v *= 1e-3;
    const std::vector<TimedPoint> slow = retime(path, one);
    assert_true(slow.back().time_s > 500.0);
    assert_true(slow.size() <= fast + 10);
    assert_true(slow.size() < 100);
  }
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_rounded_path_never_takes_longer_than_with_stops),
      cmocka_unit_test(waypoints_are_at_least_a_millisecond_apart_without_jerk),
      cmocka_unit_test(a_slow_motion_has_as_many_waypoints_as_a_fast_one),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
