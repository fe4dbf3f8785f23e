// The calibration of an arm: every UR leaves its factory with kinematics of its own, of which the
// controller computes its poses, and which it tells on the primary port.
//
// The table of this program has the checksums of the arm that it was written for
// (scripts/robot-calibrate), or none if it is the nominal one, which fits an arm without a
// calibration.
#pragma once

#include <array>
#include <cstdint>

#include "hal/ur/protocol.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::ur {

/// A kinematics part of the robot's state. Not told: the checksums are zero, and fit no arm.
struct ArmCalibration {
  bool told = false, in_force = false;
  std::array<std::uint32_t, 6> checksums{};
  std::array<double, 24> parameters{};  ///< theta, a, d, alpha of six joints: rad, m, m, rad

  /// Takes the body of the part; false: it is of another size, and nothing is taken. [cyclic]
  bool take(ByteReader body);
  /// True if it is that of the table of this program. NaN is not. [cyclic]
  bool fits_table() const;
};

/// Compares what the controller tells with the table. `off`: how far the tip is from where the
/// table has it; empty if that is not known. kMismatch; kBusTimeout: it was not told. [cyclic]
Status check_calibration(const ArmCalibration& calibration, const Message& off, Message& why);

}  // namespace tactus::ur
