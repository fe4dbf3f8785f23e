// DigitalOutputs: what is commanded of a robot's digital outputs, a gripper's valve for example.
#pragma once

#include <cstdint>

namespace tactus {

/// Bit i is output i of the robot. Outputs whose bit of the mask is 0 are left alone.
struct DigitalOutputs {
  std::uint32_t value = 0, mask = 0;

  /// Commands what `newer` does, and all else as before. [any]
  void set(const DigitalOutputs& newer) {
    value = (value & ~newer.mask) | (newer.value & newer.mask);
    mask |= newer.mask;
  }
  bool operator==(const DigitalOutputs& other) const {
    return value == other.value && mask == other.mask;
  }
  bool operator!=(const DigitalOutputs& other) const { return !(*this == other); }
};

/// Digital outputs that a robot can have.
inline constexpr int kMostOutputs = 32;

}  // namespace tactus
