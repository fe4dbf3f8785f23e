// The numbers of a UR controller's modes on all ports, and their names on the dashboard. Universal
// Robots, "Remote Control Via TCP/IP" and "Real-Time Data Exchange Guide".
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
  switch (mode) {
    case RobotMode::kNoController: return "NO_CONTROLLER";
    case RobotMode::kDisconnected: return "DISCONNECTED";
    case RobotMode::kConfirmSafety: return "CONFIRM_SAFETY";
    case RobotMode::kBooting: return "BOOTING";
    case RobotMode::kPowerOff: return "POWER_OFF";
    case RobotMode::kPowerOn: return "POWER_ON";
    case RobotMode::kIdle: return "IDLE";
    case RobotMode::kBackdrive: return "BACKDRIVE";
    case RobotMode::kRunning: return "RUNNING";
    case RobotMode::kUpdatingFirmware: return "UPDATING_FIRMWARE";
  }
  return nullptr;
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
  switch (mode) {
    case SafetyMode::kNormal: return "NORMAL";
    case SafetyMode::kReduced: return "REDUCED";
    case SafetyMode::kProtectiveStop: return "PROTECTIVE_STOP";
    case SafetyMode::kRecovery: return "RECOVERY";
    case SafetyMode::kSafeguardStop: return "SAFEGUARD_STOP";
    case SafetyMode::kSystemEmergencyStop: return "SYSTEM_EMERGENCY_STOP";
    case SafetyMode::kRobotEmergencyStop: return "ROBOT_EMERGENCY_STOP";
    case SafetyMode::kViolation: return "VIOLATION";
    case SafetyMode::kFault: return "FAULT";
    case SafetyMode::kValidateJointId: return "VALIDATE_JOINT_ID";
    case SafetyMode::kUndefined: return "UNDEFINED";
  }
  return nullptr;
}

enum class JointMode : std::uint8_t {
  kPowerOff = 239,
  kMotorInitialisation = 246,
  kBooting = 247,
  kFault = 252,
  kRunning = 253,
  kIdle = 255,
};

enum class RuntimeState : std::uint32_t {
  kStopping = 0,
  kStopped = 1,
  kPlaying = 2,
  kPausing = 3,
  kPaused = 4,
  kResuming = 5,
};

constexpr const char* name(RuntimeState state) {
  switch (state) {
    case RuntimeState::kStopping: return "stopping";
    case RuntimeState::kStopped: return "stopped";
    case RuntimeState::kPlaying: return "playing";
    case RuntimeState::kPausing: return "pausing";
    case RuntimeState::kPaused: return "paused";
    case RuntimeState::kResuming: return "resuming";
  }
  return nullptr;
}

/// Bits of the RTDE field robot_status_bits.
enum RobotStatusBit : std::uint32_t {
  kPowerOnBit = 1u << 0,
  kProgramRunningBit = 1u << 1,
  kTeachButtonBit = 1u << 2,
  kPowerButtonBit = 1u << 3,
};

/// Bits of the RTDE field safety_status_bits.
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
