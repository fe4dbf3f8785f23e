// A goal's tolerance combined with the default of the generator.
#pragma once

namespace tactus {

/// Returns the goal's value if it is > 0, 0 (off) if it is negative, and the default if it is 0 or
/// NaN. [any]
constexpr double merge_tolerance(double goal, double fallback) {
  return goal > 0.0 ? goal : goal < 0.0 ? 0.0 : fallback;
}

}  // namespace tactus
