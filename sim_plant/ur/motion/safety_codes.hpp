// The codes with which a CB3 reports why it stopped: code and argument, as in its error message
// "C153A2". Universal Robots, "Error codes", CB3.
#pragma once

#include <cstdint>

namespace tactus::ur {

enum class Code : std::int32_t {
  kNone = 0,
  kCloseToJointLimit = 150,
  kPathDeviation = 153,  ///< argument: joint
  kSingularity = 154,
  kCollision = 157,  ///< argument: joint
  kBlend = 171,
  kTorqueTooHigh = 173,    ///< argument: joint
  kSafetyViolation = 191,  ///< argument: the violated limit
  kPathSanity = 204,       ///< argument: see the next enumeration
  kFieldbusDisconnected = 207,
  kFromScript = 209,
};

enum PathSanity : std::int32_t {
  kSuddenChange = 1,
  kInconsistent = 2,
  kSuddenStop = 3,
  kNotStopped = 4,
  kInvalidSetPoint = 5,
};

enum BlendTrouble : std::int32_t { kOverlappingBlends = 1 };

enum SafetyViolation : std::int32_t {
  kViolatedJointPosition = 1,
  kViolatedJointSpeed = 2,
  kViolatedTcpSpeed = 3,
  kViolatedMomentum = 12,
};

struct Stop {
  Code code = Code::kNone;
  std::int32_t argument = 0;

  explicit operator bool() const { return code != Code::kNone; }
};

}  // namespace tactus::ur
