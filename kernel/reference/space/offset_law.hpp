// The law that takes an offset, the difference between a reference and what it follows, to zero one
// period at a time, by the state-to-state law of math/axis_motion.hpp. Nothing is planned ahead:
// from the state reached the law finds the rest of the same motion.
//
// An offset at rest, or moving along itself, goes straight to zero: x(t) = s(t) x, with one law for
// s within the limits of all axes over their share of the way. In any other case each axis goes to
// zero by itself. If the base is at rest, the axes are stretched to the time of the slowest and
// arrive together; if it moves, its limits change in every period and each axis arrives as soon as
// it can.
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

  bool zero() const { return x == Vector::Zero() && dx == Vector::Zero() && ddx == Vector::Zero(); }
  AxisState axis(int i) const { return {x[i], dx[i], ddx[i]}; }
  void set(int i, const AxisState& state) {
    x[i] = state.p;
    dx[i] = state.v;
    ddx[i] = state.a;
  }
};

/// With a jerk of at most j, velocity and position differ from the trapezoidal rule over a period,
/// for the position the corrected one, by at most kVelocityGap j dt^2 and kPositionGap j dt^3.
inline constexpr double kVelocityGap = 0.25, kPositionGap = 0.0320751;  // 1/4, 1/(18 sqrt(3))
inline constexpr double kPositionRounding = 1e-13;                      // m or rad
/// Rounding allowed to a state at a limit, as a fraction of the limit.
inline constexpr double kStateRounding = 3e-10;

/// An unbounded position range, as large as a plan can use.
inline constexpr AxisRange kAnywhere = {-1e9, 1e9};

/// Limits of s on the line from x, where s is 1, to zero: velocity, acceleration and jerk.
class LineLimits {
 public:
  /// Adds the limits of an axis that has the signed distance `way` on the line. [any]
  void add(double way, const AxisLimits& axis);
  const AxisLimits& limits() const { return limits_; }

 private:
  AxisLimits limits_ = {-kUnlimited, kUnlimited, kUnlimited, kUnlimited, kUnlimited};
  static constexpr double kUnlimited = 1e300;
};

/// Moves the offset one period ahead on its line if it moves along itself and would stop on that
/// line between its place and zero, so that the motion stays in every convex range that contains
/// both ends; else returns false, with no effect. Deviations from the line by rounding are ignored:
/// 1e-9 of the velocity limits and 1e-8 of the acceleration limits. [cyclic]
template <int N>
bool move_on_line(Offset<N>& offset, const std::array<AxisLimits, N>& limits,
                  const AxisLimits& line, double dt_s) {
  constexpr double kAlong = 1e-9, kBeyond = 1e-9;
  const double length = offset.x.squaredNorm();
  if (!(length > 0.0)) return false;
  const AxisState s = {1.0, offset.dx.dot(offset.x) / length, offset.ddx.dot(offset.x) / length};
  for (int i = 0; i < N; ++i) {
    const AxisLimits& axis = limits[static_cast<std::size_t>(i)];
    const double v = std::abs(offset.dx[i] - s.v * offset.x[i]);
    const double a = std::abs(offset.ddx[i] - s.a * offset.x[i]);
    if (!(v <= kAlong * (axis.v_hi - axis.v_lo) && a <= 10.0 * kAlong * (axis.a_up + axis.a_dn)))
      return false;
  }
  const AxisRange stop = stop_range(s, line);
  if (!(stop.lowest >= -kBeyond && stop.highest <= 1.0 + kBeyond)) return false;
  const AxisState next = plan_to(s, 0.0, 0.0, line).at(dt_s);
  offset.dx = next.v * offset.x;
  offset.ddx = next.a * offset.x;
  offset.x *= next.p;
  return true;
}

/// Moves the offset one period ahead, with all axes arriving `together` or each as soon as it can,
/// and positions inside `room` as far as plan_inside() can keep them there. [cyclic]
template <int N>
void follow_axes(Offset<N>& offset, const std::array<AxisLimits, N>& limits,
                 const std::array<AxisRange, N>& room, bool together, double dt_s) {
  std::array<AxisPlan, N> plans;
  double duration = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    plans[i] = plan_inside(offset.axis(static_cast<int>(i)), 0.0, limits[i], room[i].lowest,
                           room[i].highest);
    duration = std::max(duration, plans[i].duration());
  }
  for (std::size_t i = 0; i < N; ++i) {
    const AxisState axis = offset.axis(static_cast<int>(i));
    if (together) static_cast<void>(stretch(plans[i], axis, 0.0, 0.0, limits[i], duration));
    offset.set(static_cast<int>(i), plans[i].at(dt_s));
  }
}

/// Returns own - taken, but at least a twentieth of `own`, so that a reference that lags a motion
/// at the limits still catches up. [any]
double left_of(double own, double taken);

/// Returns the limits that remain for the offset of an axis whose base moves from `now` to `next`
/// in a period. The velocity includes what the acceleration adds before the axis can brake. A jerk
/// beyond the limit is a step of the path and takes nothing. [cyclic]
AxisLimits left_beside(const AxisLimits& own, const AxisState& now, const AxisState& next,
                       double dt_s);

}  // namespace tactus
