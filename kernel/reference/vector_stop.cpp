#include "kernel/reference/vector_stop.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

/// Of the limit: an acceleration that is nearer to the line of the velocity is on it.
constexpr double kAlong = 1e-9;
/// Speeds do not bound a stop.
constexpr double kAnySpeed = 1e6;

/// The motion on a line: its direction and the one axis along it.
struct Line {
  Vector3 direction;
  AxisState axis;
  AxisLimits limits;
};

Line line_of(const VectorState& state, double a_max, double j_max) {
  const double speed = state.v.norm(), pull = state.a.norm();
  Vector3 direction = Vector3::UnitX();
  if (speed > 0.0)
    direction = state.v / speed;
  else if (pull > 0.0)
    direction = state.a / pull;
  return {direction,
          {0.0, speed, state.a.dot(direction)},
          {-kAnySpeed, kAnySpeed, a_max, a_max, j_max}};
}

bool on_line(const VectorState& state, const Line& line, double a_max) {
  return (state.a - line.axis.a * line.direction).norm() <= kAlong * a_max;
}

VectorState moved(const VectorState& from, double t, const Vector3& jerk) {
  return {from.p + t * (from.v + t * (0.5 * from.a + (t / 6.0) * jerk)),
          from.v + t * (from.a + 0.5 * t * jerk), from.a + t * jerk};
}

VectorState stop_on_line(const VectorState& from, const Line& line, double dt_s) {
  const AxisState axis = plan_stop(line.axis, line.limits).at(dt_s);
  return {from.p + axis.p * line.direction, axis.v * line.direction, axis.a * line.direction};
}

/// The acceleration is run out, `t` from now.
VectorState run_out(const VectorState& from, double j_max, double& t) {
  const double pull = from.a.norm();
  t = pull / j_max;
  VectorState rest = moved(from, t, -(j_max / pull) * from.a);
  rest.a.setZero();
  return rest;
}

}  // namespace

VectorState stop_on(const VectorState& from, double a_max, double j_max, double dt_s) {
  const Line line = line_of(from, a_max, j_max);
  if (on_line(from, line, a_max)) return stop_on_line(from, line, dt_s);
  double t = 0.0;
  const VectorState straight = run_out(from, j_max, t);
  if (dt_s <= t) return moved(from, dt_s, -(j_max / from.a.norm()) * from.a);
  return stop_on_line(straight, line_of(straight, a_max, j_max), dt_s - t);
}

AxisRange stop_range(const VectorState& from, double a_max, double j_max, int axis) {
  const double p = from.p[axis];
  AxisRange range = {p, p};
  const auto add = [&range](double passed) {
    range = {std::min(range.lowest, passed), std::max(range.highest, passed)};
  };
  Line line = line_of(from, a_max, j_max);
  VectorState straight = from;
  if (!on_line(from, line, a_max)) {
    double t = 0.0;
    straight = run_out(from, j_max, t);
    line = line_of(straight, a_max, j_max);
    // Where v + a t - j t^2 / 2 = 0 before that: the first root is reached if v is against a.
    const double v = from.v[axis], a = from.a[axis], j = j_max * a / from.a.norm();
    const double turn = a * a + 2.0 * j * v;
    if (v * a < 0.0 && turn > 0.0) {
      const double at = 2.0 * std::abs(v) / (std::abs(a) + std::sqrt(turn));
      if (at < t) add(p + at * (v + at * (0.5 * a - at * j / 6.0)));
    }
  }
  const AxisRange along = stop_range(line.axis, line.limits);
  add(straight.p[axis]);
  add(straight.p[axis] + along.lowest * line.direction[axis]);
  add(straight.p[axis] + along.highest * line.direction[axis]);
  return range;
}

}  // namespace tactus
