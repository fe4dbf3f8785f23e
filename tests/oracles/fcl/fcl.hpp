// The Flexible Collision Library as the oracle for distances. The interface uses plain arrays
// because Debian's FCL is compiled with vectorised Eigen, whose types have another layout than
// ours. The code that calls FCL is compiled in the same way, into a shared library that exports
// only these functions.
#pragma once

namespace fcl_oracle {

/// A frame in the base frame: origin, m, and rotation matrix row by row.
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

/// Distance, m; zero or negative if they touch. Uses FCL's own algorithms, not those of libccd.
[[gnu::visibility("default")]] double fcl_distance(const FclCapsule& one, const FclPlace& at,
                                                   const FclCapsule& other,
                                                   const FclPlace& other_at);
[[gnu::visibility("default")]] double fcl_distance(const FclCapsule& one, const FclPlace& at,
                                                   const FclBox& box, const FclPlace& box_at);

}  // namespace fcl_oracle

namespace tactus {
using namespace fcl_oracle;  // the library is no robot's
}
