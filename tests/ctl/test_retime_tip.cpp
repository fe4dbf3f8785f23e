// Tests retiming of the tip: analytic least times, corners, and random paths, which the kernel's
// admission must take as they are. What it takes is sampled, too: velocity, acceleration and jerk
// by differences of poses.
#include <algorithm>
#include <array>
#include <random>

#include "gateway/ctl/retime/retimer.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/reference/motion/admission.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace tactus::ctl {
namespace {

const tactus::TaskLimits kLimits;
constexpr double kReserve = 0.98;  // of acceleration and jerk; the rest is for stops

Numbers two(double translation, double rotation) {
  return Eigen::Array2d(translation, rotation);
}

RetimeSettings settings(bool jerk) {
  RetimeSettings settings;
  settings.tip = true;
  settings.bounds = {two(kLimits.v_max, kLimits.w_max),
                     kReserve * two(kLimits.a_max, kLimits.alpha_max),
                     kReserve * two(kLimits.j_max, kLimits.dalpha_max)};
  settings.jerk = jerk;
  return settings;
}

Numbers waypoint(const Vector3& p, const Eigen::Quaterniond& r) {
  Numbers x(7);
  x << p.array(), r.w(), r.x(), r.y(), r.z();
  return x;
}
Numbers waypoint(const Vector3& p, const Vector3& phi) {
  return waypoint(p, exp_so3(phi));
}

TaskSpace::Point point(const TimedPoint& from) {
  TaskSpace::Point to;
  to.x = {from.q.head<3>(), {from.q[3], from.q[4], from.q[5], from.q[6]}};
  to.v = from.dq;
  to.a = from.ddq;
  return to;
}

TaskSpace::Segment segment(const TimedPoint& from, const TimedPoint& to, bool jerk) {
  return {point(from), point(to), to.time_s - from.time_s,
          jerk ? Interpolation::kQuintic : Interpolation::kCubic, 0};
}

double angle(const TaskSpace::Point& a, const Numbers& b) {
  return log_so3(a.x.r.conjugate() * Eigen::Quaterniond(b[3], b[4], b[5], b[6])).norm();
}

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
    ASSERT_NEAR(taken, least, 2e-3 * least);  // admission's bounds of a long turn are above it
  }
}

void the_slower_of_line_and_rotation_decides(void**) {
  for (const double turn : {0.1, 2.0}) {
    const double way = 0.8, a = kReserve * kLimits.a_max, alpha = kReserve * kLimits.alpha_max;
    // Both keep pace, so that the slower one bounds velocity and acceleration by themselves.
    const double v_s = std::min(kLimits.v_max / way, kLimits.w_max / turn);
    const double a_s = std::min(a / way, alpha / turn);
    const double taken = time_of({waypoint(Vector3::Zero(), Vector3::Zero()),
                                  waypoint(way * kOblique, turn * Vector3::UnitY())},
                                 settings(false));
    ASSERT_NEAR(taken, bang_bang(1.0, v_s, a_s), 2e-3 * taken);
  }
}

void a_jerk_bound_costs_the_tip_little_more_than_the_least_time(void**) {
  const RetimeSettings jerk = settings(true);
  const auto compare = [](double taken, const SymmetricLimits& limits, double way) {
    const double least = TimeOptimum(limits).time_s(0.0, 0.0, way);
    assert_true(taken >= least * (1.0 - 1e-9));
    print_message("%g: %.4f\n", way, taken / least);
    assert_true(taken <= least * (way >= 2.0 ? 1.03 : way >= 0.2 ? 1.05 : 1.15));
  };
  const Vector3 zero = Vector3::Zero();
  for (const double way : {0.02, 0.2, 2.0}) {
    compare(time_of({waypoint(zero, zero), waypoint(way * kOblique, zero)}, jerk),
            {kLimits.v_max, kReserve * kLimits.a_max, kReserve * kLimits.j_max}, way);
    compare(time_of({waypoint(zero, zero), waypoint(zero, way * kOblique)}, jerk),
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
  double nearest = 1.0, speed = 0.0;
  for (const TimedPoint& now : retime(
           {waypoint(zero, zero), waypoint(first, zero), waypoint(first + second, zero)}, round)) {
    const Vector3 v = now.dq.head<3>();
    const double distance = std::abs(v.dot(first) - v.dot(second)) / v.norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    speed = v.norm();
  }
  ASSERT_NEAR(speed, std::sqrt(0.5 * round.bounds.a[0] * 0.2 / (0.75 * std::sqrt(2.0))), 0.01);
}

// Proves CTL-18.

using Random = std::mt19937;
double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
Vector3 anywhere(Random& random, double most) {
  Vector3 v;
  for (double& number : v) number = between(random, -most, most);
  return v;
}

std::vector<Numbers> random_path(Random& random, int trial) {
  std::vector<Numbers> path = {waypoint(anywhere(random, 1.9), exp_so3(anywhere(random, 3.0)))};
  for (int i = 0; i < 1 + trial % 5; ++i) {
    const double far = std::pow(10.0, between(random, -2.0, 0.0));
    const Numbers& last = path.back();
    Vector3 p = last.head<3>();
    Eigen::Quaterniond r(last[3], last[4], last[5], last[6]);
    const int kind = static_cast<int>(random() % 4);  // 0: turns only; 1: does not turn
    if (kind != 0) p = (p + anywhere(random, 2.0 * far)).cwiseMin(1.9).cwiseMax(-1.9);
    if (kind != 1) r = (r * exp_so3(anywhere(random, 1.8 * far))).normalized();
    path.push_back(waypoint(p, r));
  }
  return path;
}

RetimeSettings random_settings(Random& random, int trial) {
  RetimeSettings one = settings(trial % 2 == 0);
  one.steps = 200;
  if (trial % 3 != 0)
    one.corners.tolerance = two(std::pow(10.0, between(random, -3.5, -1.0)),
                                std::pow(10.0, between(random, -3.0, -0.5)));
  if (trial % 9 == 1) one.corners.tolerance[1] = 0.0;
  return one;
}

/// Returns what admission says of points that must be passed in exactly their times.
Verdict admitted(const std::vector<TimedPoint>& points, bool jerk) {
  static std::array<Waypoint<TaskSpace>, kMostWaypoints> store;
  Trajectory<TaskSpace> trajectory;
  trajectory.waypoints = store.data();
  trajectory.capacity = kMostWaypoints;
  trajectory.fields = jerk ? kVelocityField | kAccelerationField : kVelocityField;
  trajectory.exact = true;
  for (const TimedPoint& from : points) {
    if (trajectory.count == kMostWaypoints) return {Status::kReferenceSize};
    Waypoint<TaskSpace> one;
    one.time_s = from.time_s;
    one.point = point(from);
    trajectory.set(trajectory.count++, one);
  }
  AdmissionSettings<TaskSpace> admission;
  admission.limits = kLimits;
  admission.period_s = 0.01;
  return admit(trajectory, admission);
}

/// The largest of velocity, acceleration and jerk inside of the segments as fractions of the
/// bounds, by differences of positions and, in the chart of the pose in the middle, of rotations.
std::array<double, 3> sampled(const std::vector<TimedPoint>& points,
                              const RetimeSettings& settings) {
  const MotionBounds& bounds = settings.bounds;
  std::array<double, 3> most{};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const TaskSpace::Segment curve = segment(points[i - 1], points[i], settings.jerk);
    const double h = curve.duration() / 40.0;
    for (int n = 2; n <= 38; n += 4) {
      const Pose middle = curve.at(h * n).x;
      const auto beside = [&](int k) {
        const Pose x = curve.at(h * (n + k)).x;
        return stacked(x.p - middle.p, log_so3(middle.r.conjugate() * x.r));
      };
      const Vector6 a = beside(-2), b = beside(-1), c = beside(1), d = beside(2);
      const Vector6 first = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
      const Vector6 second = (-a + 16.0 * b + 16.0 * c - d) / (12.0 * h * h);
      Vector6 third = (-a + 2.0 * b - 2.0 * c + d) / (2.0 * h * h * h);
      third.tail<3>() += 0.5 * first.tail<3>().cross(second.tail<3>());
      for (int k = 0; k < 2; ++k) {
        most[0] = std::max(most[0], first.segment<3>(3 * k).norm() / bounds.v[k]);
        most[1] = std::max(most[1], second.segment<3>(3 * k).norm() / bounds.a[k]);
        most[2] = std::max(most[2], third.segment<3>(3 * k).norm() / bounds.j[k]);
      }
    }
  }
  return most;
}

void every_random_path_is_admitted_as_it_is_and_keeps_every_bound(void**) {
  Random random(31);
  std::array<double, 3> loosest = {1.0, 1.0, 1.0};
  for (int trial = 0; trial < 3000; ++trial) {
    const std::vector<Numbers> path = random_path(random, trial);
    const RetimeSettings one = random_settings(random, trial);
    const std::vector<TimedPoint> points = retime(path, one);
    const Verdict verdict = admitted(points, one.jerk);
    if (!verdict.ok())
      print_error("trial %d: waypoint %d, axis %d, %g of %g\n", trial, verdict.waypoint,
                  verdict.axis, verdict.value, verdict.limit);
    ASSERT_OK(verdict.status);
    const std::array<double, 3> most = sampled(points, one);
    for (std::size_t k = 0; k < most.size(); ++k) {
      if (k < 2 || one.jerk) assert_true(most[k] <= 1.0 + 1e-5);
    }
    loosest[0] = std::min(loosest[0], std::max(most[0], most[1]));
    for (const bool end : {false, true}) {
      const TimedPoint& there = end ? points.back() : points.front();
      const Numbers& wanted = end ? path.back() : path.front();
      ASSERT_NEAR((there.q.head<3>() - wanted.head<3>()).abs().maxCoeff(), 0.0, 1e-12);
      ASSERT_NEAR(angle(point(there), wanted), 0.0, 1e-12);
      ASSERT_NEAR(there.dq.abs().maxCoeff(), 0.0, 1e-12);
    }
  }
  print_message("the least of the largest fractions: %.4f\n", loosest[0]);
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_line_takes_the_time_of_bang_bang_in_any_direction),
      cmocka_unit_test(a_rotation_in_one_place_takes_the_time_of_bang_bang_about_any_axis),
      cmocka_unit_test(the_slower_of_line_and_rotation_decides),
      cmocka_unit_test(a_jerk_bound_costs_the_tip_little_more_than_the_least_time),
      cmocka_unit_test(the_tip_passes_a_blend_at_the_speed_that_its_curvature_allows),
      cmocka_unit_test(every_random_path_is_admitted_as_it_is_and_keeps_every_bound),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
