// MotionPeaks: velocity, acceleration and jerk by channels, what limits are counted by. In joint
// space each joint is a channel of one number; in task space translation and rotation are one each,
// of which lengths count.
#pragma once

#include <array>
#include <cstddef>

namespace tactus {

/// Velocity, acceleration and jerk of each channel, as limits or as what is reached of them.
template <int n>
struct MotionPeaks {
  std::array<double, static_cast<std::size_t>(n)> v{}, a{}, j{};

  /// The same velocities, and `share` of the others. [any]
  MotionPeaks reserved(double share) const {
    MotionPeaks left = *this;
    for (double& a_max : left.a) a_max *= share;
    for (double& j_max : left.j) j_max *= share;
    return left;
  }
};

}  // namespace tactus
