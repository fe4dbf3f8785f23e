// Status: the only result type of the kernel. The numbers never change: operators, logs and clients
// use them.
#pragma once

#include <cstdint>

namespace tactus {

enum class [[nodiscard]] Status : std::uint8_t{
    kOk = 0,
    // 1..31 configuration: the program refuses to start
    kMissingKey = 1,
    kUnknownKey = 2,
    kBadValue = 3,
    kUnknownPort = 4,
    kWrongQuantity = 5,
    kNotConnected = 6,
    kBadSyntax = 7,
    kDuplicate = 8,
    kUnknownType = 9,
    kTooLarge = 10,
    kNotOffered = 11,
    kUnstableGain = 12,
    kOverBudget = 13,
    // 32..63 reference: the request is refused, the robot keeps its reference
    kReferenceSize = 32,
    kReferenceNotFinite = 33,
    kPositionLimit = 34,
    kReferenceTime = 35,
    kVelocityLimit = 36,
    kAccelerationLimit = 37,
    kEffortLimit = 38,
    kNotAtRest = 39,
    kStartTolerance = 40,
    kNothingToCancel = 42,
    kNoFreeStore = 43,
    kMailboxFull = 44,
    kJerkLimit = 45,
    kVelocityStep = 46,
    kQuaternion = 47,
    kWorkspace = 48,
    kPathTolerance = 49,
    kGoalTolerance = 50,
    kBadOverride = 52,
    kNothingToExtend = 53,
    kWindowFull = 54,
    kNotStreamable = 55,
    kCannotLeave = 56,
    kLeftPath = 57,
    kGoalVelocity = 58,
    kChunkLate = 59,
    kEpochVoid = 60,
    kPaused = 61,
    kPointStep = 62,
    kSaturated = 63,
    // 64..95 cycle: the robot stops, the code is latched
    kStateNotFinite = 64,
    kReferenceFault = 65,
    kCommandNotFinite = 66,
    kMeasuredPositionLimit = 67,
    kMeasuredVelocityLimit = 68,
    kSlip = 69,
    kClock = 70,
    kNotStarted = 71,
    kSensorNotFinite = 72,
    kSensorRange = 73,
    kSensorStuck = 74,
    kSensorNotSteady = 75,
    kFollowingError = 76,
    kCollision = 77,
    kOverrun = 80,
    kStopTime = 81,
    kHalted = 82,
    kLimiting = 83,
    kArming = 84,
    kArmingTime = 85,
    kStateStale = 86,
    kStateInvalid = 87,
    kMoved = 88,
    // 96..127 wire
    kBusTimeout = 96,
    kDriveFault = 97,
    kConnectionLost = 98,
    kRobotMode = 99,
    kProtectiveStop = 100,
    kEmergencyStop = 101,
    kSafeguardStop = 102,
    kProgramStopped = 103,
    kRegistersInUse = 104,
    kWireFormat = 105,
    kRefusedByRobot = 106,
    kNotReferenced = 107,
    kBusConflict = 108,
    kMismatch = 109,
    // ... of a client of references
    kNotOwner = 110,
    kStampRange = 111,
    kTooManyMessages = 112,
    kClientSilent = 113,
    kClientSlow = 114,
    kTareLimit = 115,
};

/// Returns the identifier of a status, as in logs and summary.json: "kSlip". Never null. [any]
const char* name(Status status);

/// The meaning of a status for an operator: "too many periods missed in a row". Never null. [any]
const char* meaning(Status status);

}  // namespace tactus

/// Returns from the calling function with the Status of the expression if it is not kOk.
#define TRY(expression)                                                                  \
  do {                                                                                   \
    if (const ::tactus::Status status_ = (expression); status_ != ::tactus::Status::kOk) \
      return status_;                                                                    \
  } while (false)
