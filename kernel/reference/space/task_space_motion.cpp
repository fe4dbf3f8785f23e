// TaskSpace: the way of the tool tip to what it follows, and to rest. The limits bound the lengths
// of velocity, acceleration and jerk, of the translation and of the rotation.
//
// On a line each length is the magnitude of one number, and the limits are met exactly. An offset
// that moves across its line comes to rest first, relative to a moving base, and then goes straight
// to zero. A rotation is no vector, so the sum of base and offset is judged: if it would exceed a
// limit, the period is taken from the stop instead.
#include "kernel/reference/space/task_space.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/vector_stop.hpp"

namespace tactus {
namespace {

constexpr double kRoomRounding = 1e-10;  // m, for a target on a side of the workspace

/// Limits of lengths, of a translation or a rotation: m/s, m/s^2, m/s^3, or in rad.
struct NormLimits {
  double v, a, j;
};

NormLimits translation_limits(const TaskLimits& limits) {
  return {limits.v_max, limits.a_max, limits.j_max};
}
NormLimits rotation_limits(const TaskLimits& limits) {
  return {limits.w_max, limits.alpha_max, limits.dalpha_max};
}

AxisLimits symmetric(const NormLimits& most) {
  return {-most.v, most.v, most.a, most.a, most.j};
}

VectorState translation_of(const TaskSpace::Point& point) {
  return {point.x.p, point.v.head<3>(), point.a.head<3>()};
}
/// The rotation counted from the present orientation, so the rotation vector is zero.
VectorState rotation_of(const TaskSpace::Point& point) {
  return {Vector3::Zero(), point.v.tail<3>(), point.a.tail<3>()};
}

/// Returns the limits that a base leaves to its offset. The base counts with the lengths of its
/// velocity, acceleration and jerk, whatever their direction.
NormLimits left(const NormLimits& own, const VectorState& now, const VectorState& next,
                double dt_s) {
  const AxisState before = {0.0, now.v.norm(), now.a.norm()};
  const AxisState after = {0.0, next.v.norm(), next.a.norm()};
  const AxisLimits rest = left_beside(symmetric(own), before, after, dt_s);
  const double jerk = (next.a - now.a).norm() / dt_s;
  return {rest.v_hi, rest.a_up, left_of(own.j, jerk < own.j ? jerk : 0.0)};
}

/// Returns the limits of a rotation vector whose base turns at `w`, rad/s, such that the rotation
/// keeps `most`: |alpha| <= |ddphi| + |dphi|^2 / 2 + w |dphi|, with three quarters for |ddphi|.
NormLimits rotation_vector(const NormLimits& most, double w) {
  const double v = std::sqrt(w * w + 0.5 * most.a) - w;
  return {std::min(most.v, v), 0.75 * most.a, 0.5 * most.j};
}

/// Returns the limits of a rotation vector on a line. The base turns its axis, which adds w |dphi|
/// to the acceleration and 2 w |ddphi| + (w^2 + |alpha|) |dphi| to the jerk.
NormLimits line_beside(const NormLimits& most, double w) {
  if (!(w > 0.0)) return most;
  return {std::min(most.v, 0.25 * most.a / w), 0.75 * most.a,
          std::max(most.j - 3.0 * w * most.a, 0.5 * most.j)};
}

/// True if a translation or a rotation changes velocity and acceleration within limits in one
/// period, as for a joint; position and angle are not judged.
bool within(const VectorState& before, const VectorState& after, const NormLimits& most, bool steps,
            double dt_s) {
  const double rounding = 1.0 + kStateRounding, change = most.j * dt_s * rounding;
  const Vector3 run_out = after.v + 0.5 * after.a * after.a.norm() / most.j;
  const Vector3 gap = after.v - before.v - 0.5 * dt_s * (before.a + after.a);
  const bool smooth = (after.a - before.a).norm() <= change &&
                      gap.norm() <= kVelocityGap * dt_s * change + kPositionRounding / dt_s;
  return (steps || smooth) && (after.v - before.v).norm() <= most.a * dt_s * rounding &&
         after.v.norm() <= most.v * rounding && run_out.norm() <= most.v * rounding &&
         after.a.norm() <= most.a * rounding;
}

/// True if the position changes by what velocity and acceleration at both ends say, as for a joint.
bool derived(const VectorState& before, const VectorState& after, const NormLimits& most,
             double dt_s) {
  const Vector3 gap = after.p - before.p - 0.5 * dt_s * (before.v + after.v) +
                      dt_s * dt_s / 12.0 * (after.a - before.a);
  return gap.norm() <= kPositionGap * most.j * dt_s * dt_s * dt_s + kPositionRounding;
}

/// True if the position changes by no more than v_max allows in a period.
bool moved_within(const VectorState& before, const VectorState& after, double v_max, double dt_s) {
  return (after.p - before.p).norm() <= v_max * dt_s * (1.0 + kStateRounding);
}

/// True if the orientation changes by no more than w_max allows in a period. The angle is computed
/// only if the angular velocities do not already show it.
bool turned_within(const TaskSpace::Point& before, const TaskSpace::Point& after, double w_max,
                   bool steps, double dt_s) {
  if (!steps && (before.v + after.v).tail<3>().norm() < 1.9 * w_max) return true;
  const double angle = log_so3(before.x.r.conjugate() * after.x.r).norm();
  return angle <= w_max * dt_s * (1.0 + kStateRounding);
}

/// True if the tip can stop inside its workspace, or, from outside, goes no further out.
bool inside(const Vector3& before, const VectorState& after, const TaskLimits& limits,
            double rounding, double dt_s) {
  const NormLimits most = translation_limits(limits);
  const std::array<AxisRange, 3> ranges = stop_ranges(after, most.a, most.j, dt_s);
  for (int i = 0; i < 3; ++i) {
    const AxisRange range = ranges[static_cast<std::size_t>(i)];
    const double lowest = std::min(limits.p_min[i] - rounding, before[i]);
    const double highest = std::max(limits.p_max[i] + rounding, before[i]);
    if (!(range.lowest >= lowest && range.highest <= highest)) return false;
  }
  return true;
}

/// True if one period takes the tip from `before` to `after` within its limits and it can stop
/// within them. `steps`: the base may step, and the reference may follow such a step.
bool within_limits(const TaskSpace::Point& before, const TaskSpace::Point& after,
                   const TaskLimits& limits, bool steps, double dt_s) {
  const NormLimits p = translation_limits(limits), r = rotation_limits(limits);
  const VectorState from = translation_of(before), to = translation_of(after);
  return within(from, to, p, steps, dt_s) && (steps || derived(from, to, p, dt_s)) &&
         moved_within(from, to, p.v, dt_s) &&
         within(rotation_of(before), rotation_of(after), r, steps, dt_s) &&
         turned_within(before, after, r.v, steps, dt_s) &&
         inside(from.p, to, limits, kRoomRounding, dt_s);
}

/// Limits of the offset: translation, rotation vector on a line, rotation vector off a line.
struct Allowed {
  NormLimits p, r, phi;
};

/// Moves translation and rotation along their common line; false, with no effect, if the offset
/// does not move along it.
bool move_on_line(TaskSpace::Difference& offset, const Allowed& allowed, double dt_s) {
  const AxisLimits p = symmetric(allowed.p), r = symmetric(allowed.r);
  LineLimits line;
  line.add(offset.x.head<3>().norm(), p);
  line.add(offset.x.tail<3>().norm(), r);
  return tactus::move_on_line<6>(offset, {p, p, p, r, r, r}, line.limits(), dt_s);
}

/// Brings three axes of an offset, from `first` on, one period closer to rest.
void rest_axes(TaskSpace::Difference& offset, int first, const NormLimits& most, double dt_s) {
  const VectorState rest = stop_on(
      {offset.x.segment<3>(first), offset.dx.segment<3>(first), offset.ddx.segment<3>(first)},
      most.a, most.j, dt_s);
  offset.x.segment<3>(first) = rest.p;
  offset.dx.segment<3>(first) = rest.v;
  offset.ddx.segment<3>(first) = rest.a;
}

/// Brings the offset one period closer to rest, where it then stays.
void rest_offset(TaskSpace::Difference& offset, const Allowed& allowed, double dt_s) {
  rest_axes(offset, 0, allowed.p, dt_s);
  rest_axes(offset, 3, allowed.phi, dt_s);
}

/// Returns R turned by a rotation from w0 to w1 in dt_s in the base frame, to the fourth order: the
/// integral of w, and a term for rotations about different axes, which do not commute.
/// [Magnus 1954; Iserles, Munthe-Kaas, Norsett, Zanna, Lie-group methods, 2000, eq. 4.14]
Eigen::Quaterniond turned(const Eigen::Quaterniond& r, const VectorState& from,
                          const VectorState& to, double dt_s) {
  const Vector3 apart = (dt_s * dt_s / 12.0) * to.v.cross(from.v);
  return exp_so3(to.p + apart) * r;
}

}  // namespace

// With R_a = R_b exp(phi), the angular velocity w = J_r(phi) dphi of exp(phi) in a's frame and
// u = R_a w, the same in the base frame,
//   omega_a = omega_b + u,
//   alpha_a = alpha_b + omega_a x u + R_a dw/dt = alpha_b + omega_b x u + R_a dw/dt,
//   dw/dt = J_r ddphi + dJ_r/dt dphi.

TaskSpace::Point TaskSpace::sum(const Point& b, const Difference& d) {
  const Vector3 phi = d.x.tail<3>(), dphi = d.dx.tail<3>(), ddphi = d.ddx.tail<3>();
  const RightJacobian j(phi);
  const Vector3 omega = b.v.tail<3>();
  Point a = b;
  a.x = {b.x.p + d.x.head<3>(), unit(b.x.r) * exp_so3(phi)};
  const Vector3 u = a.x.r * j.times(dphi);
  const Vector3 dw = j.times(ddphi) + j.rate_times(dphi, dphi);
  a.v.head<3>() += d.dx.head<3>();
  a.v.tail<3>() += u;
  a.a.head<3>() += d.ddx.head<3>();
  a.a.tail<3>() += omega.cross(u) + a.x.r * dw;
  return a;
}

TaskSpace::Difference TaskSpace::difference(const Point& a, const Point& b) {
  const Eigen::Quaterniond base_in_a = unit(a.x.r).conjugate();
  const Vector3 omega = b.v.tail<3>();
  const Vector3 phi = log_so3(b.x.r.conjugate() * a.x.r);
  const RightJacobian j(phi);
  const Vector3 u = a.v.tail<3>() - omega;
  const Vector3 dw = base_in_a * (a.a.tail<3>() - b.a.tail<3>() - omega.cross(u));
  const Vector3 dphi = j.inverse_times(base_in_a * u);
  return {stacked(a.x.p - b.x.p, phi), stacked(a.v.head<3>() - b.v.head<3>(), dphi),
          stacked(a.a.head<3>() - b.a.head<3>(), j.inverse_times(dw - j.rate_times(dphi, dphi)))};
}

void TaskSpace::keep_sign(Point& point, const Point& before) {
  if (point.x.r.dot(before.x.r) < 0.0) point.x.r.coeffs() = -point.x.r.coeffs();
}

TaskSpace::Rates TaskSpace::in_base(const Rates& rates, const Point& tip) {
  return stacked(tip.x.r * rates.head<3>(), tip.x.r * rates.tail<3>());
}

TaskSpace::Point TaskSpace::approach(const Point& reference, Difference& offset, const Point& base,
                                     const Point& next, bool steps, const Limits& limits,
                                     double dt_s) {
  Allowed allowed;
  allowed.p = left(translation_limits(limits), translation_of(base), translation_of(next), dt_s);
  const NormLimits r = left(rotation_limits(limits), rotation_of(base), rotation_of(next), dt_s);
  const double turning = next.v.tail<3>().norm();
  allowed.r = line_beside(r, turning);
  allowed.phi = rotation_vector(r, turning);
  const Difference before = offset;
  if (move_on_line(offset, allowed, dt_s)) {
    const Point point = sum(next, offset);
    if (within_limits(reference, point, limits, steps, dt_s)) return point;
    offset = before;
  }
  if (!(base.standing() && next.standing())) {
    rest_offset(offset, allowed, dt_s);
    const Point point = sum(next, offset);
    if (within_limits(reference, point, limits, steps, dt_s)) return point;
  }
  Point point = come_to_rest(reference, limits, dt_s);
  point.h = next.h;
  point.dh = next.dh;
  offset = difference(point, next);
  return point;
}

bool TaskSpace::can_stop(const Point& reference, const Limits& limits, double dt_s) {
  constexpr double kBeyond = 1e-9;
  return inside(reference.x.p, translation_of(reference), limits, kBeyond, dt_s);
}

TaskSpace::Point TaskSpace::come_to_rest(const Point& reference, const Limits& limits,
                                         double dt_s) {
  const NormLimits p = translation_limits(limits), r = rotation_limits(limits);
  const VectorState moved = stop_on(translation_of(reference), p.a, p.j, dt_s);
  const VectorState from = rotation_of(reference), to = stop_on(from, r.a, r.j, dt_s);
  return {{moved.p, turned(reference.x.r, from, to, dt_s)},
          stacked(moved.v, to.v),
          stacked(moved.a, to.a)};
}

TaskSpace::Point TaskSpace::rest_of(const Point& reference, const Limits& limits) {
  constexpr double kLongest_s = 1e3;  // no stop takes longer
  return come_to_rest(reference, limits, kLongest_s).at_rest();
}

/// In a frame that moves at the velocity to be reached, the way there is a stop.
TaskSpace::Point TaskSpace::go_at(const Point& reference, const Rates& rates, const Limits& limits,
                                  double acceleration, double jerk, double dt_s) {
  const NormLimits p = translation_limits(limits), r = rotation_limits(limits);
  const auto go = [&](VectorState from, const Vector3& v, const NormLimits& most) {
    from.v -= v;
    VectorState to = stop_on(from, acceleration * most.a, jerk * most.j, dt_s);
    to.p += dt_s * v;
    to.v += v;
    const Vector3 run_out = to.v + 0.5 * to.a * to.a.norm() / most.j;
    from.v += v;
    return run_out.norm() <= most.v ? to : stop_on(from, most.a, most.j, dt_s);
  };
  const VectorState from = rotation_of(reference);
  VectorState moved = go(translation_of(reference), rates.head<3>(), p);
  const VectorState to = go(from, rates.tail<3>(), r);
  if (!inside(reference.x.p, moved, limits, kRoomRounding, dt_s))
    moved = stop_on(translation_of(reference), p.a, p.j, dt_s);
  return {{moved.p, turned(reference.x.r, from, to, dt_s)},
          stacked(moved.v, to.v),
          stacked(moved.a, to.a)};
}

}  // namespace tactus
