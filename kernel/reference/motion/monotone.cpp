#include "kernel/reference/motion/monotone.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

/// The secant of one segment in every axis, and its duration; there is none before the first and
/// after the last waypoint.
template <class Space>
struct Secant {
  typename Space::Rates slope = Space::Rates::Zero();
  double duration_s = 0.0;
  bool exists() const { return duration_s > 0.0; }
};

template <class Space>
Secant<Space> secant(const Trajectory<Space>& trajectory, int index) {
  if (index < 1 || index >= trajectory.count) return {};
  const Waypoint<Space> from = trajectory.at(index - 1), to = trajectory.at(index);
  const double T = to.time_s - from.time_s;
  return {Space::secant(from.point, to.point, T), T};
}

/// Returns the harmonic mean of two slopes weighted by their durations; zero if they differ in
/// sign.
double mean_slope(double d0, double T0, double d1, double T1) {
  if (!(d0 * d1 > 0.0)) return 0.0;
  const double w0 = 2.0 * T1 + T0, w1 = T1 + 2.0 * T0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// Returns `v` limited to the range that a segment of slope `d` allows.
double within_slope(double v, double d) {
  return d > 0.0 ? std::clamp(v, 0.0, 3.0 * d) : std::clamp(v, 3.0 * d, 0.0);
}

}  // namespace

template <class Space>
void make_monotone(const Trajectory<Space>& trajectory) {
  const bool given = (trajectory.fields & kVelocityField) != 0;
  Secant<Space> before;
  for (int i = 0; i < trajectory.count; ++i) {
    const Secant<Space> after = secant(trajectory, i + 1);
    Eigen::Map<typename Space::Rates> v(trajectory.numbers(i) + Space::numbers(0));
    for (Eigen::Index axis = 0; axis < v.size(); ++axis) {
      const double d0 = before.slope[axis], d1 = after.slope[axis];
      if (!given) v[axis] = mean_slope(d0, before.duration_s, d1, after.duration_s);
      if (before.exists()) v[axis] = within_slope(v[axis], d0);
      if (after.exists()) v[axis] = within_slope(v[axis], d1);
    }
    before = after;
  }
}

template void make_monotone(const Trajectory<JointSpace>&);
template void make_monotone(const Trajectory<TaskSpace>&);

}  // namespace tactus
