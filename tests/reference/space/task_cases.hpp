// Seeded points and segments for the tests of the task space.
#pragma once

#include "kernel/reference/space/task_space.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

using TaskPoint = TaskSpace::Point;
using TaskSegment = TaskSpace::Segment;

inline constexpr std::array<Interpolation, 3> kJoins = {
    Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic};

inline Vector6 six(const Vector3& linear, const Vector3& angular) {
  Vector6 vector;
  vector << linear, angular;
  return vector;
}

/// Returns a point with this rotation, which moves about as fast.
inline TaskPoint task_point(RandomVectors& random, const RotationBoundary& rotation) {
  TaskPoint point;
  point.x = {random.vector(), rotation.r};
  point.v = six(rotation.w.norm() * random.vector(), rotation.w);
  point.a = six(rotation.alpha.norm() * random.vector(), rotation.alpha);
  point.h = six(50.0 * random.vector(), 5.0 * random.vector());
  return point;
}

/// Ends of a segment, and its duration.
struct TaskEnds {
  TaskPoint from, to;
  double T = 1.0;
  TaskSegment join(Interpolation how) const { return {from, to, T, how, 0}; }
};

inline TaskEnds task_ends(RandomVectors& random, int kind, double rate) {
  const Ends ends = random_ends(random, kind, rate);
  return {task_point(random, ends.from), task_point(random, ends.to), ends.T};
}

/// Calls check(ends) for random ends of every kind, the same in every run; the ends turn at up to
/// `rate` radians per duration about each axis.
template <class Check>
void over_task_ends(double rate, Check check) {
  constexpr int kCases = 200;
  RandomVectors random;
  for (int i = 0; i < kCases; ++i) check(task_ends(random, i, rate));
}

inline double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return log_so3(a.conjugate() * b).norm();
}

/// Asserts that v and a are the derivatives of the pose, and dh that of the wrench, of a motion
/// given by point(dt), dt seconds from now; the motion changes no faster than `fast`, 1/s.
template <class Motion>
void assert_derivatives(Motion point, double fast) {
  const double h = 0.05 / fast;
  const TaskPoint now = point(0.0);
  const auto p = [&](double dt) -> Vector3 { return point(dt).x.p; };
  const auto r = [&](double dt) -> Eigen::Vector4d { return point(dt).x.r.coeffs(); };
  const auto wrench = [&](double dt) -> Vector6 { return point(dt).h; };
  const Eigen::Quaterniond dr(Eigen::Vector4d(first_derivative(r, h)));
  const Eigen::Quaterniond ddr(Eigen::Vector4d(second_derivative(r, h)));
  const double velocity = 1e-9 * fast, acceleration = 1e-8 * fast * fast;
  assert_close(first_derivative(p, h), now.v.head<3>(), velocity);
  assert_close(second_derivative(p, h), now.a.head<3>(), acceleration);
  // r' = w r / 2 and r'' = (alpha r + w r') / 2, where w w is a real number.
  assert_close(2.0 * (dr * now.x.r.conjugate()).vec(), now.v.tail<3>(), velocity);
  assert_close(2.0 * (ddr * now.x.r.conjugate()).vec(), now.a.tail<3>(), acceleration);
  ASSERT_NEAR((first_derivative(wrench, h) - now.dh).norm(), 0.0, 100.0 * velocity);
}

/// Returns a bound of the rate at which a segment changes, 1/s.
inline double fastest(const TaskSegment& segment) {
  const VectorBounds most = segment.rotation().bounds();
  return std::max({most.v, std::sqrt(most.a), 10.0 / segment.duration()});
}

}  // namespace tactus
