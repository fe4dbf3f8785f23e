// The messages between an uploaded program and the control computer, for three programs in common
// use: all are 32-bit integers, most of them a value times a million. Universal Robots Client
// Library (external control), ur_modern_driver (driver program), ur_rtde (registers).
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::ur {

inline constexpr double kFixedPoint = 1e6;

// ---- external control -------------------------------------------------------------------------

inline constexpr std::size_t kReverseInts = 8;         ///< timeout in ms, six values, mode
inline constexpr std::size_t kTrajectoryInts = 21;     ///< of one point
inline constexpr std::size_t kScriptCommandInts = 28;  ///< command and parameters

enum class ControlMode : std::int32_t {
  kStopped = -2,
  kUninitialised = -1,
  kIdle = 0,
  kServoJ = 1,
  kSpeedJ = 2,
  kForward = 3,
  kSpeedL = 4,
  kPose = 5,
  kFreedrive = 6,
  kToolInContact = 7,
  kTorque = 8,  ///< from software 5.23
};

/// First value of a message in mode kForward.
enum ForwardCommand : std::int32_t {
  kForwardCancel = -1,
  kForwardNothing = 0,
  kForwardStart = 1,
  kForwardStreamStart = 2,
  kForwardStreamEnd = 3,
};

enum TrajectoryResult : std::int32_t { kSucceeded = 0, kCancelled = 1, kFailed = 2 };

enum PointType : std::int32_t {
  kPointMoveJ = 0,
  kPointMoveL = 1,
  kPointMoveP = 2,
  kPointMoveC = 3,
  kPointOptimoveJ = 4,  ///< the optimoves: from software 5.21
  kPointOptimoveL = 5,
  kPointMoveJPose = 6,
  kPointMoveLJoints = 7,
  kPointMovePJoints = 8,
  kPointMoveCJoints = 9,
  kPointMoveCJointsPose = 10,  ///< named after the types of end and via point, in this order
  kPointMoveCPoseJoints = 11,
  kPointOptimoveJPose = 12,
  kPointOptimoveLJoints = 13,
  kPointSpline = 51,
};
enum SplineType : std::int32_t { kCubic = 1, kQuintic = 2 };

enum class ScriptCommand : std::int32_t {
  kZeroFtSensor = 0,
  kSetPayload = 1,
  kSetToolVoltage = 2,
  kStartForceMode = 3,
  kEndForceMode = 4,
  kStartToolContact = 5,
  kEndToolContact = 6,
  kFtRtdeInputEnable = 8,
  kSetGravity = 9,
  kSetTcpOffset = 10,
  kSetTargetPayload = 12,
};

// ---- register program -------------------------------------------------------------------------

enum class RegisterCommand : std::int32_t {
  kNone = 0,
  kMoveJ = 1,
  kMoveJPose = 2,
  kMoveL = 3,
  kMoveLJoints = 4,
  kForceMode = 6,
  kForceModeStop = 7,
  kZeroFtSensor = 8,
  kSpeedJ = 9,
  kSpeedL = 10,
  kServoJ = 11,
  kServoC = 12,
  kSpeedStop = 15,
  kServoStop = 16,
  kSetPayload = 17,
  kTeachMode = 18,
  kEndTeachMode = 19,
  kServoL = 24,
  kToolContact = 25,
  kStepTime = 26,
  kPositionHistory = 27,
  kSetTcp = 29,
  kInverseNear = 30,
  kProtectiveStop = 31,
  kStopL = 33,
  kStopJ = 34,
  kWatchdog = 35,
  kPoseWithinLimits = 36,
  kJointsWithinLimits = 37,
  kJointTorques = 38,
  kPoseTrans = 39,
  kTcpOffset = 40,
  kJogStart = 41,
  kJogStop = 42,
  kForward = 43,
  kForwardOf = 44,
  kMovePath = 45,
  kInverse = 46,
  kSteady = 47,
  kFlangePose = 58,
  kHasInverse = 60,
  kHasInverseNear = 61,
  kTorque = 66,
  kMassMatrix = 67,
  kCoriolis = 68,
  kTargetAccelerations = 69,
  kJacobian = 70,
  kJacobianRate = 71,
  kStop = 255,
};

/// Answers of the program in its first integer register.
enum Handshake : std::int32_t { kReady = 1, kDone = 2 };

}  // namespace tactus::ur
