#include "kernel/core/status.hpp"

namespace tactus {
namespace {

struct StatusWords {
  const char *name = nullptr, *meaning = nullptr;
};

constexpr StatusWords words_of(Status status) {
  switch (status) {
    case Status::kOk: return {"kOk", "ok"};
    case Status::kMissingKey: return {"kMissingKey", "a required key is missing"};
    case Status::kUnknownKey: return {"kUnknownKey", "unknown key"};
    case Status::kBadValue: return {"kBadValue", "a value is malformed or out of range"};
    case Status::kUnknownPort: return {"kUnknownPort", "no output of that name"};
    case Status::kWrongQuantity: return {"kWrongQuantity", "an input is wired to another quantity"};
    case Status::kNotConnected: return {"kNotConnected", "a required input is not wired"};
    case Status::kBadSyntax: return {"kBadSyntax", "the text does not follow the syntax"};
    case Status::kDuplicate: return {"kDuplicate", "a name is given twice"};
    case Status::kUnknownType: return {"kUnknownType", "unknown block type"};
    case Status::kTooLarge: return {"kTooLarge", "more than fits the fixed memory"};
    case Status::kNotOffered: return {"kNotOffered", "the robot does not offer it"};
    case Status::kUnstableGain: return {"kUnstableGain", "a gain makes the control law unstable"};
    case Status::kOverBudget: return {"kOverBudget", "the budgets of a cycle exceed its period"};
    case Status::kReferenceSize: return {"kReferenceSize", "number of waypoints not allowed"};
    case Status::kReferenceNotFinite: return {"kReferenceNotFinite", "reference not finite"};
    case Status::kPositionLimit: return {"kPositionLimit", "position beyond its limit"};
    case Status::kReferenceTime: return {"kReferenceTime", "time too early"};
    case Status::kVelocityLimit: return {"kVelocityLimit", "velocity beyond its limit"};
    case Status::kAccelerationLimit: return {"kAccelerationLimit", "acceleration beyond its limit"};
    case Status::kEffortLimit: return {"kEffortLimit", "effort beyond its limit"};
    case Status::kNotAtRest: return {"kNotAtRest", "not at rest"};
    case Status::kStartTolerance:
      return {"kStartTolerance", "first waypoint too far from the reference"};
    case Status::kNothingToCancel: return {"kNothingToCancel", "no reference to cancel"};
    case Status::kNoFreeStore: return {"kNoFreeStore", "no free store for the trajectory"};
    case Status::kMailboxFull: return {"kMailboxFull", "mailbox full"};
    case Status::kJerkLimit: return {"kJerkLimit", "jerk beyond its limit"};
    case Status::kVelocityStep: return {"kVelocityStep", "velocity step beyond its limit"};
    case Status::kQuaternion: return {"kQuaternion", "quaternion not of unit length"};
    case Status::kWorkspace: return {"kWorkspace", "position outside the workspace"};
    case Status::kPathTolerance: return {"kPathTolerance", "path tolerance exceeded"};
    case Status::kGoalTolerance: return {"kGoalTolerance", "goal tolerance exceeded"};
    case Status::kBadOverride: return {"kBadOverride", "override not from 0 to 1"};
    case Status::kNothingToExtend: return {"kNothingToExtend", "no open trajectory to extend"};
    case Status::kWindowFull: return {"kWindowFull", "all waypoints of the store are still needed"};
    case Status::kNotStreamable: return {"kNotStreamable", "an open trajectory cannot be monotone"};
    case Status::kGoalVelocity: return {"kGoalVelocity", "not at rest at the goal"};
    case Status::kChunkLate: return {"kChunkLate", "no target of the chunk is still ahead"};
    case Status::kEpochVoid: return {"kEpochVoid", "a stop has voided the epoch"};
    case Status::kPaused: return {"kPaused", "a pause holds the arm"};
    case Status::kPointStep: return {"kPointStep", "point too far from the reference"};
    case Status::kSaturated: return {"kSaturated", "held at the range's end"};
    case Status::kCannotLeave:
      return {"kCannotLeave", "a stop from the path that is followed would leave position limits"};
    case Status::kLeftPath: return {"kLeftPath", "the arm left its path while braking"};
    case Status::kStateNotFinite: return {"kStateNotFinite", "measured state not finite"};
    case Status::kReferenceFault: return {"kReferenceFault", "reference in the cycle not valid"};
    case Status::kCommandNotFinite: return {"kCommandNotFinite", "command not finite"};
    case Status::kMeasuredPositionLimit:
      return {"kMeasuredPositionLimit", "measured position beyond its limit"};
    case Status::kMeasuredVelocityLimit:
      return {"kMeasuredVelocityLimit", "measured velocity beyond its limit"};
    case Status::kSlip: return {"kSlip", "too many periods missed in a row"};
    case Status::kClock: return {"kClock", "the clock stopped, ran backwards or too fast"};
    case Status::kNotStarted: return {"kNotStarted", "not started"};
    case Status::kSensorNotFinite: return {"kSensorNotFinite", "sensor value not finite"};
    case Status::kSensorRange: return {"kSensorRange", "sensor value out of range"};
    case Status::kSensorStuck: return {"kSensorStuck", "sensor value does not change"};
    case Status::kSensorNotSteady: return {"kSensorNotSteady", "sensor value not steady"};
    case Status::kFollowingError: return {"kFollowingError", "following error beyond its limit"};
    case Status::kCollision: return {"kCollision", "collision"};
    case Status::kOverrun: return {"kOverrun", "too many cycles longer than the period"};
    case Status::kStopTime: return {"kStopTime", "not at rest in time"};
    case Status::kHalted: return {"kHalted", "halted on request"};
    case Status::kLimiting: return {"kLimiting", "the guard limited too many commands"};
    case Status::kArming: return {"kArming", "drives are being armed"};
    case Status::kArmingTime: return {"kArmingTime", "drives not armed in time"};
    case Status::kStateStale: return {"kStateStale", "measured state too old"};
    case Status::kStateInvalid: return {"kStateInvalid", "a joint is not measured"};
    case Status::kMoved: return {"kMoved", "the arm moved while it was to be held"};
    case Status::kBusTimeout: return {"kBusTimeout", "no data from the robot in time"};
    case Status::kDriveFault: return {"kDriveFault", "drive or safety fault"};
    case Status::kConnectionLost: return {"kConnectionLost", "connection to the robot lost"};
    case Status::kRobotMode: return {"kRobotMode", "robot mode does not allow motion"};
    case Status::kProtectiveStop: return {"kProtectiveStop", "protective stop"};
    case Status::kEmergencyStop: return {"kEmergencyStop", "emergency stop"};
    case Status::kSafeguardStop: return {"kSafeguardStop", "safeguard stop"};
    case Status::kProgramStopped: return {"kProgramStopped", "the robot's program stopped"};
    case Status::kRegistersInUse:
      return {"kRegistersInUse", "registers of the robot in use by another client"};
    case Status::kWireFormat: return {"kWireFormat", "message from the robot malformed"};
    case Status::kRefusedByRobot: return {"kRefusedByRobot", "request refused by the robot"};
    case Status::kNotReferenced: return {"kNotReferenced", "a joint is not referenced"};
    case Status::kBusConflict:
      return {"kBusConflict", "somebody else on the bus uses our identifiers"};
    case Status::kMismatch: return {"kMismatch", "two machines have computed different values"};
    case Status::kNotOwner: return {"kNotOwner", "another client or none owns the motion"};
    case Status::kStampRange: return {"kStampRange", "stamp too far from the present time"};
    case Status::kTooManyMessages: return {"kTooManyMessages", "too many messages"};
    case Status::kClientSilent: return {"kClientSilent", "no message from the client in time"};
    case Status::kClientSlow: return {"kClientSlow", "the client does not read what it is sent"};
    case Status::kTareLimit: return {"kTareLimit", "the sensor's zero would move too far"};
  }
  return {"unknown", "unknown status"};
}

}  // namespace

const char* name(Status status) {
  return words_of(status).name;
}

const char* meaning(Status status) {
  return words_of(status).meaning;
}

}  // namespace tactus
