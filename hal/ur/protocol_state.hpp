// The binary state ports: primary 30001, secondary 30002, real-time 30003. Universal Robots,
// "Remote Control Via TCP/IP" and its table of the client interfaces, software 3.x.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::ur {

/// Version of the controller's software: 3.15.8.106339.
struct Version {
  std::uint32_t major = 3, minor = 15, bugfix = 8, build = 106339;

  constexpr bool at_least(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0) const {
    if (major != a) return major > a;
    if (minor != b) return minor > b;
    return bugfix >= c;
  }
  /// Cycle of the controller; versions from 5 up are of the e-Series.
  constexpr double cycle_s() const { return major < 5 ? 0.008 : 0.002; }
};

inline constexpr double kCycle_s = Version{}.cycle_s();  ///< of a CB3

enum Port : std::uint16_t {
  kDashboardPort = 29999,
  kPrimaryPort = 30001,
  kSecondaryPort = 30002,
  kRealtimePort = 30003,
  kRtdePort = 30004,
};

/// Bytes of a packet on the real-time port: each version appends to the one before. The packets of
/// 3.14 and 3.15 are not published; a reader takes the prefix that it supports.
constexpr std::size_t realtime_size(const Version& version) {
  if (version.at_least(5, 10)) return 1220;
  if (version.at_least(5, 9)) return 1140;
  if (version.at_least(3, 10)) return 1116;
  if (version.at_least(3, 5)) return 1108;
  if (version.at_least(3, 2)) return 1060;
  return 1044;
}

/// Offsets of doubles in a packet of the real-time port.
enum RealtimeOffset : std::size_t {
  kTimeOffset = 4,
  kQTargetOffset = 12,
  kQdTargetOffset = 60,
  kQActualOffset = 252,
  kQdActualOffset = 300,
  kTcpPoseOffset = 444,
  kTcpForceOffset = 540,
  kRobotModeOffset = 756,
  kJointModesOffset = 764,
  kSafetyModeOffset = 812,
  kSpeedScalingOffset = 940,
  kDigitalOutputsOffset = 1044,
  kProgramStateOffset = 1052,
  kSafetyStatusOffset = 1108,
};

/// Types of packets on the primary and secondary port.
enum class StateType : std::int8_t { kRobotState = 16, kRobotMessage = 20 };

/// Parts of a robot state; each begins with a u32 length and a u8 type.
enum class StatePart : std::uint8_t {
  kRobotMode = 0,
  kJoints = 1,
  kTool = 2,
  kMasterboard = 3,
  kCartesian = 4,
  kKinematics = 5,
  kConfiguration = 6,
  kForceMode = 7,
  kAdditional = 8,
  kCalibration = 9,
};

enum class MessageType : std::uint8_t {
  kText = 0,
  kProgramLabel = 1,
  kPopup = 2,
  kVersion = 3,
  kSafetyMode = 5,
  kErrorCode = 6,
  kKey = 7,
  kRuntimeException = 10,
};

/// Source of a robot message.
enum class MessageSource : std::int8_t { kRobotInterface = -2, kRuntimeMachine = -3 };

enum class ReportLevel : std::int32_t {
  kDebug = 0,
  kInfo = 1,
  kWarning = 2,
  kViolation = 3,
  kFault = 4,
  kCritical = 5,
};

inline constexpr std::int32_t kRobotTypeUr10 = 2;

/// Of a kinematics part: what its parameters are.
enum CalibrationStatus : std::uint32_t { kNotCalibrated = 0, kNotLinearised = 1, kLinearised = 2 };

}  // namespace tactus::ur
