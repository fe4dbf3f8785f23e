// How the tool tip goes to what it follows, and to rest. Limits are of lengths: of the velocity of
// the tip, of its acceleration and jerk, and likewise of its rotation.
//
// On a line each length is that of one number, and the limits are met exactly. Off a line every
// axis gets a share of them, the larger the more it has to go; the squares of three shares add up
// to one. What a rotation adds by not being a vector is judged on the sum: a period that would
// exceed a limit is taken from the stop instead.
#include <algorithm>
#include <cmath>

#include "kernel/math/so3.hpp"
#include "kernel/reference/task_space.hpp"
#include "kernel/reference/vector_stop.hpp"

namespace tactus {
namespace {

constexpr double kRounding = 3e-10;        // of a limit, that a state at it may have
constexpr double kBetweenSamples = 0.997;  // of an acceleration that holds at samples of a path
constexpr double kPathJerk = 0.5;          // of the limit, for a path beside an offset
constexpr double kLeastShare = 0.2;  // of an axis that has nothing to go, before they are scaled

/// Limits of one length, translation or rotation.
struct Most {
  double v, a, j;
};

Most translation_limits(const TaskLimits& limits) {
  return {limits.v_max, limits.a_max, limits.j_max};
}
Most rotation_limits(const TaskLimits& limits) {
  return {limits.w_max, limits.alpha_max, limits.dalpha_max};
}

AxisLimits symmetric(const Most& most) {
  return {-most.v, most.v, most.a, most.a, most.j};
}

VectorState translation_of(const TaskSpace::Point& point) {
  return {point.x.p, point.v.head<3>(), point.a.head<3>()};
}
/// Its rotation from where it is: a rotation vector of zero.
VectorState rotation_of(const TaskSpace::Point& point) {
  return {Vector3::Zero(), point.v.tail<3>(), point.a.tail<3>()};
}

/// What is left of the limits beside a base.
Most left(const Most& own, const VectorState& now, const VectorState& next, double dt_s) {
  const Vector3 change = next.a - now.a;
  const AxisState before = {0.0, now.v.norm(), now.a.norm()};
  const AxisState after = {0.0, next.v.norm(), next.a.norm()};
  const AxisLimits rest = left_beside(symmetric(own), before, after, dt_s);
  const double jerk = change.norm() / dt_s;
  return {rest.v_hi, std::max(own.a - std::max(before.a, after.a), rest.a_up),
          jerk < own.j ? std::max(own.j - jerk, 0.05 * own.j) : own.j};
}

/// What is left to a rotation vector of the rotation's limits, beside a base that turns at `w`:
/// |alpha| <= |ddphi| + |dphi|^2 / 2 + w |dphi|, of which the first gets three quarters.
Most rotation_vector(const Most& most, double w) {
  const double v = std::sqrt(w * w + 0.5 * most.a) - w;
  return {std::min(most.v, v), 0.75 * most.a, 0.5 * most.j};
}

/// What is left to it on a line: the base turns its axis with it, which adds w |dphi| to the
/// acceleration and 2 w |ddphi| + (w^2 + |alpha|) |dphi| to the jerk.
Most line_beside(const Most& most, double w) {
  if (!(w > 0.0)) return most;
  return {std::min(most.v, 0.25 * most.a / w), 0.75 * most.a,
          std::max(most.j - 3.0 * w * most.a, 0.5 * most.j)};
}

/// Shares of the three axes from `first` on, for what each of them has to do.
Vector3 shares(const Offset<6>& offset, int first, const Most& most) {
  const double t = most.v / most.a;
  Vector3 need;
  for (int i = 0; i < 3; ++i) {
    const int axis = first + i;
    need[i] =
        std::abs(offset.x[axis]) + t * (std::abs(offset.dx[axis]) + t * std::abs(offset.ddx[axis]));
  }
  const double length = need.norm();
  if (!(length > 0.0)) return Vector3::Constant(std::sqrt(1.0 / 3.0));
  return (need / length).cwiseMax(kLeastShare).normalized();
}

/// Of a translation or a rotation, whose angle is not looked at: as for a joint.
bool within(const VectorState& before, const VectorState& after, const Most& most, bool steps,
            double dt_s) {
  const double rounding = 1.0 + kRounding, change = most.j * dt_s * rounding;
  const Vector3 run_out = after.v + 0.5 * after.a * after.a.norm() / most.j;
  const Vector3 gap = after.v - before.v - 0.5 * dt_s * (before.a + after.a);
  const bool smooth = (after.a - before.a).norm() <= change &&
                      gap.norm() <= kVelocityGap * dt_s * change + kPositionRounding / dt_s;
  return (steps || smooth) && (after.v - before.v).norm() <= most.a * dt_s * rounding &&
         after.v.norm() <= most.v * rounding && run_out.norm() <= most.v * rounding &&
         after.a.norm() <= most.a * rounding;
}

/// The way is that of the velocity at both ends, as for a joint, and no longer than it may be.
bool derived(const VectorState& before, const VectorState& after, const Most& most, double dt_s) {
  const Vector3 gap = after.p - before.p - 0.5 * dt_s * (before.v + after.v) +
                      dt_s * dt_s / 12.0 * (after.a - before.a);
  return gap.norm() <= kPositionGap * most.j * dt_s * dt_s * dt_s + kPositionRounding &&
         (after.p - before.p).norm() <= most.v * dt_s * (1.0 + kRounding);
}

/// No angle longer than a period lets it be; looked at where the speed is near its limit.
bool turned_within(const TaskSpace::Point& before, const TaskSpace::Point& after, double w_max,
                   double dt_s) {
  if ((before.v + after.v).tail<3>().norm() < 1.9 * w_max) return true;
  const double angle = log_so3(before.x.r.conjugate() * after.x.r).norm();
  return angle <= w_max * dt_s * (1.0 + kRounding);
}

bool inside(const VectorState& state, const TaskLimits& limits) {
  const Most most = translation_limits(limits);
  for (int i = 0; i < 3; ++i) {
    const AxisRange range = stop_range(state, most.a, most.j, i);
    if (!(range.lowest >= limits.p_min[i] && range.highest <= limits.p_max[i])) return false;
  }
  return true;
}

/// One period takes the tip from `before` to `after` within its limits, and it can stop within
/// them. What a base that steps by nature does is no fault of the reference.
bool within_limits(const TaskSpace::Point& before, const TaskSpace::Point& after,
                   const TaskLimits& limits, bool steps, double dt_s) {
  const Most p = translation_limits(limits), r = rotation_limits(limits);
  const VectorState from = translation_of(before), to = translation_of(after);
  return within(from, to, p, steps, dt_s) && (steps || derived(from, to, p, dt_s)) &&
         within(rotation_of(before), rotation_of(after), r, steps, dt_s) &&
         turned_within(before, after, r.v, dt_s) && inside(to, limits);
}

/// What the offset may do: of the translation, and of the rotation vector off a line.
struct Allowed {
  Most p, r, phi;
};

/// Both lengths on their common line, or every axis with its share.
void move_offset(TaskSpace::Difference& offset, const Allowed& allowed, double dt_s) {
  std::array<AxisLimits, 6> limits;
  for (std::size_t i = 0; i < 6; ++i) limits[i] = symmetric(i < 3 ? allowed.p : allowed.r);
  LineLimits line;
  line.add(offset.x.head<3>().norm(), symmetric(allowed.p));
  line.add(offset.x.tail<3>().norm(), symmetric(allowed.r));
  AxisState s;
  if (on_line<6>(offset, limits, line.limits(), s))
    return follow_line<6>(offset, s, line.limits(), dt_s);
  Vector6 share;
  share << shares(offset, 0, allowed.p), shares(offset, 3, allowed.phi);
  std::array<AxisRange, 6> room;
  room.fill(kAnywhere);
  for (std::size_t i = 0; i < 6; ++i) {
    const Most& most = i < 3 ? allowed.p : allowed.phi;
    const double part = share[static_cast<int>(i)];
    limits[i] = symmetric({part * most.v, part * most.a, part * most.j});
  }
  synchronise<6>(offset, limits, room, dt_s);
}

/// The three axes of an offset from `first` on come to rest where they can.
void rest_axes(TaskSpace::Difference& offset, int first, const Most& most, double dt_s) {
  const VectorState rest = stop_on(
      {offset.x.segment<3>(first), offset.dx.segment<3>(first), offset.ddx.segment<3>(first)},
      most.a, most.j, dt_s);
  offset.x.segment<3>(first) = rest.p;
  offset.dx.segment<3>(first) = rest.v;
  offset.ddx.segment<3>(first) = rest.a;
}

/// The offset comes to rest where it can, and stays.
void rest_offset(TaskSpace::Difference& offset, const Allowed& allowed, double dt_s) {
  rest_axes(offset, 0, allowed.p, dt_s);
  rest_axes(offset, 3, allowed.phi, dt_s);
}

/// R turned by what a rotation from w0 to w1 in dt_s adds up to in the base frame, to the fourth
/// order: the integral of w, and the part by which turnings about other axes do not commute.
/// [Magnus 1954; Iserles, Munthe-Kaas, Norsett, Zanna, Lie-group methods, 2000, eq. 4.14]
Eigen::Quaterniond turned(const Eigen::Quaterniond& r, const VectorState& from,
                          const VectorState& to, double dt_s) {
  const Vector3 apart = (dt_s * dt_s / 12.0) * to.v.cross(from.v);
  return exp_so3(to.p + apart) * r;
}

}  // namespace

TaskSpace::Peaks TaskSpace::left_to_path(const Limits& limits, const Difference& offset) {
  Peaks left = peaks(limits);
  for (double& a : left.a) a *= kBetweenSamples;
  if (offset.zero()) return left;
  for (std::size_t i = 0; i < kChannels; ++i) {
    const double taken = offset.ddx.segment<3>(3 * static_cast<int>(i)).norm();
    left.a[i] = std::max(left.a[i] - taken, 0.0);
    left.j[i] *= kPathJerk;
  }
  return left;
}

TaskSpace::Point TaskSpace::approach(const Point& reference, Difference& offset, const Point& base,
                                     const Point& next, bool steps, const Limits& limits,
                                     double dt_s) {
  Allowed allowed;
  allowed.p = left(translation_limits(limits), translation_of(base), translation_of(next), dt_s);
  const Most r = left(rotation_limits(limits), rotation_of(base), rotation_of(next), dt_s);
  const double turning = next.v.tail<3>().norm();
  allowed.r = line_beside(r, turning);
  allowed.phi = rotation_vector(r, turning);
  const Difference before = offset;
  move_offset(offset, allowed, dt_s);
  Point point = sum(next, offset);
  if (within_limits(reference, point, limits, steps, dt_s)) return point;
  // Beside a base that takes all there is the offset rests; otherwise the tip does.
  offset = before;
  rest_offset(offset, allowed, dt_s);
  point = sum(next, offset);
  if (within_limits(reference, point, limits, steps, dt_s)) return point;
  point = come_to_rest(reference, limits, dt_s);
  point.h = next.h, point.dh = next.dh;
  offset = difference(point, next);
  return point;
}

TaskSpace::Point TaskSpace::come_to_rest(const Point& reference, const Limits& limits,
                                         double dt_s) {
  const Most p = translation_limits(limits), r = rotation_limits(limits);
  const VectorState moved = stop_on(translation_of(reference), p.a, p.j, dt_s);
  const VectorState from = rotation_of(reference), to = stop_on(from, r.a, r.j, dt_s);
  Point point;
  point.x = {moved.p, turned(reference.x.r, from, to, dt_s)};
  point.v << moved.v, to.v;
  point.a << moved.a, to.a;
  return point;
}

TaskSpace::Point TaskSpace::rest_of(const Point& reference, const Limits& limits) {
  constexpr double kLongest_s = 1e3;  // no stop takes longer
  return come_to_rest(reference, limits, kLongest_s).at_rest();
}

}  // namespace tactus
