// Forward kinematics and geometric Jacobian of the tool tip, in the base frame. One sweep outwards
// gives the joint axes, one sweep back the lever arms (Siciliano et al., Robotics, 2.8 and 3.1):
//   R_i = R_(i-1) RotX(roll_i) RotZ(q_i)
//   d_i = d_(i+1) + R_i origin_(i+1)       from the origin of frame i to the tip
//   J_i = [z_i x d_i; z_i]                 column of a revolute joint i
//   J_i = [z_i; 0]                         column of a prismatic joint i
#pragma once

#include "kernel/core/types.hpp"
#include "kernel/model/joint_trig.hpp"

namespace tactus {

template <class R>
using JacobianOf = Eigen::Matrix<double, 6, R::kDof>;

/// The columns of a rotation matrix: the axes of a frame, in the axes of the base.
template <class X, class Y, class Z>
struct FrameAxes {
  X x;
  Y y;
  Z z;
};
template <class X, class Y, class Z>
FrameAxes(X, Y, Z) -> FrameAxes<X, Y, Z>;

/// Returns R RotX(roll_i): the columns are exchanged and turned as the components of a vector by
/// the inverse.
template <class R, int i, class A>
auto rolled_axes(const A& r) {
  const auto u = rolled_back<R, i>(TypedVector{r.x, r.y, r.z});
  return FrameAxes{u.x, u.y, u.z};
}

/// Returns R RotZ(q).
template <class X, class Y, class Z>
auto turned(const FrameAxes<X, Y, Z>& r, const SinCos& q) {
  return FrameAxes{q.cos * r.x + q.sin * r.y, q.cos * r.y - q.sin * r.x, r.z};
}

/// Returns R v.
template <class X, class Y, class Z, class V>
auto rotated(const FrameAxes<X, Y, Z>& r, const V& v) {
  return v.x * r.x + v.y * r.y + v.z * r.z;
}

template <class X, class Y, class Z>
Vector3 dense(const TypedVector<X, Y, Z>& v) {
  return {v.x, v.y, v.z};
}

/// Fills the orientation of the tip; returns the lever from the origin of frame kDof-1 to it, m.
template <class R, class A>
auto tip_from_last_link(const A& link, const Pose& tip, Pose& x) {
  const auto flange = rolled_axes<R, R::kDof>(link);
  Matrix3 rotation;
  rotation << dense(flange.x), dense(flange.y), dense(flange.z);
  x.r = Eigen::Quaterniond(rotation) * tip.r;
  return rotated(link, from_flange<R>(tip.p));
}

/// Fills columns i and up of J; returns the lever from the origin of frame i-1 to the tip, m.
template <class R, int i, class A>
auto tip_from(const A& parent, const JointTrig<R>& trig, const Pose& tip, Pose& x,
              JacobianOf<R>& J) {
  if constexpr (i == R::kDof) {
    return tip_from_last_link<R>(parent, tip, x);
  } else {
    const auto link = turned(rolled_axes<R, i>(parent), trig[i]);
    const auto d = tip_from<R, i + 1>(link, trig, tip, x, J);
    if constexpr (is_prismatic<R>(i)) {
      J.col(i) << dense(link.z), Vector3::Zero();
    } else {
      J.col(i) << dense(cross(link.z, d)), dense(link.z);
    }
    return rotated(parent, origin<R, i>(trig)) + d;
  }
}

/// Returns the pose of the tool tip in the base frame, and fills J: [v; w] = J dq at the tip, in
/// the axes of the base, linear part first. `tip` is the tip frame in the flange frame. [cyclic]
// flatten: the recursion over the joints becomes one straight line of arithmetic.
template <class R>
[[gnu::flatten]] Pose forward_kinematics(const JointTrig<R>& trig, const Pose& tip,
                                         JacobianOf<R>& J) {
  constexpr auto kBase =
      FrameAxes{TypedVector{1.0, Zero{}, Zero{}}, TypedVector{Zero{}, 1.0, Zero{}},
                TypedVector{Zero{}, Zero{}, 1.0}};
  Pose x;
  x.p = dense(tip_from<R, 0>(kBase, trig, tip, x, J));
  return x;
}

}  // namespace tactus
