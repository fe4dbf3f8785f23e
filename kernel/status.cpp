#include "kernel/status.hpp"

namespace tactus {
namespace {

struct StatusName {
  Status status;
  const char* name;
};

constexpr StatusName kStatusNames[] = {
    {Status::kOk, "kOk"},
    {Status::kMissingKey, "kMissingKey"},
    {Status::kUnknownKey, "kUnknownKey"},
    {Status::kBadValue, "kBadValue"},
    {Status::kUnknownPort, "kUnknownPort"},
    {Status::kWrongQuantity, "kWrongQuantity"},
    {Status::kNotConnected, "kNotConnected"},
    {Status::kBadSyntax, "kBadSyntax"},
    {Status::kDuplicate, "kDuplicate"},
    {Status::kUnknownType, "kUnknownType"},
    {Status::kTooLarge, "kTooLarge"},
    {Status::kNotOffered, "kNotOffered"},
    {Status::kUnstableGain, "kUnstableGain"},
    {Status::kOverBudget, "kOverBudget"},
    {Status::kReferenceSize, "kReferenceSize"},
    {Status::kReferenceNotFinite, "kReferenceNotFinite"},
    {Status::kPositionLimit, "kPositionLimit"},
    {Status::kReferenceTime, "kReferenceTime"},
    {Status::kVelocityLimit, "kVelocityLimit"},
    {Status::kAccelerationLimit, "kAccelerationLimit"},
    {Status::kEffortLimit, "kEffortLimit"},
    {Status::kNotAtRest, "kNotAtRest"},
    {Status::kStartTolerance, "kStartTolerance"},
    {Status::kNothingToCancel, "kNothingToCancel"},
    {Status::kNoFreeStore, "kNoFreeStore"},
    {Status::kMailboxFull, "kMailboxFull"},
    {Status::kJerkLimit, "kJerkLimit"},
    {Status::kVelocityStep, "kVelocityStep"},
    {Status::kQuaternion, "kQuaternion"},
    {Status::kWorkspace, "kWorkspace"},
    {Status::kPathTolerance, "kPathTolerance"},
    {Status::kGoalTolerance, "kGoalTolerance"},
    {Status::kBadOverride, "kBadOverride"},
    {Status::kNothingToExtend, "kNothingToExtend"},
    {Status::kWindowFull, "kWindowFull"},
    {Status::kNotStreamable, "kNotStreamable"},
    {Status::kLeftPath, "kLeftPath"},
    {Status::kStateNotFinite, "kStateNotFinite"},
    {Status::kReferenceFault, "kReferenceFault"},
    {Status::kCommandNotFinite, "kCommandNotFinite"},
    {Status::kMeasuredPositionLimit, "kMeasuredPositionLimit"},
    {Status::kMeasuredVelocityLimit, "kMeasuredVelocityLimit"},
    {Status::kSlip, "kSlip"},
    {Status::kClock, "kClock"},
    {Status::kNotStarted, "kNotStarted"},
    {Status::kSensorNotFinite, "kSensorNotFinite"},
    {Status::kSensorRange, "kSensorRange"},
    {Status::kSensorStuck, "kSensorStuck"},
    {Status::kSensorNotSteady, "kSensorNotSteady"},
    {Status::kFollowingError, "kFollowingError"},
    {Status::kCollision, "kCollision"},
    {Status::kOverrun, "kOverrun"},
    {Status::kStopTime, "kStopTime"},
    {Status::kHalted, "kHalted"},
    {Status::kLimiting, "kLimiting"},
    {Status::kBusTimeout, "kBusTimeout"},
    {Status::kDriveFault, "kDriveFault"},
    {Status::kConnectionLost, "kConnectionLost"},
    {Status::kRobotMode, "kRobotMode"},
    {Status::kProtectiveStop, "kProtectiveStop"},
    {Status::kEmergencyStop, "kEmergencyStop"},
    {Status::kSafeguardStop, "kSafeguardStop"},
    {Status::kProgramStopped, "kProgramStopped"},
    {Status::kRegistersInUse, "kRegistersInUse"},
    {Status::kWireFormat, "kWireFormat"},
    {Status::kRefusedByRobot, "kRefusedByRobot"},
};

}  // namespace

const char* name(Status status) {
  for (const StatusName& entry : kStatusNames) {
    if (entry.status == status) return entry.name;
  }
  return "unknown";
}

}  // namespace tactus
