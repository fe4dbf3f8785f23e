// Quantity: what a port carries. The only table of names, units, frames and value types.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

enum class Quantity : std::uint8_t {
  kJointPosition,
  kJointVelocity,
  kJointAcceleration,
  kJointEffort,
  kPose,
  kTwist,
  kTaskAcceleration,
  kWrench,
  kWrenchRate,
  kSensorWrench,
  kJacobian,
  kTool,
  kBox,
  kFlag,
  kScalar,
  kDigitalOutputs,
};

struct QuantityInfo {
  const char* name;
  const char* unit;
  const char*
      components;  ///< suffixes of the recorded columns, separated by spaces; "" = one per joint
  int recorded;    ///< numbers per value in the recorder; 0 = not recorded
};

/// Indexed by Quantity. Poses, twists and wrenches refer to the tool tip, in the base frame; a
/// wrench is exerted by the environment on the tool. A sensor wrench is the output of a
/// force/torque sensor at the flange: about the flange's origin, in its axes, including the weight
/// of the tool.
inline constexpr std::array<QuantityInfo, 16> kQuantities = {{
    {"joint position", has_prismatic<Robot>() ? "rad, m" : "rad", "", kDof},
    {"joint velocity", has_prismatic<Robot>() ? "rad/s, m/s" : "rad/s", "", kDof},
    {"joint acceleration", has_prismatic<Robot>() ? "rad/s^2, m/s^2" : "rad/s^2", "", kDof},
    {"joint effort", has_prismatic<Robot>() ? "N m, N" : "N m", "", kDof},
    {"pose", "m, quaternion", "x y z qw qx qy qz", 7},
    {"twist", "m/s, rad/s", "vx vy vz wx wy wz", 6},
    {"task acceleration", "m/s^2, rad/s^2", "ax ay az alphax alphay alphaz", 6},
    {"wrench", "N, N m", "fx fy fz mx my mz", 6},
    {"wrench rate", "N/s, N m/s", "dfx dfy dfz dmx dmy dmz", 6},
    {"sensor wrench", "N, N m", "fx fy fz mx my mz", 6},
    {"jacobian", "m, 1", "", 0},
    {"tool", "kg, m", "", 0},
    {"box", "m", "", 0},
    {"flag", "0 or 1", "on", 1},
    {"scalar", "1", "value", 1},
    {"digital outputs", "bits", "value mask", 2},
}};
static_assert(kQuantities.size() == static_cast<std::size_t>(Quantity::kDigitalOutputs) + 1);

constexpr const QuantityInfo& info(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

/// True if the value is a Vector6, linear part or force first.
constexpr bool is_task_vector(Quantity quantity) {
  return quantity >= Quantity::kTwist && quantity <= Quantity::kSensorWrench;
}

/// Value type of a quantity and its neutral value: zero, the identity, no tool.
template <Quantity Q>
struct QuantityValue {
  using Type = std::conditional_t<is_task_vector(Q), Vector6, JointVector>;
  static Type neutral() { return Type::Zero(); }
};
template <>
struct QuantityValue<Quantity::kPose> {
  using Type = Pose;
  static Type neutral() { return {}; }
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
template <>
struct QuantityValue<Quantity::kBox> {
  using Type = Cuboid;
  static Type neutral() { return {}; }
};
template <>
struct QuantityValue<Quantity::kFlag> {
  using Type = bool;
  static Type neutral() { return false; }
};

template <>
struct QuantityValue<Quantity::kScalar> {
  using Type = double;
  static Type neutral() { return 0.0; }
};

template <>
struct QuantityValue<Quantity::kDigitalOutputs> {
  using Type = DigitalOutputs;
  static Type neutral() { return {}; }
};

template <Quantity Q>
using ValueOf = typename QuantityValue<Q>::Type;

}  // namespace tactus
