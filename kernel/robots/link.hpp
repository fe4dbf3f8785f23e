// The mass distribution of a link in the form that the algorithms use: constants of the robot
// table, about the origin of the link's joint frame and in its axes, with zeros as types.
#pragma once

#include "kernel/robots/robot_table.hpp"
#include "kernel/robots/typed_vector.hpp"

namespace tactus {

/// Returns the first moment m c of link i, kg m. [any]
template <class R, int i>
constexpr auto first_moment() {
  return TypedVector{typed([] { return R::kLinks[i].mass * R::kLinks[i].cx; }),
                     typed([] { return R::kLinks[i].mass * R::kLinks[i].cy; }),
                     typed([] { return R::kLinks[i].mass * R::kLinks[i].cz; })};
}

/// Returns the mass of link i and all links it carries, kg. [any]
template <class R, int i>
constexpr double carried_mass() {
  if constexpr (i == R::kDof) {
    return 0.0;
  } else {
    return R::kLinks[i].mass + carried_mass<R, i + 1>();
  }
}

/// Moves the inertia tensor of a link from its centre of mass to the origin of its frame (Steiner):
/// I + m (c.c 1 - c c^T). [any]
constexpr LinkInertia about_joint(const LinkInertia& l) {
  LinkInertia o = l;
  o.xx += l.mass * (l.cy * l.cy + l.cz * l.cz);
  o.yy += l.mass * (l.cx * l.cx + l.cz * l.cz);
  o.zz += l.mass * (l.cx * l.cx + l.cy * l.cy);
  o.xy -= l.mass * l.cx * l.cy;
  o.xz -= l.mass * l.cx * l.cz;
  o.yz -= l.mass * l.cy * l.cz;
  return o;
}

/// Returns I v, where I is the tensor of link i about the origin of its frame, kg m^2. [any]
template <class R, int i, class V>
constexpr auto inertia_times(const V& v) {
  constexpr auto xx = typed([] { return about_joint(R::kLinks[i]).xx; });
  constexpr auto xy = typed([] { return about_joint(R::kLinks[i]).xy; });
  constexpr auto xz = typed([] { return about_joint(R::kLinks[i]).xz; });
  constexpr auto yy = typed([] { return about_joint(R::kLinks[i]).yy; });
  constexpr auto yz = typed([] { return about_joint(R::kLinks[i]).yz; });
  constexpr auto zz = typed([] { return about_joint(R::kLinks[i]).zz; });
  return TypedVector{xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                     xz * v.x + yz * v.y + zz * v.z};
}

}  // namespace tactus
