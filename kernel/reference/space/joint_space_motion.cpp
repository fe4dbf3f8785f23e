// JointSpace: references that differ, and the way of the joints from one to another and to rest, by
// the laws of offset_law.hpp joint by joint.
#include "kernel/reference/space/joint_space.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

/// Distance kept from the ends of a position range while following a moving base, rad: the rounding
/// of many periods.
constexpr double kInset = 1e-8;

AxisLimits axis_limits(const JointLimits& limits, int j) {
  return {-limits.dq_max[j], limits.dq_max[j], limits.ddq_max[j], limits.ddq_max[j],
          limits.dddq_max[j]};
}

AxisState axis_of(const JointSpace::Point& point, int j) {
  return {point.q[j], point.dq[j], point.ddq[j]};
}

/// True if velocity and position change by the trapezoidal rule over acceleration and velocity, up
/// to what a jerk of at most j can do in between (Peano kernels of the rule and its correction).
bool derived(const AxisState& before, const AxisState& after, double j, double dt_s) {
  const double v = after.v - before.v - 0.5 * dt_s * (before.a + after.a);
  const double p = after.p - before.p - 0.5 * dt_s * (before.v + after.v) +
                   dt_s * dt_s / 12.0 * (after.a - before.a);
  return std::abs(v) <= kVelocityGap * j * dt_s * dt_s + kPositionRounding / dt_s &&
         std::abs(p) <= kPositionGap * j * dt_s * dt_s * dt_s + kPositionRounding;
}

/// True if one period takes a joint from `before` to `after` within its limits, it can stop within
/// them, and velocity and acceleration are derivatives as far as jerk lets them differ. `steps`:
/// the base may step, as the acceleration of a cubic does; the reference may follow such a step.
bool within_limits(const AxisState& before, const AxisState& after, const AxisLimits& limits,
                   const AxisRange& range, bool steps, double dt_s) {
  const double most = 1.0 + kStateRounding, change = limits.j * dt_s * most;
  const double run_out = after.v + 0.5 * after.a * std::abs(after.a) / limits.j;
  const double gap = after.p - before.p - 0.5 * dt_s * (before.v + after.v);
  const AxisRange stop = stop_range(after, limits);
  return (steps ||
          (std::abs(after.a - before.a) <= change && derived(before, after, limits.j, dt_s))) &&
         std::abs(gap) <= 0.25 * limits.a_up * dt_s * dt_s * most + kPositionRounding &&
         std::abs(after.p - before.p) <= limits.v_hi * dt_s * most &&
         std::abs(after.v - before.v) <= limits.a_up * dt_s * most &&
         std::abs(after.v) <= limits.v_hi * most && std::abs(run_out) <= limits.v_hi * most &&
         std::abs(after.a) <= limits.a_up * most && stop.lowest >= range.lowest + kInset &&
         stop.highest <= range.highest - kInset;
}

/// Returns the state of joint j in the next period if closing its offset would break a limit: the
/// offset comes to rest and is kept while the base uses up the limits. If that breaks one too, the
/// joint goes to rest at the position of the base, which is always possible.
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
  point.q[j] = state.p;
  point.dq[j] = state.v;
  point.ddq[j] = state.a;
}

}  // namespace

JointSpace::Difference JointSpace::difference(const Point& a, const Point& b) {
  return {a.q - b.q, a.dq - b.dq, a.ddq - b.ddq};
}

JointSpace::Point JointSpace::sum(const Point& b, const Difference& d) {
  return {b.q + d.x, b.dq + d.dx, b.ddq + d.ddx, b.tau};
}

JointSpace::Point JointSpace::approach(const Point& reference, Difference& offset,
                                       const Point& base, const Point& next, bool steps,
                                       const Limits& limits, double dt_s) {
  const bool moves = !(base.standing() && next.standing());
  std::array<AxisLimits, kDof> left;
  std::array<AxisRange, kDof> room;
  LineLimits line;
  LoopBound<kDof> lines;
  for (int j = 0; j < kDof; ++j) {
    lines.tick();
    const auto i = static_cast<std::size_t>(j);
    left[i] = left_beside(axis_limits(limits, j), axis_of(base, j), axis_of(next, j), dt_s);
    room[i] = kAnywhere;
    if (!moves) room[i] = {limits.q_min[j] - next.q[j], limits.q_max[j] - next.q[j]};
    line.add(offset.x[j], left[i]);
  }
  const Difference before = offset;
  if (!move_on_line<kDof>(offset, left, line.limits(), dt_s))
    follow_axes<kDof>(offset, left, room, !moves, dt_s);
  Point point = sum(next, offset);
  LoopBound<kDof> axes;
  for (int j = 0; moves && j < kDof; ++j) {
    axes.tick();
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

bool JointSpace::can_stop(const Point& reference, const Limits& limits, double /*dt_s*/) {
  constexpr double kBeyond = 1e-9;
  for (int j = 0; j < kDof; ++j) {
    const AxisRange stop = stop_range(axis_of(reference, j), axis_limits(limits, j));
    if (!(stop.lowest >= std::min(limits.q_min[j], reference.q[j]) - kBeyond)) return false;
    if (!(stop.highest <= std::max(limits.q_max[j], reference.q[j]) + kBeyond)) return false;
  }
  return true;
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

/// A velocity is the speed limit of a way to the end of the range.
JointSpace::Point JointSpace::go_at(const Point& reference, const Rates& rates,
                                    const Limits& limits, double acceleration, double jerk,
                                    double dt_s) {
  const Point stop = come_to_rest(reference, limits, dt_s);
  Point point;
  for (int j = 0; j < kDof; ++j) {
    const AxisState from = axis_of(reference, j);
    const AxisRange range = {limits.q_min[j] + kInset, limits.q_max[j] - kInset};
    AxisLimits most = axis_limits(limits, j);
    const AxisLimits own = most;
    most.a_dn = most.a_up = acceleration * own.a_up;
    most.j = jerk * own.j;
    if (rates[j] > 0.0) most.v_hi = std::min(rates[j], own.v_hi);
    if (rates[j] < 0.0) most.v_lo = std::max(rates[j], own.v_lo);
    const double end = rates[j] > 0.0 ? range.highest : range.lowest;
    const AxisPlan plan = rates[j] == 0.0
                              ? plan_stop(from, most)
                              : plan_inside(from, end, most, range.lowest, range.highest);
    const AxisState next = plan.at(dt_s);
    const AxisRange way = stop_range(next, own);
    const double run_out = next.v + 0.5 * next.a * std::abs(next.a) / own.j;
    const bool inside = std::abs(run_out) <= own.v_hi &&
                        way.lowest >= std::min(range.lowest, from.p) &&
                        way.highest <= std::max(range.highest, from.p);
    set_axis(point, j, inside ? next : axis_of(stop, j));
  }
  return point;
}

}  // namespace tactus
