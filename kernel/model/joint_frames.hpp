// Changes of frame along the arm, specialised by the compiler for one robot table. Frame i is fixed
// to link i, and its z is the axis of joint i; frame -1 is the base, frame kDof the flange:
//   T(i-1, i) = Trans(offset) RotX(roll_i) RotZ(turn_i + q_i)              revolute
//   T(i-1, i) = Trans(offset) RotX(roll_i) RotZ(turn_i) Trans(0, 0, q_i)   prismatic
// RotX by quarter turns only permutes components and signs, so a change of frame costs one planar
// rotation; a roll with a tilt costs another. Vectors are TypedVectors; their zeros cost nothing.
#pragma once

#include <Eigen/Core>

#include "kernel/math/sincos.hpp"
#include "kernel/robots/robot_table.hpp"
#include "kernel/robots/typed_vector.hpp"

namespace tactus {

/// One number per joint of robot R.
template <class R>
using JointsOf = Eigen::Matrix<double, R::kDof, 1>;

/// Returns frame i of the table in frame i-1; the flange if i = kDof.
template <class R, int i>
constexpr JointFrame joint_frame() {
  if constexpr (i == R::kDof) {
    return R::kFlange;
  } else {
    return R::kJoints[i];
  }
}

/// Returns the origin of frame i in the axes of frame i-1, m; of a prismatic joint at q = 0. [any]
template <class R, int i>
constexpr auto offset() {
  return TypedVector{typed([] { return joint_frame<R, i>().x; }),
                     typed([] { return joint_frame<R, i>().y; }),
                     typed([] { return joint_frame<R, i>().z; })};
}

/// Returns RotX(k pi/2) v. [any]
template <int k, class V>
constexpr auto quarter_turns(const V& v) {
  static_assert(k >= -2 && k <= 2, "a joint frame is rolled by -1, 0, 1 or 2 quarter turns");
  if constexpr (k == 0) {
    return v;
  } else if constexpr (k == 1) {
    return TypedVector{v.x, -v.z, v.y};
  } else if constexpr (k == -1) {
    return TypedVector{v.x, v.z, -v.y};
  } else {
    return TypedVector{v.x, -v.y, -v.z};
  }
}

/// Returns sine and cosine of the tilt of frame i.
template <class R, int i>
constexpr SinCos tilt() {
  constexpr double kTilt = joint_frame<R, i>().tilt, kMost = 0.785398163397448;  // pi/4
  static_assert(-kMost <= kTilt && kTilt <= kMost, "more tilt is another number of quarter turns");
  return {sin_on_octant(kTilt, 0.0), cos_on_octant(kTilt, 0.0)};
}

/// Returns RotX(roll_i) v. [any]
template <class R, int i, class V>
constexpr auto rolled(const V& v) {
  const auto u = quarter_turns<joint_frame<R, i>().roll_quarter_turns>(v);
  if constexpr (joint_frame<R, i>().tilt == 0.0) {
    return u;
  } else {
    constexpr SinCos kTilt = tilt<R, i>();
    return TypedVector{u.x, kTilt.cos * u.y - kTilt.sin * u.z, kTilt.sin * u.y + kTilt.cos * u.z};
  }
}

/// Returns RotX(-roll_i) v. [any]
template <class R, int i, class V>
constexpr auto rolled_back(const V& v) {
  const auto u = quarter_turns<-joint_frame<R, i>().roll_quarter_turns>(v);
  if constexpr (joint_frame<R, i>().tilt == 0.0) {
    return u;
  } else {
    constexpr SinCos kTilt = tilt<R, i>();
    return TypedVector{u.x, kTilt.cos * u.y + kTilt.sin * u.z, kTilt.cos * u.z - kTilt.sin * u.y};
  }
}

/// Returns the components in frame i of a vector given in the axes of frame i-1: RotZ(-q)
/// RotX(-roll_i) v. [any]
template <class R, int i, class V>
constexpr auto to_child(const SinCos& q, const V& v) {
  const auto u = rolled_back<R, i>(v);
  return TypedVector{q.cos * u.x + q.sin * u.y, q.cos * u.y - q.sin * u.x, u.z};
}

/// Returns the components in the axes of frame i-1 of a vector given in frame i: RotX(roll_i)
/// RotZ(q) v. [any]
template <class R, int i, class V>
constexpr auto to_parent(const SinCos& q, const V& v) {
  const auto u = TypedVector{q.cos * v.x - q.sin * v.y, q.sin * v.x + q.cos * v.y, v.z};
  return rolled<R, i>(u);
}

/// Returns a point of the flange frame in the frame of the last link, m. [any]
template <class R>
auto from_flange(const Eigen::Matrix<double, 3, 1>& p) {
  return rolled<R, R::kDof>(TypedVector{p.x(), p.y(), p.z()}) + offset<R, R::kDof>();
}

}  // namespace tactus
