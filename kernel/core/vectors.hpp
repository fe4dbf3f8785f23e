// Vectors of space, the same for every robot. Linear part or force first; SI units; each value's
// declaration names its frame.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tactus {

// Where Eigen vectorises, its types are aligned otherwise, and every struct has another layout than
// in the library.
static_assert(alignof(Eigen::Vector4d) == alignof(double), "compile with -DEIGEN_DONT_VECTORIZE");

using Vector3 = Eigen::Matrix<double, 3, 1>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix<double, 3, 3>;

/// Returns a twist, an acceleration or a wrench: linear part or force above angular part or moment.
/// The size is fixed throughout, unlike Eigen's comma initializer, which a small build would loop
/// over.
inline Vector6 stacked(const Vector3& linear, const Vector3& angular) {
  Vector6 both;
  both.head<3>() = linear;
  both.tail<3>() = angular;
  return both;
}

}  // namespace tactus
