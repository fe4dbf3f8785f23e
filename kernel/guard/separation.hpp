// Decides whether a capsule and another shape are apart, by the Gilbert-Johnson-Keerthi algorithm
// of libccd (Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation, 1988).
//
// libccd answers "no intersection" also when its iterations are used up and when a simplex or a
// direction degenerates. So its answer is not used. Two shapes count as apart only with a proof: a
// direction, among those in which libccd asked for support points, along which all of one shape is
// before all of the other. NaN proves nothing.
#pragma once

#include "kernel/core/types.hpp"

namespace tactus {

/// All points within `radius` of the segment from a to b.
struct Capsule {
  Vector3 a = Vector3::Zero(), b = Vector3::Zero();  ///< m, base frame
  double radius = 0.0;                               ///< m

  Vector3 centre() const { return 0.5 * (a + b); }
};

/// A box, given by its axes, centre and half size.
struct BoxShape {
  Matrix3 r = Matrix3::Identity();
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();  ///< m, base frame
};

inline constexpr int kGjkIterations = 30;
/// Most support points one pair can ask for: two before the first iteration, two in each.
inline constexpr int kSupportCallsOfPair = 2 * (1 + kGjkIterations);

/// The verdict and its cost.
struct Separation {
  bool proved = false;
  int support_calls = 0;  ///< at most kSupportCallsOfPair
};

/// Tries to prove that the two shapes are apart, the first made thicker by `inflation` >= 0 m.
/// [cyclic]
Separation separate(const Capsule& capsule, const Capsule& other, double inflation);
Separation separate(const Capsule& capsule, const BoxShape& box, double inflation);

/// True if balls around the capsules prove that the shapes are apart; false proves nothing.
/// [cyclic]
bool far_apart(const Capsule& capsule, const Capsule& other, double inflation);
bool far_apart(const Capsule& capsule, const BoxShape& box, double inflation);

}  // namespace tactus
