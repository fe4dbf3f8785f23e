#include "kernel/reference/space/task_space.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/reference/space/limit_check.hpp"
#include "kernel/reference/space/vector_bounds.hpp"

namespace tactus {
namespace {

BoundaryOf<Vector3> translation_boundary(const TaskSpace::Point& point) {
  return {point.x.p, point.v.head<3>(), point.a.head<3>()};
}

RotationBoundary rotation_boundary(const TaskSpace::Point& point) {
  return {point.x.r, point.v.tail<3>(), point.a.tail<3>()};
}

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

/// Returns linear and angular part, or force and moment, in the axes of the base.
Vector6 turned(const Eigen::Quaterniond& r, const Vector6& vector) {
  return stacked(r * Vector3(vector.head<3>()), r * Vector3(vector.tail<3>()));
}

}  // namespace

Eigen::Quaterniond unit(const Eigen::Quaterniond& r) {
  constexpr double kRounding = 2e-15;
  return std::abs(r.squaredNorm() - 1.0) <= kRounding ? r : r.normalized();
}

Eigen::Quaterniond unit_beside(const Eigen::Quaterniond& r, const Eigen::Quaterniond& last) {
  Eigen::Quaterniond now = unit(r);
  if (!(now.dot(last) < 0.0)) return now;
  return {-now.w(), -now.x(), -now.y(), -now.z()};
}

TaskSpace::Band TaskSpace::Band::merged(const Band& goal, const Band& defaults) {
  return {merge_tolerance(goal.position_m, defaults.position_m),
          merge_tolerance(goal.angle_rad, defaults.angle_rad)};
}

bool TaskSpace::Point::finite() const {
  return x.p.allFinite() && x.r.coeffs().allFinite() && v.allFinite() && a.allFinite() &&
         h.allFinite() && dh.allFinite();
}

bool TaskSpace::Point::standing() const {
  return v == Vector6::Zero() && a == Vector6::Zero();
}

bool TaskSpace::Point::idle() const {
  return standing() && h == Vector6::Zero() && dh == Vector6::Zero();
}

TaskSpace::Point TaskSpace::Point::at_rest() const {
  return {{x.p, unit(x.r)}};
}

TaskSpace::Point TaskSpace::Point::stopped() const {
  Point still = at_rest();
  still.h = h;
  return still;
}

TaskSpace::Point TaskSpace::Point::as_measured(Fields fields) const {
  const Vector6 none = Vector6::Constant(std::numeric_limits<double>::quiet_NaN());
  return {x, fields & kVelocityField ? v : none, fields & kAccelerationField ? a : none,
          fields & kEffortField ? h : none, none};
}

TaskSpace::Point TaskSpace::Point::at_rate(double rate, double slope) const {
  return {x, rate * v, (rate * rate) * a + slope * v, h, rate * dh};
}

TaskSpace::Segment::Segment(const Point& from, const Point& to, double T, Interpolation how,
                            Fields fields)
    : order_(order_of(how, fields)),
      p_(join(order_, translation_boundary(from), translation_boundary(to), T)),
      rotation_(rotation_boundary(from), rotation_boundary(to), T, order_),
      h_(from.h),
      dh_((to.h - from.h) / T) {}

TaskSpace::Point TaskSpace::Segment::corner() const {
  Point begin = at(0.0);
  if (order_ == Interpolation::kLinear) begin.v.setZero();
  if (order_ != Interpolation::kQuintic) begin.a.setZero();
  return begin;
}

TaskSpace::Point TaskSpace::Segment::at(double t) const {
  const VectorPolynomial p = p_.from(t);
  const RotationBoundary rotation = rotation_.at(t);
  return {{p.c[0], rotation.r},
          stacked(p.c[1], rotation.w),
          stacked(2.0 * p.c[2], rotation.alpha),
          h_ + t * dh_,
          dh_};
}

TaskSpace::Segment TaskSpace::Segment::part(double begin, double duration) const {
  Segment part = *this;
  part.p_ = p_.from(begin);
  part.rotation_ = rotation_.part(begin, duration);
  part.h_ = h_ + begin * dh_;
  return part;
}

TaskSpace::Local TaskSpace::Segment::local(double t) const {
  const VectorPolynomial p = p_.from(t);
  const TurningRates turning = rotation_.rates(t);
  return {stacked(p.c[1], turning.w), stacked(2.0 * p.c[2], turning.alpha),
          stacked(6.0 * p.c[3], turning.jerk)};
}

TaskSpace::Error TaskSpace::error(const Point& desired, const Point& actual) {
  return {desired.x.p - actual.x.p, log_so3(desired.x.r * actual.x.r.conjugate()),
          desired.v - actual.v,     desired.a - actual.a,
          desired.h - actual.h,     desired.dh - actual.dh};
}

TaskSpace::Placement TaskSpace::latch(const Header& header, const Point& /*reference*/,
                                      const Limits& /*limits*/) {
  Placement now;
  if (header.motion != nullptr) now = {*header.motion, now.wrench, true, now.levered};
  if (header.wrench != nullptr) now = {now.motion, *header.wrench, now.moved, true};
  return now;
}

TaskSpace::Limits TaskSpace::known_limits(const Header& header, const Limits& limits) {
  Limits known = limits;
  if (header.motion != nullptr) {
    known.p_min.setConstant(-kInfinity);
    known.p_max.setConstant(kInfinity);
  }
  if (header.wrench != nullptr) known.moment_max = kInfinity;
  return known;
}

TaskSpace::Point TaskSpace::only(Fields given, const double* numbers) {
  const auto vector = [given, numbers](Fields field, int first) -> Vector6 {
    return given & field ? Vector6(numbers + first) : Vector6::Zero();
  };
  return {{Vector3(numbers), Eigen::Quaterniond(numbers + 3)},
          vector(kVelocityField, 7),
          vector(kAccelerationField, 13),
          vector(kEffortField, 19),
          vector(kEffortField, 25)};
}

// With the pose (p_F, R_F) of the motion frame, which is constant,
//   p = p_F + R_F p_given,  R = R_F R_given,  twist and acceleration turned by R_F,
// and with the wrench (f, m) given about the origin p_W of its frame,
//   f = R_W f_given,  m = R_W m_given + (p_W - p) x f,
// whose rate contains the velocity v of the tip, as the lever arm changes by -v.

TaskSpace::Point TaskSpace::placed(const Point& given, const Placement& placement) {
  const Eigen::Quaterniond& r = placement.motion.r;
  Point point = placement.moved ? Point{{placement.motion.p + r * given.x.p, r * given.x.r},
                                        turned(r, given.v),
                                        turned(r, given.a),
                                        given.h,
                                        given.dh}
                                : given;
  if (placement.levered) {
    point.h = turned(placement.wrench.r, point.h);
    point.dh = turned(placement.wrench.r, point.dh);
    const Vector3 arm = placement.wrench.p - point.x.p;
    const Vector3 f = point.h.head<3>(), df = point.dh.head<3>(), v = point.v.head<3>();
    point.h.tail<3>() += arm.cross(f);
    point.dh.tail<3>() += arm.cross(df) - v.cross(f);
  }
  return point;
}

TaskSpace::Extent TaskSpace::placed(const Extent& given, const Placement& placement) {
  if (given.empty()) return given;
  Extent extent = given;
  if (placement.moved) {
    const Matrix3 R = placement.motion.r.toRotationMatrix();
    const Vector3 half = 0.5 * R.cwiseAbs() * (given.p_max - given.p_min);
    const Vector3 middle = placement.motion.p + 0.5 * R * (given.p_min + given.p_max);
    extent.p_min = middle - half;
    extent.p_max = middle + half;
  }
  if (placement.levered) {
    const Vector3 farthest = (placement.wrench.p - extent.p_min)
                                 .cwiseAbs()
                                 .cwiseMax((placement.wrench.p - extent.p_max).cwiseAbs());
    extent.moment += farthest.norm() * extent.force;
  }
  return extent;
}

TaskSpace::Rates TaskSpace::secant(const Point& from, const Point& to, double T) {
  return stacked((to.x.p - from.x.p) / T, from.x.r * log_so3(from.x.r.conjugate() * to.x.r) / T);
}

Verdict TaskSpace::judge_waypoint(const Point& point, const Limits& limits) {
  return first_of(
      {judge_finite(point), judge_unit(point.x.r), judge_place(point.x.p, limits, limits.p_max),
       at_most(point.h.head<3>().norm(), limits.force_max, Status::kEffortLimit, kTranslation),
       at_most(point.h.tail<3>().norm(), limits.moment_max, Status::kEffortLimit, kRotation)});
}

Verdict TaskSpace::saturate(Point& point, const Limits& limits) {
  Verdict first;
  for (int i = 0; i < 3; ++i) {
    const Verdict saturation =
        tactus::saturate(point.x.p[i], point.v[i], limits.p_min[i], limits.p_max[i], i);
    if (saturation.ok()) continue;
    point.a[i] = 0.0;
    if (first.ok()) first = saturation;
  }
  return first;
}

TaskSpace::Peaks TaskSpace::peaks(const Limits& limits) {
  return {{limits.v_max, limits.w_max},
          {limits.a_max, limits.alpha_max},
          {limits.j_max, limits.dalpha_max}};
}

TaskSpace::Measure TaskSpace::measure(const Segment& segment, const Limits& limits,
                                      const Peaks& /*most*/, Accuracy accuracy) {
  const double T = segment.duration();
  const VectorBounds p = translation_bounds(segment.translation(), T, accuracy);
  const VectorBounds r = segment.rotation().bounds(accuracy);
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
    const bool enough = accuracy == Accuracy::kQuick || (inside && known);
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
