// TaskSpace: references of a client that gives them in other frames than the base.
#include "kernel/math/so3.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

/// Returns linear and angular part, or force and moment, in the axes of the base.
Vector6 turned(const Eigen::Quaterniond& r, const Vector6& vector) {
  return stacked(r * Vector3(vector.head<3>()), r * Vector3(vector.tail<3>()));
}

}  // namespace

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

}  // namespace tactus
