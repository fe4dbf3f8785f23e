// Velocity: a reference for the joints or the tip that names no place.
#pragma once

#include <cstdint>

namespace tactus {

template <class Space>
struct Velocity {
  /// rad/s; or m/s and rad/s in the axes of the base frame, or of the frame that comes with it.
  typename Space::Rates rates = Space::Rates::Zero();
  bool in_tool = false;       ///< in the axes of the tip instead, with which it turns
  double timeout_s = 0.0;     ///< > 0; when it has passed, the reference comes to rest
  double acceleration = 1.0;  ///< share of the acceleration limits that it may use, 0..1
  double jerk = 1.0;          ///< share of the jerk limits
  /// As those of a chunk; epoch 0: it is of no stream, and none is older.
  std::uint32_t epoch = 0, sequence = 0;
};

}  // namespace tactus
