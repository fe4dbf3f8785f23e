// DrivePhase: where the drives of a UR are between disabled and enabled. The robot switches them
// all together, and a program of ours on the controller holds the arm and passes on the set-points:
//
//   off -> modes -> other program -> standstill -> register -> upload -> program
//       -> first set-point -> tip -> enabled -> stopping -> off
//
// In "modes" a protective stop is released, or power and brakes are switched, as far as the
// settings allow; then the modes are judged again. Every phase of arming may end in "fault".
#pragma once

#include "kernel/core/drive.hpp"

namespace tactus::ur {

enum class DrivePhase : std::uint8_t {
  kOff,            ///< no program of ours runs; power and brakes are as people left them
  kModes,          ///< judges the modes that the robot reports
  kReleaseStop,    ///< requests the release of a protective stop from the dashboard
  kPowerOn,        ///< requests power
  kReleaseBrakes,  ///< and to release the brakes
  kOtherProgram,   ///< waits for the end of a program, which may be the last one of ours
  kStandstill,     ///< waits for an arm at rest, and compares its tool and tip with the models
  kRegister,       ///< clears the register, so that the program does not see an old count
  kUpload,         ///< sends the program
  kProgram,        ///< waits until it runs
  kFirstSetPoint,  ///< waits until it uses a set-point, which is the position of the arm
  kTip,            ///< compares the tip with the computed one
  kEnabled,        ///< the program holds the arm, or follows
  kStopping,       ///< the program brakes and ends
  kFault,          ///< arming has failed, or the robot has stopped
};

constexpr const char* name(DrivePhase phase) {
  switch (phase) {
    case DrivePhase::kOff: return "off";
    case DrivePhase::kModes: return "modes of the robot";
    case DrivePhase::kReleaseStop: return "release of the protective stop";
    case DrivePhase::kPowerOn: return "power on";
    case DrivePhase::kReleaseBrakes: return "brake release";
    case DrivePhase::kOtherProgram: return "end of the program on the robot";
    case DrivePhase::kStandstill: return "standstill of the arm";
    case DrivePhase::kRegister: return "clearing of the register";
    case DrivePhase::kUpload: return "upload of the program";
    case DrivePhase::kProgram: return "start of the program on the robot";
    case DrivePhase::kFirstSetPoint: return "use of the first set-point";
    case DrivePhase::kTip: return "comparison of the tip";
    case DrivePhase::kEnabled: return "enabled";
    case DrivePhase::kStopping: return "stopping";
    case DrivePhase::kFault: return "fault";
  }
  return nullptr;
}

/// True from the request to arm until the program holds the arm. [any]
constexpr bool arms(DrivePhase phase) {
  return phase >= DrivePhase::kModes && phase <= DrivePhase::kTip;
}

constexpr DriveState state_of(DrivePhase phase) {
  if (arms(phase)) return DriveState::kArming;
  switch (phase) {
    case DrivePhase::kEnabled: return DriveState::kEnabled;
    case DrivePhase::kStopping: return DriveState::kStopping;
    case DrivePhase::kFault: return DriveState::kFault;
    default: return DriveState::kDisabled;
  }
}

/// Report for a phase of arming that exceeds its time.
struct PhaseTimeout {
  const char* problem = "";
  const char* remedy = "";
};

constexpr PhaseTimeout timeout_of(DrivePhase phase) {
  switch (phase) {
    case DrivePhase::kReleaseStop: return {"the protective stop was not released", ""};
    case DrivePhase::kPowerOn: return {"the robot was not powered on", ""};
    case DrivePhase::kReleaseBrakes: return {"the brakes were not released", ""};
    case DrivePhase::kOtherProgram:
      return {"the program on the robot did not end", "; stop it at the pendant"};
    case DrivePhase::kStandstill: return {"the arm did not come to rest", ""};
    case DrivePhase::kRegister: return {"the register could not be cleared", "; check the network"};
    case DrivePhase::kUpload: return {"the program could not be sent", "; check the network"};
    case DrivePhase::kProgram:
      return {"the program on the robot did not start", "; an e-Series must be in remote control"};
    case DrivePhase::kFirstSetPoint:
      return {"the program on the robot used no set-point", "; check the network"};
    case DrivePhase::kTip: return {"the tip could not be compared", "; raise program_ms"};
    default: return {};
  }
}

}  // namespace tactus::ur
