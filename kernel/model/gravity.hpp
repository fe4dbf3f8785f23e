// Joint efforts that hold the arm against gravity, from composite first moments:
//   a_i = R^T a_(i-1)                                   a_(-1) = -gravity, base frame
//   h_i = m_i c_i + R h_(i+1) + M_(i+1) origin_(i+1)
//   g_i = e_z . (h_i x a_i)                             revolute joint
//   g_i = e_z . (M_i a_i)                               prismatic joint
// h_i is the first moment of link i and all it carries about the origin of frame i, and M_i their
// mass; the tool is a point mass on the last link. Vectors are in the axes of their link.
#pragma once

#include "kernel/core/types.hpp"
#include "kernel/model/joint_trig.hpp"
#include "kernel/robots/link.hpp"

namespace tactus {

/// Returns the acceleration of the base that stands for gravity, m/s^2, base frame. [any]
inline auto base_acceleration(const Tool& tool) {
  return TypedVector{-tool.gravity.x(), -tool.gravity.y(), -tool.gravity.z()};
}

/// Fills g from joint i up. Returns the first moment of link i and all it carries about the origin
/// and in the axes of frame i-1, kg m; `a_parent` is in the same axes.
template <class R, int i, class A>
auto composite_moment(const A& a_parent, const JointTrig<R>& trig, const Tool& tool,
                      JointsOf<R>& g) {
  if constexpr (i == R::kDof) {
    return tool.mass_kg * from_flange<R>(tool.com);
  } else {
    const auto a = to_child<R, i>(trig[i], a_parent);
    const auto h = first_moment<R, i>() + composite_moment<R, i + 1>(a, trig, tool, g);
    const double mass = carried_mass<R, i>() + tool.mass_kg;
    if constexpr (is_prismatic<R>(i)) {
      g[i] = mass * a.z;
    } else {
      g[i] = cross(h, a).z;
    }
    return to_parent<R, i>(trig[i], h) + mass * origin<R, i>(trig);
  }
}

/// Returns g(q), N m, under the gravity of `tool`: the gradient of the potential energy. [cyclic]
// flatten: the recursion over the joints becomes one straight line of arithmetic.
template <class R>
[[gnu::flatten]] JointsOf<R> gravity(const JointTrig<R>& trig, const Tool& tool) {
  JointsOf<R> g;
  composite_moment<R, 0>(base_acceleration(tool), trig, tool, g);
  return g;
}

}  // namespace tactus
