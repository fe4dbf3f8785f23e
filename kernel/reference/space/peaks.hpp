// MotionPeaks: velocity, acceleration and jerk by channel. In joint space each joint is a channel;
// in task space the lengths of translation and of rotation are one channel each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

/// Accuracy of the bounds when a segment is measured. kQuick fits into a cycle in addition to a
/// kClose one, kClose fits into a cycle, kFine gives the tightest bounds outside the cycle.
enum class Accuracy : std::uint8_t { kQuick, kClose, kFine };

/// Velocity, acceleration and jerk of each channel, as limits or as largest values of a motion.
template <int n>
struct MotionPeaks {
  std::array<double, static_cast<std::size_t>(n)> v{}, a{}, j{};

  /// Returns the same velocities, with accelerations and jerks times `share`. [any]
  MotionPeaks reserved(double share) const {
    MotionPeaks left = *this;
    for (double& a_max : left.a) a_max *= share;
    for (double& j_max : left.j) j_max *= share;
    return left;
  }
};

}  // namespace tactus
