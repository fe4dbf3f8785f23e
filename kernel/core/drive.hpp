// Drive: the reported state of the drive of one joint, and the requests that it takes. The states
// are what the drives of all robots have in common; a Hal maps its own state machine onto them
// (CiA 402, IEC 61800-7-201: "operation enabled" is kEnabled, "quick stop active" is kStopping).
#pragma once

#include <cstdint>

#include "kernel/core/status.hpp"

namespace tactus {

enum class DriveState : std::uint8_t {
  kUnknown,   ///< nothing was heard of it
  kDisabled,  ///< exerts no torque; its brake, if it has one, is closed
  kArming,    ///< on its way to enabled
  kEnabled,   ///< holds its joint, and follows commands if that is requested
  kStopping,  ///< on its way to disabled
  kFault,     ///< disabled by a fault; arming clears it if its cause has gone
};

constexpr const char* name(DriveState state) {
  switch (state) {
    case DriveState::kUnknown: return "unknown";
    case DriveState::kDisabled: return "disabled";
    case DriveState::kArming: return "arming";
    case DriveState::kEnabled: return "enabled";
    case DriveState::kStopping: return "stopping";
    case DriveState::kFault: return "fault";
  }
  return nullptr;
}

struct Drive {
  DriveState state = DriveState::kUnknown;
  bool valid = false;           ///< q, dq and tau of its joint are measured values
  Status reason = Status::kOk;  ///< of kFault: kDriveFault, kNotReferenced, kProtectiveStop ...
  bool warns = false;           ///< by its own word, without a fault
  std::uint32_t code = 0;       ///< the drive's own number of fault or warning; 0: none
};

enum class DriveRequest : std::uint8_t {
  kDisable,  ///< stop by its own means, then exert no torque
  kArm,      ///< clear the fault, become enabled, and hold the joint without a command
  kFollow,   ///< follow the commands
};

}  // namespace tactus
