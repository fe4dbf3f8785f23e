// Tests that the kernel's admission takes random paths of the tip, once retimed, as they are. What
// it takes is sampled, too: velocity, acceleration and jerk by differences of poses.
#include <array>

#include "kernel/reference/motion/admission.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/gateway/ctl/tip_paths.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus::ctl {
namespace {

TaskSpace::Point point(const TimedPoint& from) {
  TaskSpace::Point to;
  to.x = {from.q.head<3>(), orientation(from.q)};
  to.v = from.dq;
  to.a = from.ddq;
  return to;
}

TaskSpace::Segment segment(const TimedPoint& from, const TimedPoint& to, bool jerk) {
  return {point(from), point(to), to.time_s - from.time_s,
          jerk ? Interpolation::kQuintic : Interpolation::kCubic, 0};
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

// Proves CTL-18.

void every_random_path_is_admitted_as_it_is_and_keeps_every_bound(void**) {
  Random random(31);
  for (int trial = 0; trial < tries(150, 40); ++trial) {
    const std::vector<Numbers> path = random_path(random, trial);
    const RetimeSettings one = random_settings(random, trial);
    const std::vector<TimedPoint> points = retime(path, one);
    const Verdict verdict = admitted(points, one.jerk);
    if (!verdict.ok())
      print_error("trial %d: waypoint %d, axis %d, %g of %g\n", trial, verdict.waypoint,
                  verdict.axis, verdict.value, verdict.limit);
    ASSERT_OK(verdict.status);
    const std::array<double, 3> most = sampled(points, one);
    assert_true(most[0] <= 1.0 + 1e-5 && most[1] <= 1.0 + 1e-5);
    assert_true(most[2] <= 1.0 + 1e-3);  // of differences of third order
    for (const bool end : {false, true}) {
      const TimedPoint& there = end ? points.back() : points.front();
      const Numbers& wanted = end ? path.back() : path.front();
      ASSERT_NEAR(distance(there.q, wanted), 0.0, 1e-12);
      ASSERT_NEAR(angle(there.q, wanted), 0.0, 1e-12);
      ASSERT_NEAR(there.dq.abs().maxCoeff(), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace tactus::ctl

int main() {
  using namespace tactus::ctl;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_random_path_is_admitted_as_it_is_and_keeps_every_bound),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
