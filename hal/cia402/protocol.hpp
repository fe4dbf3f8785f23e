// CiA 402 (IEC 61800-7-201) on the wire: statusword, controlword, modes of operation and the
// objects of a drive. No behaviour: the master and the emulated drives share these definitions.
#pragma once

#include <cstdint>

namespace tactus::cia402 {

/// Bit of the statusword, 6041h, set in the two fault states only.
inline constexpr std::uint16_t kFaultBit = 0x0008;

// Bits of the statusword, 6041h, that do not belong to the state.
inline constexpr std::uint16_t kVoltageEnabled = 0x0010;
inline constexpr std::uint16_t kWarning = 0x0080;
inline constexpr std::uint16_t kRemote = 0x0200;
inline constexpr std::uint16_t kInternalLimit = 0x0800;
inline constexpr std::uint16_t kFollowsCommand = 0x1000;  ///< in the cyclic synchronous modes

// The same in homing mode (CiA 402-2 / IEC 61800-7-201, homing mode): attained and reached without
// an error is homed.
inline constexpr std::uint16_t kTargetReached = 0x0400;
inline constexpr std::uint16_t kHomingAttained = 0x1000;
inline constexpr std::uint16_t kHomingError = 0x2000;

enum class State : std::uint8_t {
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
};

constexpr const char* name(State state) {
  switch (state) {
    case State::kNotReadyToSwitchOn: return "not ready to switch on";
    case State::kSwitchOnDisabled: return "switch on disabled";
    case State::kReadyToSwitchOn: return "ready to switch on";
    case State::kSwitchedOn: return "switched on";
    case State::kOperationEnabled: return "operation enabled";
    case State::kQuickStopActive: return "quick stop active";
    case State::kFaultReactionActive: return "fault reaction active";
    case State::kFault: return "fault";
  }
  return nullptr;
}

/// A state as its statusword shows it: `word & mask == value`.
struct StatePattern {
  State state;
  std::uint16_t mask, value;
};

/// In the order in which they are compared. A word that matches none is "not ready to switch on".
inline constexpr StatePattern kStatePatterns[] = {
    {State::kFaultReactionActive, 0x004F, 0x000F}, {State::kFault, 0x004F, 0x0008},
    {State::kOperationEnabled, 0x006F, 0x0027},    {State::kQuickStopActive, 0x006F, 0x0007},
    {State::kSwitchedOn, 0x006F, 0x0023},          {State::kReadyToSwitchOn, 0x006F, 0x0021},
    {State::kSwitchOnDisabled, 0x004F, 0x0040},    {State::kNotReadyToSwitchOn, 0x004F, 0x0000}};

/// Returns the state that a statusword shows. [any]
constexpr State state_of(std::uint16_t statusword) {
  for (const StatePattern& row : kStatePatterns)
    if ((statusword & row.mask) == row.value) return row.state;
  return State::kNotReadyToSwitchOn;
}
/// False for a statusword that shows no state of the standard. [any]
constexpr bool is_standard(std::uint16_t statusword) {
  for (const StatePattern& row : kStatePatterns)
    if ((statusword & row.mask) == row.value) return true;
  return false;
}

// The controlword, 6040h: commands as their usual words.
inline constexpr std::uint16_t kDisableVoltage = 0x0000;
inline constexpr std::uint16_t kQuickStop = 0x0002;
inline constexpr std::uint16_t kShutdown = 0x0006;
inline constexpr std::uint16_t kSwitchOn = 0x0007;
inline constexpr std::uint16_t kEnableOperation = 0x000F;
inline constexpr std::uint16_t kFaultReset = 0x0080;  ///< its rising edge
/// Beside "enable operation", in homing mode: its rising edge starts, 0 interrupts.
inline constexpr std::uint16_t kStartHoming = 0x0010;

/// Modes of operation, 6060h and 6061h. Bit mode - 1 of 6502h: the drive has it.
enum class Mode : std::int8_t {
  kNone = 0,
  kProfilePosition = 1,
  kProfileVelocity = 3,
  kProfileTorque = 4,
  kHoming = 6,
  kCyclicPosition = 8,
  kCyclicVelocity = 9,
  kCyclicTorque = 10,
};

/// Returns the name of a mode, never null. [any]
constexpr const char* name(Mode mode) {
  switch (mode) {
    case Mode::kNone: return "none";
    case Mode::kProfilePosition: return "profile position";
    case Mode::kProfileVelocity: return "profile velocity";
    case Mode::kProfileTorque: return "profile torque";
    case Mode::kHoming: return "homing";
    case Mode::kCyclicPosition: return "cyclic synchronous position";
    case Mode::kCyclicVelocity: return "cyclic synchronous velocity";
    case Mode::kCyclicTorque: return "cyclic synchronous torque";
  }
  return "a mode that the standard does not have here";
}

constexpr bool supports(std::uint32_t supported_modes, Mode mode) {
  const int bit = static_cast<int>(mode) - 1;
  return bit >= 0 && bit < 32 && (supported_modes >> bit & 1U) != 0;
}

/// An object of the dictionary: index, sub-index and its size on the wire.
struct Object {
  std::uint16_t index;
  std::uint8_t sub, bytes;

  /// As an entry of a PDO mapping (CiA 301, 7.4.7): index, sub-index, length in bits.
  constexpr std::uint32_t mapping() const {
    return std::uint32_t{index} << 16 | std::uint32_t{sub} << 8 | std::uint32_t{bytes} * 8U;
  }
};

inline constexpr Object kStoreParameters = {0x1010, 1, 4};         // u32, kSaveSignature
inline constexpr Object kSerialNumber = {0x1018, 4, 4};            // u32
inline constexpr Object kAbortConnectionOption = {0x6007, 0, 2};   // i16
inline constexpr Object kErrorCode = {0x603F, 0, 2};               // u16
inline constexpr Object kControlword = {0x6040, 0, 2};             // u16
inline constexpr Object kStatusword = {0x6041, 0, 2};              // u16
inline constexpr Object kQuickStopOption = {0x605A, 0, 2};         // i16
inline constexpr Object kShutdownOption = {0x605B, 0, 2};          // i16
inline constexpr Object kDisableOperationOption = {0x605C, 0, 2};  // i16
inline constexpr Object kHaltOption = {0x605D, 0, 2};              // i16
inline constexpr Object kFaultReactionOption = {0x605E, 0, 2};     // i16
inline constexpr Object kModeOfOperation = {0x6060, 0, 1};         // i8
inline constexpr Object kModeDisplay = {0x6061, 0, 1};             // i8
inline constexpr Object kPositionActual = {0x6064, 0, 4};          // i32, increments
inline constexpr Object kVelocityActual = {0x606C, 0, 4};          // i32, in units of 60A9h
inline constexpr Object kTargetTorque = {0x6071, 0, 2};            // i16, permille of 6076h
inline constexpr Object kMaxTorque = {0x6072, 0, 2};               // u16, permille of 6076h
inline constexpr Object kTorqueDemand = {0x6074, 0, 2};            // i16, permille of 6076h
inline constexpr Object kRatedTorque = {0x6076, 0, 4};             // u32, mN m
inline constexpr Object kTorqueActual = {0x6077, 0, 2};            // i16, permille of 6076h
inline constexpr Object kTargetPosition = {0x607A, 0, 4};          // i32, increments
inline constexpr Object kQuickStopDeceleration = {0x6085, 0, 4};   // u32, increments/s^2
inline constexpr Object kEncoderIncrements = {0x608F, 1, 4};       // u32, per kEncoderRevolutions
inline constexpr Object kEncoderRevolutions = {0x608F, 2, 4};      // u32, of the motor
inline constexpr Object kGearMotorTurns = {0x6091, 1, 4};          // u32, per kGearShaftTurns
inline constexpr Object kGearShaftTurns = {0x6091, 2, 4};          // u32
inline constexpr Object kFeedConstant = {0x6092, 1, 4};            // u32, per kFeedTurns
inline constexpr Object kFeedTurns = {0x6092, 2, 4};               // u32, of the shaft
inline constexpr Object kVelocityFactor = {0x6096, 1, 4};          // u32, per kVelocityDivisor
inline constexpr Object kVelocityDivisor = {0x6096, 2, 4};         // u32
inline constexpr Object kHomingMethod = {0x6098, 0, 1};            // i8
inline constexpr Object kPositionUnit = {0x60A8, 0, 4};            // u32
inline constexpr Object kVelocityUnit = {0x60A9, 0, 4};            // u32
inline constexpr Object kVelocityOffset = {0x60B1, 0, 4};          // i32, in units of 60A9h
inline constexpr Object kTorqueOffset = {0x60B2, 0, 2};            // i16, permille of 6076h
inline constexpr Object kPeriodValue = {0x60C2, 1, 1};             // u8: period = value 10^index s
inline constexpr Object kPeriodIndex = {0x60C2, 2, 1};             // i8
inline constexpr Object kDigitalOutputs = {0x60FE, 1, 4};          // u32
inline constexpr Object kTargetVelocity = {0x60FF, 0, 4};          // i32, in units of 60A9h
inline constexpr Object kSupportedModes = {0x6502, 0, 4};          // u32

/// A period as 60C2h has it: value * 10^index s.
struct PeriodObject {
  std::uint8_t value = 0;  ///< 0: not expressible in 8 bits
  std::int8_t index = 0;
};
/// Returns the object for a period, in the largest unit from 1 ms to 1 us that has it exactly.
/// [any]
constexpr PeriodObject period_object(int period_us) {
  int value = period_us, index = -6;
  for (int i = 0; i < 3 && value % 10 == 0; ++i) {
    value /= 10;
    ++index;
  }
  if (value > 255) return {};
  return {static_cast<std::uint8_t>(value), static_cast<std::int8_t>(index)};
}

/// Value to write to 1010h:1: "save" (CiA 301, 7.5.2.13).
inline constexpr std::uint32_t kSaveSignature = 0x65766173;
/// Low word of the device type, 1000h: the profile of a drive.
inline constexpr std::uint32_t kDriveProfile = 402;
/// Device type of a servo drive.
inline constexpr std::uint32_t kServoDrive = 0x00020192;

}  // namespace tactus::cia402
