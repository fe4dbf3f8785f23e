#include "kernel/reference/space/task_space.hpp"

#include <cmath>
#include <limits>

#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

BoundaryOf<Vector3> translation_boundary(const TaskSpace::Point& point) {
  return {point.x.p, point.v.head<3>(), point.a.head<3>()};
}

RotationBoundary rotation_boundary(const TaskSpace::Point& point) {
  return {point.x.r, point.v.tail<3>(), point.a.tail<3>()};
}

/// Returns r if its length is one to rounding, else r normalized.
Eigen::Quaterniond unit(const Eigen::Quaterniond& r) {
  constexpr double kRounding = 2e-15;
  return std::abs(r.squaredNorm() - 1.0) <= kRounding ? r : r.normalized();
}

}  // namespace

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

TaskSpace::Error TaskSpace::error(const Point& desired, const Point& actual) {
  return {desired.x.p - actual.x.p, log_so3(desired.x.r * actual.x.r.conjugate()),
          desired.v - actual.v,     desired.a - actual.a,
          desired.h - actual.h,     desired.dh - actual.dh};
}

}  // namespace tactus
