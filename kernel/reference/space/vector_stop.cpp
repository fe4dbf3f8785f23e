#include "kernel/reference/space/vector_stop.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

/// Fraction of j_max: while the speed falls, an acceleration across the velocity that this much
/// jerk removes in one period counts as zero, and the jerk along the line is reduced by it.
/// Reducing it first would take the whole jerk from the stop.
constexpr double kAlong = 0.02;
/// Fraction of a_max: an acceleration that raises the speed by less counts as none.
constexpr double kRising = 1e-9;
/// A stop has no speed limit.
constexpr double kAnySpeed = 1e6;

/// The motion on a line: its direction and the one axis along it.
struct Line {
  Vector3 direction;
  AxisState axis;
  AxisLimits limits;
  bool straight;  // the stop is on it from now on
};

Line line_of(const VectorState& state, double a_max, double j_max, double dt_s) {
  const double speed = state.v.norm(), pull = state.a.norm();
  Vector3 direction = Vector3::UnitX();
  if (speed > 0.0)
    direction = state.v / speed;
  else if (pull > 0.0)
    direction = state.a / pull;
  const double along = state.a.dot(direction);
  const double beside = (state.a - along * direction).norm() / dt_s, most = kAlong * j_max;
  return {direction,
          {0.0, speed, along},
          {-kAnySpeed, kAnySpeed, a_max, a_max, j_max - std::min(beside, most)},
          along <= kRising * a_max && beside <= most};
}

VectorState moved(const VectorState& from, double t, const Vector3& jerk) {
  return {from.p + t * (from.v + t * (0.5 * from.a + (t / 6.0) * jerk)),
          from.v + t * (from.a + 0.5 * t * jerk), from.a + t * jerk};
}

VectorState stop_on_line(const VectorState& from, const Line& line, double dt_s) {
  const AxisState axis = plan_stop(line.axis, line.limits).at(dt_s);
  return {from.p + axis.p * line.direction, axis.v * line.direction, axis.a * line.direction};
}

/// Returns the state in which the acceleration has been reduced to zero, `t` seconds from now.
VectorState run_out(const VectorState& from, double j_max, double& t) {
  const double pull = from.a.norm();
  t = pull / j_max;
  VectorState rest = moved(from, t, -(j_max / pull) * from.a);
  rest.a.setZero();
  return rest;
}

void add(AxisRange& range, double passed) {
  range = {std::min(range.lowest, passed), std::max(range.highest, passed)};
}

/// Where v + a t - j t^2 / 2 = 0 before `end`, none if that is zero: the first root is reached if v
/// is against a.
void add_turn(AxisRange& range, const AxisState& from, double j, double end) {
  const double v = from.v, a = from.a, turn = a * a + 2.0 * j * v;
  if (!(v * a < 0.0 && turn > 0.0)) return;
  const double at = 2.0 * std::abs(v) / (std::abs(a) + std::sqrt(turn));
  if (at < end) add(range, from.p + at * (v + at * (0.5 * a - at * j / 6.0)));
}

}  // namespace

VectorState stop_on(const VectorState& from, double a_max, double j_max, double dt_s) {
  const Line line = line_of(from, a_max, j_max, dt_s);
  if (line.straight) return stop_on_line(from, line, dt_s);
  double t = 0.0;
  const VectorState straight = run_out(from, j_max, t);
  if (dt_s <= t) return moved(from, dt_s, -(j_max / from.a.norm()) * from.a);
  return stop_on_line(straight, line_of(straight, a_max, j_max, dt_s), dt_s - t);
}

std::array<AxisRange, 3> stop_ranges(const VectorState& from, double a_max, double j_max,
                                     double dt_s) {
  const Line now = line_of(from, a_max, j_max, dt_s);
  double t = 0.0;
  const VectorState straight = now.straight ? from : run_out(from, j_max, t);
  const Line line = now.straight ? now : line_of(straight, a_max, j_max, dt_s);
  const AxisRange along = stop_range(line.axis, line.limits);
  const double pull = from.a.norm();
  std::array<AxisRange, 3> ranges;
  for (int i = 0; i < 3; ++i) {
    AxisRange& range = ranges[static_cast<std::size_t>(i)] = {from.p[i], from.p[i]};
    add_turn(range, {from.p[i], from.v[i], from.a[i]}, j_max * from.a[i] / pull, t);
    add(range, straight.p[i]);
    add(range, straight.p[i] + along.lowest * line.direction[i]);
    add(range, straight.p[i] + along.highest * line.direction[i]);
  }
  return ranges;
}

}  // namespace tactus
