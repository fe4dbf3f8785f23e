// Inverse dynamics tau = M(q) ddq + C(q, dq) dq + g(q) by the recursive Newton-Euler algorithm in
// link frames (Luh, Walker, Paul 1980; Siciliano et al., Robotics, section 7.5; Featherstone's RNEA
// with the origin of each joint frame as reference point). Velocities and accelerations are
// computed outwards along the arm, forces and moments on the way back.
#pragma once

#include "kernel/core/types.hpp"
#include "kernel/model/gravity.hpp"
#include "kernel/model/joint_trig.hpp"
#include "kernel/robots/link.hpp"

namespace tactus {

/// Motion of a link in its own axes. Gravity enters as an upward acceleration of the base.
template <class W, class Dw, class A>
struct LinkMotion {
  W w;    ///< angular velocity, rad/s
  Dw dw;  ///< angular acceleration, rad/s^2
  A a;    ///< acceleration of the frame's origin minus that of gravity, m/s^2
};
template <class W, class Dw, class A>
LinkMotion(W, Dw, A) -> LinkMotion<W, Dw, A>;

/// A force and its moment about the origin of the frame it is expressed in.
template <class F, class N>
struct LinkLoad {
  F f;  ///< N
  N n;  ///< N m
};
template <class F, class N>
LinkLoad(F, N) -> LinkLoad<F, N>;

/// Returns the acceleration of a point at p relative to that of the origin: dw x p + w x (w x p).
/// With a first moment in place of p, the force that this takes.
template <class M, class P>
auto swing(const M& link, const P& p) {
  return cross(link.dw, p) + cross(link.w, cross(link.w, p));
}

/// Returns the motion of link i from that of link i-1 and the rates of joint i. A prismatic joint
/// adds its acceleration and that of Coriolis, 2 w x z dq.
template <class R, int i, class M>
auto motion_of_link(const M& parent, const JointTrig<R>& trig, double dq, double ddq) {
  const TypedVector z_dq{Zero{}, Zero{}, dq}, z_ddq{Zero{}, Zero{}, ddq};
  const SinCos& q = trig[i];
  const auto w_parent = to_child<R, i>(q, parent.w);
  const auto dw_parent = to_child<R, i>(q, parent.dw);
  const auto a = to_child<R, i>(q, parent.a + swing(parent, origin<R, i>(trig)));
  if constexpr (is_prismatic<R>(i)) {
    return LinkMotion{w_parent, dw_parent, a + z_ddq + 2.0 * cross(w_parent, z_dq)};
  } else {
    return LinkMotion{w_parent + z_dq, dw_parent + z_ddq + cross(w_parent, z_dq), a};
  }
}

/// Returns the load by Newton, f = m a_com, and Euler, n = I dw + w x I w, about the origin of the
/// link's frame instead of its centre of mass, with the first moment h = m c and I about that
/// origin.
template <class R, int i, class M>
auto load_of_link(const M& link) {
  const auto h = first_moment<R, i>();
  const auto f = R::kLinks[i].mass * link.a + swing(link, h);
  const auto n =
      inertia_times<R, i>(link.dw) + cross(link.w, inertia_times<R, i>(link.w)) + cross(h, link.a);
  return LinkLoad{f, n};
}

/// Returns the load of the tool, a point mass on the last link.
template <class R, class M>
auto load_of_tool(const M& last_link, const Tool& tool) {
  const auto c = from_flange<R>(tool.com);
  const auto f = tool.mass_kg * (last_link.a + swing(last_link, c));
  return LinkLoad{f, cross(c, f)};
}

/// State of the joints as one argument of the recursion.
template <class R>
struct JointRates {
  const JointTrig<R>& trig;
  const JointsOf<R>& dq;   ///< rad/s
  const JointsOf<R>& ddq;  ///< rad/s^2
};

/// Fills tau from joint i up. Returns the load that moves link i and all it carries, about the
/// origin and in the axes of frame i-1.
template <class R, int i, class M>
auto newton_euler(const M& parent, const JointRates<R>& joints, const Tool& tool,
                  JointsOf<R>& tau) {
  if constexpr (i == R::kDof) {
    return load_of_tool<R>(parent, tool);
  } else {
    const SinCos& q = joints.trig[i];
    const auto link = motion_of_link<R, i>(parent, joints.trig, joints.dq[i], joints.ddq[i]);
    const auto own = load_of_link<R, i>(link);
    const auto carried = newton_euler<R, i + 1>(link, joints, tool, tau);
    const auto n = own.n + carried.n;
    const auto f = own.f + carried.f;
    if constexpr (is_prismatic<R>(i)) {
      tau[i] = f.z;
    } else {
      tau[i] = n.z;
    }
    const auto f_parent = to_parent<R, i>(q, f);
    return LinkLoad{f_parent, to_parent<R, i>(q, n) + cross(origin<R, i>(joints.trig), f_parent)};
  }
}

/// Returns the joint efforts, N m, that give ddq [rad/s^2] at q and dq [rad/s], for a base at rest
/// under the gravity of `tool`. [cyclic]
// flatten: the recursion over the joints becomes one straight line of arithmetic.
template <class R>
[[gnu::flatten]] JointsOf<R> inverse_dynamics(const JointTrig<R>& trig, const JointsOf<R>& dq,
                                              const JointsOf<R>& ddq, const Tool& tool) {
  constexpr TypedVector kAtRest{Zero{}, Zero{}, Zero{}};
  const LinkMotion base{kAtRest, kAtRest, base_acceleration(tool)};
  JointsOf<R> tau;
  newton_euler<R, 0>(base, JointRates<R>{trig, dq, ddq}, tool, tau);
  return tau;
}

}  // namespace tactus
