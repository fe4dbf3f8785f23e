// Proves that a capsule is apart from another capsule or from a box, at a fixed cost.
//
// The nearest points of the capsule's segment and of the other shape are found in closed form. The
// shapes count as apart only if the direction between these points separates them: along it all of
// one shape is before all of the other. A nearest point that rounding has moved can thus spoil a
// proof, but not make a false one. NaN proves nothing.
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

/// True if it is proved that the shapes are more than `margin` >= 0 m apart. [cyclic]
bool apart(const Capsule& capsule, const Capsule& other, double margin);
bool apart(const Capsule& capsule, const BoxShape& box, double margin);

}  // namespace tactus
