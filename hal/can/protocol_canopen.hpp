// CANopen on the wire (CiA 301): identifiers, network management, heartbeat, EMCY, SYNC, and the
// communication objects 1000h to 1FFFh that a master writes. SDO: protocol_sdo.hpp.
#pragma once

#include <cstdint>

#include "hal/can/protocol_frame.hpp"

namespace tactus::can {

inline constexpr int kMaxNode = 127;

// The predefined connection set (CiA 301, 7.3.3): the identifier is base + node.
inline constexpr std::uint16_t kNmtId = 0x000;
inline constexpr std::uint16_t kSyncId = 0x080;
inline constexpr std::uint16_t kEmcyBase = 0x080;
inline constexpr std::uint16_t kTpdoBase[4] = {0x180, 0x280, 0x380, 0x480};  ///< drive -> master
inline constexpr std::uint16_t kRpdoBase[4] = {0x200, 0x300, 0x400, 0x500};  ///< master -> drive
inline constexpr std::uint16_t kSdoAnswerBase = 0x580;                       ///< drive -> master
inline constexpr std::uint16_t kSdoRequestBase = 0x600;                      ///< master -> drive
inline constexpr std::uint16_t kHeartbeatBase = 0x700;

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// State of a node in its heartbeat.
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F,
};

constexpr const char* name(NmtState state) {
  switch (state) {
    case NmtState::kBootUp: return "boot-up";
    case NmtState::kStopped: return "stopped";
    case NmtState::kOperational: return "operational";
    case NmtState::kPreOperational: return "pre-operational";
  }
  return nullptr;
}

/// Returns the command to a node; `node` 0: to all of them. [any]
constexpr CanFrame nmt_frame(NmtCommand command, std::uint8_t node) {
  CanFrame frame;
  frame.id = kNmtId;
  frame.size = 2;
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = node;
  return frame;
}
constexpr CanFrame sync_frame() {
  CanFrame frame;
  frame.id = kSyncId;
  return frame;
}
constexpr CanFrame heartbeat_frame(std::uint8_t node, NmtState state) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(kHeartbeatBase + node);
  frame.size = 1;
  frame.data[0] = static_cast<std::uint8_t>(state);
  return frame;
}

/// An EMCY message (CiA 301, 7.2.7); code 0: the errors have gone.
struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;  ///< 1001h
};
inline constexpr std::uint8_t kEmergencySize = 8;

// Communication objects. A PDO's are at base + number - 1.
inline constexpr std::uint16_t kDeviceType = 0x1000;         // u32
inline constexpr std::uint16_t kErrorRegister = 0x1001;      // u8
inline constexpr std::uint16_t kErrorHistory = 0x1003;       // array of u32
inline constexpr std::uint16_t kSyncIdObject = 0x1005;       // u32
inline constexpr std::uint16_t kSyncPeriod = 0x1006;         // u32, us
inline constexpr std::uint16_t kSyncWindow = 0x1007;         // u32, us
inline constexpr std::uint16_t kDeviceName = 0x1008;         // text
inline constexpr std::uint16_t kHardwareVersion = 0x1009;    // text
inline constexpr std::uint16_t kSoftwareVersion = 0x100A;    // text
inline constexpr std::uint16_t kEmcyIdObject = 0x1014;       // u32
inline constexpr std::uint16_t kHeartbeatConsumer = 0x1016;  // :1.. u32: node << 16 | time in ms
inline constexpr std::uint16_t kHeartbeatProducer = 0x1017;  // u16, ms
inline constexpr std::uint16_t kIdentity = 0x1018;     // :1 vendor, 2 product, 3 revision, 4 serial
inline constexpr std::uint16_t kSyncCounter = 0x1019;  // u8
inline constexpr std::uint16_t kErrorBehaviour = 0x1029;  // :1 u8
inline constexpr std::uint16_t kRpdoCommunication = 0x1400, kRpdoMapping = 0x1600;
inline constexpr std::uint16_t kTpdoCommunication = 0x1800, kTpdoMapping = 0x1A00;

// Sub-indices of the communication parameters of a PDO.
inline constexpr std::uint8_t kPdoId = 1;           // u32
inline constexpr std::uint8_t kPdoType = 2;         // u8
inline constexpr std::uint8_t kPdoInhibitTime = 3;  // u16, 0.1 ms
inline constexpr std::uint8_t kPdoEventTimer = 5;   // u16, ms; of an RPDO: its time-out

inline constexpr std::uint32_t kPdoInvalid = 0x80000000;   ///< bit of a PDO's identifier
inline constexpr std::uint32_t kPdoNoRemote = 0x40000000;  ///< the same: no RTR

// Transmission types.
inline constexpr std::uint8_t kEverySync = 1;
inline constexpr std::uint8_t kOnChange = 255;  ///< as defined by the device profile

/// Entries of an RPDO's mapping that skip bytes: the type's own number as the index (CiA 301,
/// 7.4.8.1).
inline constexpr std::uint32_t kSkip16 = 0x00060010, kSkip32 = 0x00070020;

}  // namespace tactus::can
