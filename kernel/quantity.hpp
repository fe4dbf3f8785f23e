// Quantity: what a port carries. The one table of names, units, frames and value types.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/types.hpp"

namespace tactus {

enum class Quantity : std::uint8_t {
  kJointPosition,
  kJointVelocity,
  kJointAcceleration,
  kJointEffort,
  kPose,
  kTwist,
  kJacobian,
  kTool,
};

struct QuantityInfo {
  const char* name;
  const char* unit;
  const char*
      components;  ///< suffixes of the recorded columns, separated by spaces; "" = one per joint
  int recorded;    ///< numbers per value in the recorder; 0 = not recorded
};

/// Poses and twists are of the tool tip, in the base frame. Indexed by Quantity.
inline constexpr std::array<QuantityInfo, 8> kQuantities = {{
    {"joint position", "rad", "", kDof},
    {"joint velocity", "rad/s", "", kDof},
    {"joint acceleration", "rad/s^2", "", kDof},
    {"joint effort", "N m", "", kDof},
    {"pose", "m, quaternion", "x y z qw qx qy qz", 7},
    {"twist", "m/s, rad/s", "vx vy vz wx wy wz", 6},
    {"jacobian", "m, 1", "", 0},
    {"tool", "kg, m", "", 0},
}};
static_assert(kQuantities.size() == static_cast<std::size_t>(Quantity::kTool) + 1);

constexpr const QuantityInfo& info(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

/// Value type of a quantity and its neutral value: zero, the identity, no tool.
template <Quantity>
struct QuantityValue {
  using Type = JointVector;
  static Type neutral() { return JointVector::Zero(); }
};
template <>
struct QuantityValue<Quantity::kPose> {
  using Type = Pose;
  static Type neutral() { return {}; }
};
template <>
struct QuantityValue<Quantity::kTwist> {
  using Type = Vector6;
  static Type neutral() { return Vector6::Zero(); }
};
template <>
struct QuantityValue<Quantity::kJacobian> {
  using Type = Jacobian;
  static Type neutral() { return Jacobian::Zero(); }
};
template <>
struct QuantityValue<Quantity::kTool> {
  using Type = Tool;
  static Type neutral() { return {}; }
};

template <Quantity Q>
using ValueOf = typename QuantityValue<Q>::Type;

}  // namespace tactus
