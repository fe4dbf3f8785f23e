// The Flexible Collision Library as a second opinion on distances. Plain arrays only: Debian's FCL
// is compiled with vectorised Eigen, which lays its types out otherwise than ours. So what calls it
// is compiled that way too, and into a shared library that hides everything but these functions.
#pragma once

namespace tactus {

/// Where a frame stands in the base frame: origin, m, and rotation matrix row by row.
struct FclPlace {
  double p[3];
  double r[3][3];
};

/// Points within `radius` of a segment of `length` about `centre` along `axis`, of any size; m.
struct FclCapsule {
  double centre[3], axis[3];
  double radius, length;
};

/// A box about the origin of its frame, by the lengths of its edges, m.
struct FclBox {
  double size[3];
};

/// Distance, m; not positive if they meet. By FCL's own algorithms, not those of libccd.
[[gnu::visibility("default")]] double fcl_distance(const FclCapsule& one, const FclPlace& at,
                                                   const FclCapsule& other,
                                                   const FclPlace& other_at);
[[gnu::visibility("default")]] double fcl_distance(const FclCapsule& one, const FclPlace& at,
                                                   const FclBox& box, const FclPlace& box_at);

}  // namespace tactus
