// How an offset goes to zero: the difference between a reference and what it follows, axis by axis,
// one period at a time, by the state-to-state law of math/axis_motion.hpp. Nothing is planned
// ahead: from the state it has reached the law finds the rest of the same motion.
//
// An offset at rest, or moving along itself, goes straight to zero: x(t) = s(t) x, one law for s
// within the limits of all axes over their share of the way. Any other takes every axis to zero by
// itself, stretched to the time that the slowest needs, so that all arrive together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "kernel/math/axis_motion.hpp"

namespace tactus {

template <int N>
struct Offset {
  using Vector = Eigen::Matrix<double, N, 1>;
  Vector x = Vector::Zero(), dx = Vector::Zero(), ddx = Vector::Zero();

  bool zero() const { return x == Vector::Zero() && dx == x && ddx == x; }
  AxisState axis(int i) const { return {x[i], dx[i], ddx[i]}; }
  void set(int i, const AxisState& state) { x[i] = state.p, dx[i] = state.v, ddx[i] = state.a; }
};

/// Of j dt^2 and j dt^3: how far velocity and position can be from what acceleration and velocity
/// at both ends of a period say, while the jerk is at most j.
inline constexpr double kVelocityGap = 0.25, kPositionGap = 0.0320751;  // 1/4, 1/(18 sqrt(3))
inline constexpr double kPositionRounding = 1e-13;                      // m or rad

/// Room without bounds, as large as a plan can count with.
inline constexpr AxisRange kAnywhere = {-1e9, 1e9};

/// What a line from x to zero may do, s being 1 at x: velocity, acceleration and jerk of s.
class LineLimits {
 public:
  /// An axis has `way` to go. [any]
  void add(double way, const AxisLimits& axis);
  const AxisLimits& limits() const { return limits_; }

 private:
  AxisLimits limits_ = {-kUnlimited, kUnlimited, kUnlimited, kUnlimited, kUnlimited};
  static constexpr double kUnlimited = 1e300;
};

/// True if the offset moves along itself and its stop on that line ends between where it is and
/// zero, so that a motion on the line leaves no room that both ends lie in: `s` is its state on the
/// line, at 1. What rounding adds to its direction when little of it is left, 1e-9 of the velocity
/// limits and ten times that of the accelerations', is left out. [cyclic]
template <int N>
bool on_line(const Offset<N>& offset, const std::array<AxisLimits, N>& limits,
             const AxisLimits& line, AxisState& s) {
  constexpr double kAlong = 1e-9, kBeyond = 1e-9;
  const double length = offset.x.squaredNorm();
  if (!(length > 0.0)) return false;
  s = {1.0, offset.dx.dot(offset.x) / length, offset.ddx.dot(offset.x) / length};
  for (int i = 0; i < N; ++i) {
    const AxisLimits& axis = limits[static_cast<std::size_t>(i)];
    const double v = std::abs(offset.dx[i] - s.v * offset.x[i]);
    const double a = std::abs(offset.ddx[i] - s.a * offset.x[i]);
    if (!(v <= kAlong * (axis.v_hi - axis.v_lo) && a <= 10.0 * kAlong * (axis.a_up + axis.a_dn)))
      return false;
  }
  const AxisRange stop = stop_range(s, line);
  return stop.lowest >= -kBeyond && stop.highest <= 1.0 + kBeyond;
}

/// The offset one period on, on its line. [cyclic]
template <int N>
void follow_line(Offset<N>& offset, const AxisState& s, const AxisLimits& limits, double dt_s) {
  const AxisState next = plan_to(s, 0.0, 0.0, limits).at(dt_s);
  offset.dx = next.v * offset.x;
  offset.ddx = next.a * offset.x;
  offset.x *= next.p;
}

/// The offset one period on, all axes arriving together; positions inside `room`, as far as
/// plan_inside() can. [cyclic]
template <int N>
void synchronise(Offset<N>& offset, const std::array<AxisLimits, N>& limits,
                 const std::array<AxisRange, N>& room, double dt_s) {
  std::array<AxisPlan, N> plans;
  double duration = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    plans[i] = plan_inside(offset.axis(static_cast<int>(i)), 0.0, limits[i], room[i].lowest,
                           room[i].highest);
    duration = std::max(duration, plans[i].duration());
  }
  for (std::size_t i = 0; i < N; ++i) {
    const AxisState axis = offset.axis(static_cast<int>(i));
    static_cast<void>(stretch(plans[i], axis, 0.0, 0.0, limits[i], duration));
    offset.set(static_cast<int>(i), plans[i].at(dt_s));
  }
}

/// What is left to an axis beside one that moves from v, a to the next v, a in a period: at least
/// kLeast of its own limits. Velocity counts what the acceleration adds while the axis can brake.
/// [cyclic]
AxisLimits left_beside(const AxisLimits& own, const AxisState& now, const AxisState& next,
                       double dt_s);

}  // namespace tactus
