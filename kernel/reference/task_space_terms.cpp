// What the references of a client mean who gives them in frames of their own.
#include "kernel/math/so3.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

/// Linear and angular part, or force and moment, in the axes of the base.
Vector6 turned(const Eigen::Quaterniond& r, const Vector6& vector) {
  Vector6 in_base;
  in_base << r * Vector3(vector.head<3>()), r * Vector3(vector.tail<3>());
  return in_base;
}

}  // namespace

TaskSpace::Latched TaskSpace::latch(const Terms& terms, const Point& /*reference*/) {
  Latched now;
  if (terms.motion != nullptr) now = {*terms.motion, now.wrench, true, now.levered};
  if (terms.wrench != nullptr) now = {now.motion, *terms.wrench, now.moved, true};
  return now;
}

TaskSpace::Limits TaskSpace::known_limits(const Terms& terms, const Limits& limits) {
  Limits known = limits;
  if (terms.motion != nullptr) {
    known.p_min.setConstant(-kInfinity);
    known.p_max.setConstant(kInfinity);
  }
  if (terms.wrench != nullptr) known.moment_max = kInfinity;
  return known;
}

TaskSpace::Point TaskSpace::only(Fields given, const Point& point) {
  Point known = point;
  if (!(given & kVelocityField)) known.v.setZero();
  if (!(given & kAccelerationField)) known.a.setZero();
  if (!(given & kEffortField)) known.h.setZero(), known.dh.setZero();
  return known;
}

// With the pose (p_F, R_F) of the motion frame, which stands still,
//   p = p_F + R_F p_given,  R = R_F R_given,  twist and acceleration turned by R_F,
// and with the wrench (f, m) given about the origin p_W of its frame,
//   f = R_W f_given,  m = R_W m_given + (p_W - p) x f,
// whose rate has the tip's own velocity in it: the lever arm changes by -v.

TaskSpace::Point TaskSpace::placed(const Point& given, const Latched& terms) {
  Point point = given;
  if (terms.moved) {
    const Eigen::Quaterniond& r = terms.motion.r;
    point.x = {terms.motion.p + r * given.x.p, r * given.x.r};
    point.v = turned(r, given.v);
    point.a = turned(r, given.a);
  }
  if (terms.levered) {
    point.h = turned(terms.wrench.r, given.h);
    point.dh = turned(terms.wrench.r, given.dh);
    const Vector3 arm = terms.wrench.p - point.x.p;
    const Vector3 f = point.h.head<3>(), df = point.dh.head<3>(), v = point.v.head<3>();
    point.h.tail<3>() += arm.cross(f);
    point.dh.tail<3>() += arm.cross(df) - v.cross(f);
  }
  return point;
}

TaskSpace::Use TaskSpace::placed(const Use& given, const Latched& terms) {
  Use use = given;
  if (terms.moved) {
    const Matrix3 R = terms.motion.r.toRotationMatrix();
    const Vector3 half = 0.5 * R.cwiseAbs() * (given.p_max - given.p_min);
    const Vector3 middle = terms.motion.p + 0.5 * R * (given.p_min + given.p_max);
    use.p_min = middle - half;
    use.p_max = middle + half;
  }
  if (terms.levered) {
    const Vector3 farthest =
        (terms.wrench.p - use.p_min).cwiseAbs().cwiseMax((terms.wrench.p - use.p_max).cwiseAbs());
    use.moment += farthest.norm() * use.force;
  }
  return use;
}

TaskSpace::Rates TaskSpace::secant(const Point& from, const Point& to, double T) {
  Rates rates;
  rates << (to.x.p - from.x.p) / T, from.x.r * log_so3(from.x.r.conjugate() * to.x.r) / T;
  return rates;
}

}  // namespace tactus
