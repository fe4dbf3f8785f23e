// Convex bodies that are neither capsules nor full boxes: what is inside a box of the file, and the
// tool. Each is all points within `rounding` of a core.
#pragma once

#include <cstdint>

#include "kernel/core/hull.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

/// A body in its own axes, from its middle.
struct Convex {
  enum class Core : std::uint8_t { kSegment, kBox, kCylinder, kHull };

  Core core = Core::kBox;
  double rounding = 0.0;             ///< m
  Vector3 half = Vector3::Zero();    ///< of a box, of a cylinder along z, of a segment, m
  const Hull* hull = nullptr;        ///< of kHull
  Vector3 middle = Vector3::Zero();  ///< of the hull's box, m, in the frame of its points

  /// Takes a hull, and the middle of the box around it; returns the size of that box, m. [init]
  Vector3 take(const Hull& points);
  /// Returns the point of the core that is farthest along n, m. [cyclic]
  Vector3 farthest(const Vector3& n) const;
};

/// A body in the base frame.
struct Solid {
  Convex convex;
  Matrix3 r = Matrix3::Identity();
  Vector3 middle = Vector3::Zero();  ///< m

  Vector3 farthest(const Vector3& n) const {
    return middle + r * convex.farthest(r.transpose() * n);
  }
};

/// Returns the radius of the capsule from the origin to `tip` that contains the points, m. [init]
double radius_around(const Hull& points, const Vector3& tip);

/// Returns a distance, m, of which a direction is a proof: along it all of one body is before all
/// of the other, by so much. It tries directions that libccd proposes until what is proved exceeds
/// `wanted`, or `directions` are used up, and takes what it has tried off them. NaN and negative
/// distances prove nothing. [cyclic]
double separation(const Solid& one, const Solid& other, double wanted, int& directions);

}  // namespace tactus
