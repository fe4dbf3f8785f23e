// Proves how far a capsule is apart from another capsule or from a box, at a fixed cost.
//
// The nearest points of the capsule's segment and of the other shape are found in closed form. What
// is proved is the gap along the direction between these points: from the end of one shape to the
// beginning of the other. A nearest point that rounding has moved can thus spoil a proof, but not
// make a false one.
#pragma once

#include "kernel/core/types.hpp"

namespace tactus {

/// All points within `radius` of the segment from a to b.
struct Capsule {
  Vector3 a = Vector3::Zero(), b = Vector3::Zero();  ///< m, base frame
  double radius = 0.0;                               ///< m
};

/// A box, given by its axes, centre and half size.
struct BoxShape {
  Matrix3 r = Matrix3::Identity();
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();  ///< m, base frame
};

/// Returns a distance that the shapes are apart at least, m: theirs but for rounding. A negative
/// one and NaN prove nothing. [cyclic]
double separation(const Capsule& capsule, const Capsule& other);
double separation(const Capsule& capsule, const BoxShape& box);

}  // namespace tactus
