// One tolerance of a goal against the generator's default.
#pragma once

namespace tactus {

/// A goal's value > 0 holds, a negative one is off (0), anything else, NaN too, keeps the default.
/// [any]
constexpr double merge_tolerance(double goal, double fallback) {
  return goal > 0.0 ? goal : goal < 0.0 ? 0.0 : fallback;
}

}  // namespace tactus
