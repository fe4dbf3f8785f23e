// How long a quintic takes that brings a difference in position, velocity and acceleration to zero.
// The three may be of one axis or lengths of vectors.
#pragma once

namespace tactus {

/// Magnitudes that a bridge begins with.
struct BridgeStart {
  double p = 0.0, v = 0.0, a = 0.0;
};

/// Seconds in which the velocity of the bridge stays at most `v` and its acceleration at most `a`,
/// or what they begin with where that is more. An acceleration it begins with adds up to 0.068 a T
/// to the velocity. [any]
double bridge_time_s(const BridgeStart& start, double v, double a);

/// Seconds in which a bridge whose acceleration stays at most half of `a_max`, or begins with at
/// most twice `a_max`, keeps its jerk at most half of `j_max`. [any]
double bridge_jerk_time_s(double a_max, double j_max);

}  // namespace tactus
