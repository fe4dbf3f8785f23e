// What the limits of the tool tip mean for a point and for a segment.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "kernel/math/so3.hpp"
#include "kernel/reference/limit_check.hpp"
#include "kernel/reference/task_space.hpp"
#include "kernel/reference/translation_bounds.hpp"

namespace tactus {
namespace {

constexpr int kTranslation = 0, kRotation = 3;  // axes of a verdict on a length
constexpr double kUnitTolerance = 1e-3;         // of a quaternion's length

/// The first that is not ok.
Verdict first_of(std::initializer_list<Verdict> verdicts) {
  for (const Verdict& verdict : verdicts) {
    if (!verdict.ok()) return verdict;
  }
  return {};
}

Verdict finite(double value, int axis) {
  return std::isfinite(value) ? Verdict{}
                              : Verdict{Status::kReferenceNotFinite, -1, axis, value, 0.0};
}

Verdict judge_finite(const TaskSpace::Point& point) {
  const Eigen::Quaterniond& r = point.x.r;
  Verdict verdict = first_of({finite(r.w(), kRotation), finite(r.x(), kRotation),
                              finite(r.y(), kRotation), finite(r.z(), kRotation)});
  for (int i = 0; verdict.ok() && i < 6; ++i) {
    verdict = first_of({finite(i < 3 ? point.x.p[i] : 0.0, i), finite(point.v[i], i),
                        finite(point.a[i], i), finite(point.h[i], i), finite(point.dh[i], i)});
  }
  return verdict;
}

Verdict judge_unit(const Eigen::Quaterniond& r) {
  const double length = r.norm(), longest = 1.0 + kUnitTolerance, shortest = 1.0 - kUnitTolerance;
  if (exceeds(length, longest)) return {Status::kQuaternion, -1, kRotation, length, longest};
  if (exceeds(-length, -shortest)) return {Status::kQuaternion, -1, kRotation, length, shortest};
  return {};
}

Verdict judge_place(const Vector3& p, const TaskLimits& limits) {
  for (int i = 0; i < 3; ++i) {
    if (exceeds(p[i], limits.p_max[i])) return {Status::kWorkspace, -1, i, p[i], limits.p_max[i]};
    if (exceeds(-p[i], -limits.p_min[i])) return {Status::kWorkspace, -1, i, p[i], limits.p_min[i]};
  }
  return {};
}

Verdict judge_path(const VectorPolynomial& p, double T, const TaskLimits& limits) {
  Verdict verdict;
  for (int i = 0; verdict.ok() && i < 3; ++i) {
    verdict = bounded(p.axis[static_cast<std::size_t>(i)], T, limits.p_min[i], limits.p_max[i],
                      Status::kWorkspace, i);
  }
  return verdict;
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

Verdict TaskSpace::judge(const Point& point, const Limits& limits) {
  return first_of(
      {judge_finite(point), judge_unit(point.x.r), judge_place(point.x.p, limits),
       at_most(point.v.head<3>().norm(), limits.v_max, Status::kVelocityLimit, kTranslation),
       at_most(point.v.tail<3>().norm(), limits.w_max, Status::kVelocityLimit, kRotation),
       at_most(point.h.head<3>().norm(), limits.force_max, Status::kEffortLimit, kTranslation),
       at_most(point.h.tail<3>().norm(), limits.moment_max, Status::kEffortLimit, kRotation)});
}

Verdict TaskSpace::judge(const Segment& segment, const Limits& limits, double share) {
  const double T = segment.duration();
  const TranslationBounds p = translation_bounds(segment.translation(), T);
  const RotationSegment::Bounds r = segment.rotation().bounds();
  const Status kA = Status::kAccelerationLimit;
  return first_of({judge_path(segment.translation(), T, limits),
                   at_most(p.v, limits.v_max, Status::kVelocityLimit, kTranslation),
                   at_most(r.w, limits.w_max, Status::kVelocityLimit, kRotation),
                   at_most(p.a, share * limits.a_max, kA, kTranslation),
                   at_most(r.alpha, share * limits.alpha_max, kA, kRotation),
                   at_most(p.j, share * limits.j_max, Status::kJerkLimit, kTranslation),
                   at_most(r.jerk, share * limits.dalpha_max, Status::kJerkLimit, kRotation)});
}

Verdict TaskSpace::judge_end(const Point& end) {
  Verdict verdict;
  for (int i = 0; verdict.ok() && i < 6; ++i) {
    for (const double value : {end.v[i], end.a[i]}) {
      if (exceeds(std::abs(value), kRest)) return {Status::kNotAtRest, -1, i, value, 0.0};
    }
  }
  return {};
}

Verdict TaskSpace::judge_near(const Point& a, const Point& b, const Tolerance& tolerance) {
  return first_of(
      {within((a.x.p - b.x.p).norm(), tolerance.position_m, Status::kStartTolerance, kTranslation),
       within(angle_between(a.x.r, b.x.r), tolerance.angle_rad, Status::kStartTolerance,
              kRotation)});
}

Verdict TaskSpace::judge_step(const Point& before, const Point& after, const Limits& limits) {
  const Vector6 step = after.v - before.v;
  return first_of(
      {at_most(step.head<3>().norm(), limits.v_step, Status::kVelocityStep, kTranslation),
       at_most(step.tail<3>().norm(), limits.w_step, Status::kVelocityStep, kRotation)});
}

Verdict TaskSpace::judge_reach(const Point& from, const Point& to, const Limits& limits,
                               double dt_s) {
  const double v = (to.x.p - from.x.p).norm() / dt_s;
  const double w = log_so3(from.x.r.conjugate() * to.x.r).norm() / dt_s;
  return first_of({at_most(v, limits.v_max, Status::kVelocityLimit, kTranslation),
                   at_most(w, limits.w_max, Status::kVelocityLimit, kRotation)});
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

Verdict TaskSpace::judge_stopped(const Point& measured, double limit) {
  if (!(limit > 0.0)) return {};
  return first_of({within(measured.v.head<3>().norm(), limit, Status::kGoalTolerance, kTranslation),
                   within(measured.v.tail<3>().norm(), limit, Status::kGoalTolerance, kRotation)});
}

TaskSpace::Use TaskSpace::Use::largest(const Use& a, const Use& b) {
  return {PathUse::largest(a, b), a.p_min.cwiseMin(b.p_min), a.p_max.cwiseMax(b.p_max),
          std::max(a.force, b.force), std::max(a.moment, b.moment)};
}

TaskSpace::Use TaskSpace::use(const Point& held) {
  return {PathUse(), held.x.p, held.x.p, held.h.head<3>().norm(), held.h.tail<3>().norm()};
}

TaskSpace::Use TaskSpace::use(const Segment& segment, const Limits& limits, const Use& known) {
  const TranslationBounds p = translation_bounds(segment.translation(), segment.duration());
  const RotationSegment::Bounds r = segment.rotation().bounds();
  const PathUse translation = {p.v / limits.v_max, p.a / limits.a_max, p.j / limits.j_max,
                               p.v / limits.a_max, p.v / limits.j_max, p.a / limits.j_max};
  const PathUse rotation = {r.w / limits.w_max,         r.alpha / limits.alpha_max,
                            r.jerk / limits.dalpha_max, r.w / limits.alpha_max,
                            r.w / limits.dalpha_max,    r.alpha / limits.dalpha_max};
  // The wrench, being linear, is largest at an end.
  Use own = Use::largest(use(segment.at(0.0)), use(segment.at(segment.duration())));
  static_cast<PathUse&>(own) = PathUse::largest(translation, rotation);
  for (int i = 0; i < 3; ++i) {
    const Extremes room =
        extremes(segment.translation().axis[static_cast<std::size_t>(i)], segment.duration());
    own.p_min[i] = room.min;
    own.p_max[i] = room.max;
  }
  return Use::largest(known, own);
}

Verdict TaskSpace::judge_placed(const Use& placed, const Latched& terms, const Limits& limits) {
  Verdict verdict;
  if (terms.moved)
    verdict = first_of({judge_place(placed.p_min, limits), judge_place(placed.p_max, limits)});
  if (verdict.ok() && terms.levered)
    verdict = at_most(placed.moment, limits.moment_max, Status::kEffortLimit, kRotation);
  return verdict;
}

}  // namespace tactus
