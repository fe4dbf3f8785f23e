// TaskSpace: points and segments measured and judged against the limits of the tool tip.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/reference/space/limit_check.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/reference/space/vector_bounds.hpp"

namespace tactus {
namespace {

constexpr int kTranslation = 0, kRotation = 3;  // axes of a verdict on a length
constexpr double kUnitTolerance = 1e-3;         // of a quaternion's length

/// Returns the first verdict that is not ok.
Verdict first_of(std::initializer_list<Verdict> verdicts) {
  LoopBound<5> asked;
  for (const Verdict& verdict : verdicts) {
    asked.tick();
    if (!verdict.ok()) return verdict;
  }
  return {};
}

Verdict not_finite(double value, int axis) {
  return {Status::kReferenceNotFinite, -1, axis, value, 0.0};
}

Verdict judge_finite(const TaskSpace::Point& point) {
  const Eigen::Quaterniond& r = point.x.r;
  LoopBound<4> numbers;
  for (const double number : {r.w(), r.x(), r.y(), r.z()}) {
    numbers.tick();
    if (!std::isfinite(number)) return not_finite(number, kRotation);
  }
  LoopBound<6> axes;
  for (int i = 0; i < 6; ++i) {
    axes.tick();
    const double given[] = {i < 3 ? point.x.p[i] : 0.0, point.v[i], point.a[i], point.h[i],
                            point.dh[i]};
    LoopBound<5> fields;
    for (const double number : given) {
      fields.tick();
      if (!std::isfinite(number)) return not_finite(number, i);
    }
  }
  return {};
}

Verdict judge_unit(const Eigen::Quaterniond& r) {
  const double length = r.norm(), longest = 1.0 + kUnitTolerance, shortest = 1.0 - kUnitTolerance;
  if (exceeds(length, longest)) return {Status::kQuaternion, -1, kRotation, length, longest};
  if (exceeds(-length, -shortest)) return {Status::kQuaternion, -1, kRotation, length, shortest};
  return {};
}

/// Judges a place on the way from `from`, which may be outside of the workspace.
Verdict judge_place(const Vector3& p, const TaskLimits& limits, const Vector3& from) {
  for (int i = 0; i < 3; ++i) {
    if (exceeds(p[i], std::max(limits.p_max[i], from[i])))
      return {Status::kWorkspace, -1, i, p[i], limits.p_max[i]};
    if (exceeds(-p[i], -std::min(limits.p_min[i], from[i])))
      return {Status::kWorkspace, -1, i, p[i], limits.p_min[i]};
  }
  return {};
}

/// Judges an error against a tolerance, without rounding; NaN is outside.
Verdict within(double error, double tolerance, Status status, int axis) {
  if (error <= tolerance) return {};
  return {status, -1, axis, error, tolerance};
}

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return log_so3(a.conjugate() * b).norm();
}

}  // namespace

Verdict TaskSpace::judge_waypoint(const Point& point, const Limits& limits) {
  return first_of(
      {judge_finite(point), judge_unit(point.x.r), judge_place(point.x.p, limits, limits.p_max),
       at_most(point.h.head<3>().norm(), limits.force_max, Status::kEffortLimit, kTranslation),
       at_most(point.h.tail<3>().norm(), limits.moment_max, Status::kEffortLimit, kRotation)});
}

Verdict TaskSpace::saturate(Point& point, const Limits& limits) {
  Verdict first;
  for (int i = 0; i < 3; ++i) {
    const Verdict told =
        tactus::saturate(point.x.p[i], point.v[i], limits.p_min[i], limits.p_max[i], i);
    if (told.ok()) continue;
    point.a[i] = 0.0;
    if (first.ok()) first = told;
  }
  return first;
}

TaskSpace::Peaks TaskSpace::peaks(const Limits& limits) {
  return {{limits.v_max, limits.w_max},
          {limits.a_max, limits.alpha_max},
          {limits.j_max, limits.dalpha_max}};
}

TaskSpace::Measure TaskSpace::measure(const Segment& segment, const Limits& limits,
                                      const Peaks& /*most*/, Care care) {
  const double T = segment.duration();
  const VectorBounds p = translation_bounds(segment.translation(), T, care);
  const VectorBounds r = segment.rotation().bounds(care);
  Measure measure;
  measure.peaks = {{p.v, r.v}, {p.a, r.a}, {p.j, r.j}};
  measure.slowing = measure.peaks.a;
  Extent& extent = measure.extent;
  for (int i = 0; i < 3; ++i) {
    const Polynomial axis = axis_of(segment.translation(), i);
    const Extremes outer = hull(axis, T);
    // Exact if the hull leaves the box, or if the box is unknown: in a client's frame.
    const bool inside = outer.min >= limits.p_min[i] && outer.max <= limits.p_max[i];
    const bool known = limits.p_max[i] < kInfinity;
    const bool enough = care == Care::kQuick || (inside && known);
    const Extremes room = enough ? outer : extremes(axis, T);
    extent.p_min[i] = room.min;
    extent.p_max[i] = room.max;
  }
  // The wrench is linear and so largest at an end.
  for (const Vector6& h : {segment.wrench(0.0), segment.wrench(T)}) {
    extent.force = std::max(extent.force, h.head<3>().norm());
    extent.moment = std::max(extent.moment, h.tail<3>().norm());
  }
  return measure;
}

Verdict TaskSpace::judge_room(const Measure& measure, const Limits& limits, const Point& from) {
  return first_of({judge_place(measure.extent.p_min, limits, from.x.p),
                   judge_place(measure.extent.p_max, limits, from.x.p)});
}

Verdict TaskSpace::judge_near(const Point& a, const Point& b, const Tolerance& tolerance) {
  return first_of(
      {within((a.x.p - b.x.p).norm(), tolerance.position_m, Status::kStartTolerance, kTranslation),
       within(angle_between(a.x.r, b.x.r), tolerance.angle_rad, Status::kStartTolerance,
              kRotation)});
}

Verdict TaskSpace::judge_step(const Point& before, const Point& after, const Limits& limits,
                              double dt_s, Levels& level) {
  const Vector6 step = after.v - before.v;
  level[0] = std::max(0.0, level[0] - limits.a_max * dt_s) + step.head<3>().norm();
  level[1] = std::max(0.0, level[1] - limits.alpha_max * dt_s) + step.tail<3>().norm();
  return first_of({at_most(level[0], limits.v_step, Status::kVelocityStep, kTranslation),
                   at_most(level[1], limits.w_step, Status::kVelocityStep, kRotation)});
}

Verdict TaskSpace::judge_error(const Point& desired, const Point& measured, const Band& band,
                               Status code) {
  Verdict verdict;
  if (band.position_m > 0.0)
    verdict = within((desired.x.p - measured.x.p).norm(), band.position_m, code, kTranslation);
  if (verdict.ok() && band.angle_rad > 0.0)
    verdict = within(angle_between(desired.x.r, measured.x.r), band.angle_rad, code, kRotation);
  return verdict;
}

TaskSpace::Extent TaskSpace::Extent::largest(const Extent& a, const Extent& b) {
  return {a.slowed || b.slowed, a.p_min.cwiseMin(b.p_min), a.p_max.cwiseMax(b.p_max),
          std::max(a.force, b.force), std::max(a.moment, b.moment)};
}

TaskSpace::Extent TaskSpace::extent_of(const Point& held) {
  return {false, held.x.p, held.x.p, held.h.head<3>().norm(), held.h.tail<3>().norm()};
}

Verdict TaskSpace::judge_placed(const Extent& placed, const Placement& placement,
                                const Limits& limits) {
  Verdict verdict;
  if (placement.moved && !placed.empty())
    verdict = first_of({judge_place(placed.p_min, limits, limits.p_max),
                        judge_place(placed.p_max, limits, limits.p_max)});
  if (verdict.ok() && placement.levered)
    verdict = at_most(placed.moment, limits.moment_max, Status::kEffortLimit, kRotation);
  return verdict;
}

}  // namespace tactus
