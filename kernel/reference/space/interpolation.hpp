// Interpolation between waypoints, by the fields they give or as the goal requests.
#pragma once

#include <cstdint>

namespace tactus {

/// The fields of a waypoint that are given besides the position.
enum Field : std::uint8_t { kVelocityField = 1, kAccelerationField = 2, kEffortField = 4 };
using Fields = std::uint8_t;

/// kByFields takes the highest order for which both ends give the fields; the others force one.
/// kMonotone is a cubic whose velocities admission chooses or lowers so that it does not overshoot
/// (monotone.hpp).
enum class Interpolation : std::uint8_t { kByFields, kLinear, kCubic, kQuintic, kMonotone };

constexpr const char* name(Interpolation how) {
  switch (how) {
    case Interpolation::kByFields: return "by_fields";
    case Interpolation::kLinear: return "linear";
    case Interpolation::kCubic: return "cubic";
    case Interpolation::kQuintic: return "quintic";
    case Interpolation::kMonotone: return "monotone";
  }
  return nullptr;
}

/// Returns the order of a segment whose ends both give `fields`: kLinear, kCubic or kQuintic. [any]
constexpr Interpolation order_of(Interpolation how, Fields fields) {
  if (how == Interpolation::kMonotone) return Interpolation::kCubic;
  if (how != Interpolation::kByFields) return how;
  if (!(fields & kVelocityField)) return Interpolation::kLinear;
  return fields & kAccelerationField ? Interpolation::kQuintic : Interpolation::kCubic;
}

}  // namespace tactus
