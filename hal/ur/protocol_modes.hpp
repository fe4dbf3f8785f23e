// The numbers by which a UR controller names its modes on every port, and their names on the
// dashboard. Universal Robots, "Remote Control Via TCP/IP" and "Real-Time Data Exchange Guide".
#pragma once

#include <cstdint>

namespace tactus::ur {

enum class RobotMode : std::int8_t {
  kNoController = -1,
  kDisconnected = 0,
  kConfirmSafety = 1,
  kBooting = 2,
  kPowerOff = 3,
  kPowerOn = 4,
  kIdle = 5,
  kBackdrive = 6,
  kRunning = 7,
  kUpdatingFirmware = 8,
};

constexpr const char* name(RobotMode mode) {
  constexpr const char* kNames[] = {
      "NO_CONTROLLER", "DISCONNECTED", "CONFIRM_SAFETY", "BOOTING", "POWER_OFF",
      "POWER_ON",      "IDLE",         "BACKDRIVE",      "RUNNING", "UPDATING_FIRMWARE"};
  return kNames[static_cast<int>(mode) + 1];
}

enum class SafetyMode : std::uint8_t {
  kNormal = 1,
  kReduced = 2,
  kProtectiveStop = 3,
  kRecovery = 4,
  kSafeguardStop = 5,
  kSystemEmergencyStop = 6,
  kRobotEmergencyStop = 7,
  kViolation = 8,
  kFault = 9,
  kValidateJointId = 10,
  kUndefined = 11,
};

constexpr const char* name(SafetyMode mode) {
  constexpr const char* kNames[] = {"",
                                    "NORMAL",
                                    "REDUCED",
                                    "PROTECTIVE_STOP",
                                    "RECOVERY",
                                    "SAFEGUARD_STOP",
                                    "SYSTEM_EMERGENCY_STOP",
                                    "ROBOT_EMERGENCY_STOP",
                                    "VIOLATION",
                                    "FAULT",
                                    "VALIDATE_JOINT_ID",
                                    "UNDEFINED"};
  return kNames[static_cast<int>(mode)];
}

enum class JointMode : std::uint8_t {
  kPowerOff = 239,
  kMotorInitialisation = 246,
  kBooting = 247,
  kFault = 252,
  kRunning = 253,
  kIdle = 255,
};

enum class RuntimeState : std::uint8_t {
  kStopping = 0,
  kStopped = 1,
  kPlaying = 2,
  kPausing = 3,
  kPaused = 4,
  kResuming = 5,
};

/// robot_status_bits.
enum RobotStatusBit : std::uint32_t {
  kPowerOnBit = 1u << 0,
  kProgramRunningBit = 1u << 1,
  kTeachButtonBit = 1u << 2,
  kPowerButtonBit = 1u << 3,
};

/// safety_status_bits.
enum SafetyStatusBit : std::uint32_t {
  kNormalBit = 1u << 0,
  kReducedBit = 1u << 1,
  kProtectiveStopBit = 1u << 2,
  kRecoveryBit = 1u << 3,
  kSafeguardStopBit = 1u << 4,
  kSystemEmergencyStopBit = 1u << 5,
  kRobotEmergencyStopBit = 1u << 6,
  kEmergencyStoppedBit = 1u << 7,
  kViolationBit = 1u << 8,
  kFaultBit = 1u << 9,
  kStoppedDueToSafetyBit = 1u << 10,
};

}  // namespace tactus::ur
