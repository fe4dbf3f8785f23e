// The mass of a link as the algorithms want it: constants of the robot table, referred to the
// origin of the link's own joint frame and in its axes, with typed zeros.
#pragma once

#include "kernel/math/typed_vector.hpp"
#include "kernel/model/robot_table.hpp"

namespace tactus {

/// First moment m c of link i, kg m. [any]
template <class R, int i>
constexpr auto first_moment() {
  return TypedVector{typed([] { return R::kLinks[i].mass * R::kLinks[i].cx; }),
                     typed([] { return R::kLinks[i].mass * R::kLinks[i].cy; }),
                     typed([] { return R::kLinks[i].mass * R::kLinks[i].cz; })};
}

/// Mass of link i and all links it carries, kg. [any]
template <class R, int i>
constexpr double carried_mass() {
  if constexpr (i == R::kDof) {
    return 0.0;
  } else {
    return R::kLinks[i].mass + carried_mass<R, i + 1>();
  }
}

/// The tensor of a link about the origin of its frame instead of its centre of mass (Steiner):
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

/// I v, with the tensor of link i about the origin of its frame, kg m^2. [any]
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
