// How the joints go to what they follow, and to rest: the laws of offset_law.hpp, joint by joint.
#include <algorithm>
#include <cmath>

#include "kernel/reference/joint_space.hpp"

namespace tactus {
namespace {

/// Rounding that a state at a limit may have, of that limit.
constexpr double kRounding = 3e-10;
/// Of a range, rad: what its end is kept from beside a moving base, for the rounding of many
/// periods.
constexpr double kInset = 1e-8;
/// Of the acceleration limits, which hold at the samples of a path: so they do between them.
constexpr double kBetweenSamples = 0.997;
/// Of the jerk limits, for a path beside an offset.
constexpr double kPathJerk = 0.5;

AxisLimits axis_limits(const JointLimits& limits, int j) {
  return {-limits.dq_max[j], limits.dq_max[j], limits.ddq_max[j], limits.ddq_max[j],
          limits.dddq_max[j]};
}

AxisState axis_of(const JointSpace::Point& point, int j) {
  return {point.q[j], point.dq[j], point.ddq[j]};
}

/// Velocity and position change by what acceleration and velocity at both ends say, but for what a
/// jerk of at most j can do meanwhile (kernels of Peano for the trapezium and its correction).
bool derived(const AxisState& before, const AxisState& after, double j, double dt_s) {
  const double v = after.v - before.v - 0.5 * dt_s * (before.a + after.a);
  const double p = after.p - before.p - 0.5 * dt_s * (before.v + after.v) +
                   dt_s * dt_s / 12.0 * (after.a - before.a);
  return std::abs(v) <= kVelocityGap * j * dt_s * dt_s + kPositionRounding / dt_s &&
         std::abs(p) <= kPositionGap * j * dt_s * dt_s * dt_s + kPositionRounding;
}

/// One period takes joint j from `before` to `after` within its limits, it can stop within them,
/// and each is the derivative of the one before, as far as jerk lets it differ. Where the base
/// steps by nature, a cubic its acceleration, that is no fault of the reference.
bool within_limits(const AxisState& before, const AxisState& after, const AxisLimits& limits,
                   const AxisRange& range, bool steps, double dt_s) {
  const double most = 1.0 + kRounding, change = limits.j * dt_s * most;
  const double run_out = after.v + 0.5 * after.a * std::abs(after.a) / limits.j;
  const AxisRange stop = stop_range(after, limits);
  return (steps ||
          (std::abs(after.a - before.a) <= change && derived(before, after, limits.j, dt_s))) &&
         std::abs(after.v - before.v) <= limits.a_up * dt_s * most &&
         std::abs(after.v) <= limits.v_hi * most && std::abs(run_out) <= limits.v_hi * most &&
         std::abs(after.a) <= limits.a_up * most && stop.lowest >= range.lowest + kInset &&
         stop.highest <= range.highest - kInset;
}

/// Where joint j goes in this period when the offset it had at best leaves a limit: it keeps the
/// offset it comes to rest at, beside a base that takes all there is; otherwise it is on its way to
/// rest at the base, which is always possible.
AxisState yield(const JointSpace::Point& reference, const AxisState& offset, const AxisLimits& left,
                const JointSpace::Point& next, const JointLimits& limits, int j, bool steps,
                double dt_s) {
  const AxisLimits own = axis_limits(limits, j);
  const AxisRange range = {limits.q_min[j], limits.q_max[j]};
  const AxisState from = axis_of(reference, j), to = axis_of(next, j);
  const AxisState kept = plan_stop(offset, left).at(dt_s);
  const AxisState beside = {to.p + kept.p, to.v + kept.v, to.a + kept.a};
  if (within_limits(from, beside, own, range, steps, dt_s)) return beside;
  return plan_inside(from, to.p, own, range.lowest, range.highest).at(dt_s);
}

void set_axis(JointSpace::Point& point, int j, const AxisState& state) {
  point.q[j] = state.p, point.dq[j] = state.v, point.ddq[j] = state.a;
}

}  // namespace

JointSpace::Peaks JointSpace::left_to_path(const Limits& limits, const Difference& offset) {
  Peaks left = peaks(limits);
  for (double& a : left.a) a *= kBetweenSamples;
  if (offset.zero()) return left;
  for (std::size_t i = 0; i < kDof; ++i) {
    left.a[i] = std::max(left.a[i] - std::abs(offset.ddx[static_cast<int>(i)]), 0.0);
    left.j[i] *= kPathJerk;
  }
  return left;
}

JointSpace::Point JointSpace::approach(const Point& reference, Difference& offset,
                                       const Point& base, const Point& next, bool steps,
                                       const Limits& limits, double dt_s) {
  const bool moves = !(base.standing() && next.standing());
  std::array<AxisLimits, kDof> left;
  std::array<AxisRange, kDof> room;
  LineLimits line;
  for (int j = 0; j < kDof; ++j) {
    const auto i = static_cast<std::size_t>(j);
    left[i] = left_beside(axis_limits(limits, j), axis_of(base, j), axis_of(next, j), dt_s);
    room[i] = kAnywhere;
    if (!moves) room[i] = {limits.q_min[j] - next.q[j], limits.q_max[j] - next.q[j]};
    line.add(offset.x[j], left[i]);
  }
  const Difference before = offset;
  AxisState s;
  if (on_line<kDof>(offset, left, line.limits(), s))
    follow_line<kDof>(offset, s, line.limits(), dt_s);
  else
    synchronise<kDof>(offset, left, room, dt_s);
  Point point = sum(next, offset);
  for (int j = 0; moves && j < kDof; ++j) {
    const AxisState from = axis_of(reference, j), to = axis_of(next, j);
    const AxisRange range = {limits.q_min[j], limits.q_max[j]};
    if (within_limits(from, axis_of(point, j), axis_limits(limits, j), range, steps, dt_s))
      continue;
    const AxisState now = yield(reference, before.axis(j), left[static_cast<std::size_t>(j)], next,
                                limits, j, steps, dt_s);
    set_axis(point, j, now);
    offset.set(j, {now.p - to.p, now.v - to.v, now.a - to.a});
  }
  return point;
}

JointSpace::Point JointSpace::come_to_rest(const Point& reference, const Limits& limits,
                                           double dt_s) {
  const Point rest = rest_of(reference, limits);
  Point point;
  for (int j = 0; j < kDof; ++j) {
    const AxisPlan plan = plan_inside(axis_of(reference, j), rest.q[j], axis_limits(limits, j),
                                      limits.q_min[j], limits.q_max[j]);
    set_axis(point, j, plan.at(dt_s));
  }
  return point;
}

JointSpace::Point JointSpace::rest_of(const Point& reference, const Limits& limits) {
  Point rest = reference.at_rest();
  for (int j = 0; j < kDof; ++j) {
    const AxisPlan stop = plan_stop(axis_of(reference, j), axis_limits(limits, j));
    rest.q[j] = stop.at(stop.duration()).p;
  }
  return rest;
}

}  // namespace tactus
