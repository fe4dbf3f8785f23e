// DriveFacts: the scaling and identity that a drive reports by SDO before its first command, and
// what must agree with the pipeline file: which drive it is, the torque that it is rated for, the
// torque at which it ends, and the units of its positions and velocities. An object that a drive
// does not have is not compared; a value that is needed must then be in the file. The error
// code is not compared: a drive in fault does not send it again.
//
// CiA 402-2: position and velocity are in user-defined units. A revolution of the motor has
//
//   increments   608Fh:1 / 608Fh:2
//   feed         6092h:1 / 6092h:2  per revolution of the shaft
//   an angle     of the shaft, 60A8h and 60A9h
//
// where the shaft turns 6091h:2 times while the motor turns 6091h:1 times.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "hal/cia402/cia402_settings.hpp"
#include "hal/cia402/protocol.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::cia402 {

/// An object that is read, and its name in messages.
struct Fact {
  Object object;
  const char* what;
};
inline constexpr Fact kFacts[] = {
    {kSerialNumber, "serial number"},
    {kRatedTorque, "rated torque"},
    {kMaxTorque, "torque limit"},
    {kEncoderIncrements, "increments of the encoder"},
    {kEncoderRevolutions, "revolutions for these increments"},
    {kGearMotorTurns, "turns of the motor"},
    {kGearShaftTurns, "turns of the shaft"},
    {kFeedConstant, "feed constant"},
    {kFeedTurns, "turns of the shaft for this feed"},
    {kPositionUnit, "unit of positions"},
    {kVelocityUnit, "unit of velocities"},
    {kVelocityFactor, "velocity factor"},
    {kVelocityDivisor, "divisor of the velocity factor"},
    {kErrorCode, "error code"},
};
inline constexpr std::uint32_t kFactCount = std::size(kFacts);
/// The fact that is judged before the others are read: which drive it is.
inline constexpr std::uint32_t kIdentityFact = 0;
static_assert(kFacts[kIdentityFact].object.mapping() == kSerialNumber.mapping());

/// Values that a start-up has read from the drives of all joints.
struct StartupFindings {
  JointVector velocity_units = JointVector::Zero();  ///< per motor revolution per second; NaN: not
                                                     ///< known
  JointVector serials = JointVector::Zero();         ///< 0: the drive does not report one
  std::array<std::uint32_t, kDof> written{};         ///< bit i: by line i of the file
  std::array<bool, kDof> stored{};                   ///< by the drive, in its own memory
};

/// The line for the file that has the serial numbers compared from now on; empty if they are, or if
/// a drive has none. [init]
Message unstated(const Cia402Settings& drive, const StartupFindings& findings);

class DriveFacts {
 public:
  void clear() { known_ = 0; }
  /// Takes the value of kFacts[row]. [init]
  void set(std::uint32_t row, std::uint32_t value) {
    values_[row] = value;
    known_ |= 1U << row;
  }
  bool has(const Object& object) const { return (known_ >> row_of(object) & 1U) != 0; }
  /// Returns the value of an object, 0 if the drive does not have it. [init]
  std::uint32_t get(const Object& object) const {
    return has(object) ? values_[row_of(object)] : 0;
  }

  /// Compares the serial number with that of the file; nothing is written to any drive before all
  /// are judged. Fails as judge(). [init]
  Status judge_identity(const Cia402Settings& drive, int joint, StartupFindings& findings,
                        Message& why) const;
  /// Compares the facts with the settings of the file for the drive of `joint`, from 0.
  /// `velocities`: the wire carries velocities of this drive, whose unit must be known. Adds to
  /// `findings` the values of the joint. kRefusedByRobot; `why` has object, value, what was
  /// expected and the line that helps. [init]
  Status judge(const Cia402Settings& drive, int joint, bool velocities, StartupFindings& findings,
               Message& why) const;

 private:
  /// The row of kFacts; behind the last for an object that is none of them.
  static constexpr std::uint32_t row_of(const Object& object) {
    std::uint32_t row = 0;
    while (row < kFactCount && kFacts[row].object.mapping() != object.mapping()) ++row;
    return row;
  }
  double ratio(const Object& above, const Object& below) const;
  double of_turn(std::uint32_t unit, double increments) const;
  double position_units(double increments) const;
  double reported_velocity_units(double increments) const;
  Status judge_torque(const Cia402Settings& drive, int joint, Message& why) const;
  Status judge_positions(const Cia402Settings& drive, int joint, Message& why) const;
  Status judge_velocities(double stated, double reported, Message& why) const;

  std::array<std::uint32_t, kFactCount> values_{};
  std::uint32_t known_ = 0;
};

}  // namespace tactus::cia402
