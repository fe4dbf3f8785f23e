// How waypoints are joined: by the fields they give, or as the goal says.
#pragma once

#include <cstdint>

namespace tactus {

/// Which fields of a waypoint are given; the position always is.
enum Field : std::uint8_t { kVelocityField = 1, kAccelerationField = 2, kEffortField = 4 };
using Fields = std::uint8_t;

/// How waypoints are joined: by the fields both ends have, or forced. kMonotone is a cubic whose
/// velocities admission chooses or lowers so that it does not overshoot (monotone.hpp).
enum class Interpolation : std::uint8_t { kByFields, kLinear, kCubic, kQuintic, kMonotone };

/// The polynomials of a segment whose ends both give `fields`: kLinear, kCubic or kQuintic. [any]
constexpr Interpolation order_of(Interpolation how, Fields fields) {
  if (how == Interpolation::kMonotone) return Interpolation::kCubic;
  if (how != Interpolation::kByFields) return how;
  if (!(fields & kVelocityField)) return Interpolation::kLinear;
  return fields & kAccelerationField ? Interpolation::kQuintic : Interpolation::kCubic;
}

}  // namespace tactus
