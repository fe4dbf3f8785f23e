// SDO on the wire (CiA 301, 7.2.4): command bytes of expedited and segmented transfers, and the
// abort codes with their texts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/core/status.hpp"

namespace tactus::can {

inline constexpr std::size_t kSdoSize = 8;         ///< bytes of every frame
inline constexpr std::size_t kSegmentBytes = 7;    ///< data bytes of a segment
inline constexpr std::size_t kExpeditedBytes = 4;  ///< data bytes of an expedited transfer

// The command specifier, bits 5 to 7 of the first byte: of a request ...
inline constexpr std::uint8_t kDownloadSegment = 0x00, kDownload = 0x20, kUpload = 0x40,
                              kUploadSegment = 0x60, kAbort = 0x80;
// ... and of an answer.
inline constexpr std::uint8_t kSegmentUploaded = 0x00, kSegmentDownloaded = 0x20, kUploaded = 0x40,
                              kDownloaded = 0x60;
inline constexpr std::uint8_t kSpecifier = 0xE0;
// First frame of a transfer: size given, expedited, unused bytes if expedited.
inline constexpr std::uint8_t kSizeGiven = 0x01, kExpedited = 0x02;
inline constexpr int kUnusedShift = 2;
// Segment: last, unused bytes, toggle.
inline constexpr std::uint8_t kLastSegment = 0x01, kToggleBit = 0x10;
inline constexpr int kSegmentUnusedShift = 1;

enum class SdoAbort : std::uint32_t {
  kNone = 0,
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kCommand = 0x05040001,
  kOutOfMemory = 0x05040005,
  kAccess = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kIncompatible = 0x06040043,
  kHardware = 0x06060000,
  kLength = 0x06070010,
  kTooLong = 0x06070012,
  kTooShort = 0x06070013,
  kNoSubIndex = 0x06090011,
  kRange = 0x06090030,
  kTooHigh = 0x06090031,
  kTooLow = 0x06090032,
  kGeneral = 0x08000000,
  kNotStored = 0x08000020,
  kLocalControl = 0x08000021,
  kDeviceState = 0x08000022,
  kNoData = 0x08000024,
};

/// Returns what an abort code means, never null. [any]
constexpr const char* meaning(SdoAbort abort) {
  switch (abort) {
    case SdoAbort::kNone: return "no abort";
    case SdoAbort::kToggle: return "toggle bit not alternated";
    case SdoAbort::kTimeout: return "time-out";
    case SdoAbort::kCommand: return "unknown command";
    case SdoAbort::kOutOfMemory: return "out of memory";
    case SdoAbort::kAccess: return "access not supported";
    case SdoAbort::kWriteOnly: return "the object is write-only";
    case SdoAbort::kReadOnly: return "the object is read-only";
    case SdoAbort::kNoObject: return "the object does not exist";
    case SdoAbort::kNotMappable: return "the object cannot be mapped to a PDO";
    case SdoAbort::kPdoLength: return "the mapped objects are longer than a PDO";
    case SdoAbort::kIncompatible: return "parameters are incompatible";
    case SdoAbort::kHardware: return "hardware error";
    case SdoAbort::kLength: return "wrong length";
    case SdoAbort::kTooLong: return "too long";
    case SdoAbort::kTooShort: return "too short";
    case SdoAbort::kNoSubIndex: return "the sub-index does not exist";
    case SdoAbort::kRange: return "value out of range";
    case SdoAbort::kTooHigh: return "value too high";
    case SdoAbort::kTooLow: return "value too low";
    case SdoAbort::kGeneral: return "general error";
    case SdoAbort::kNotStored: return "data cannot be stored";
    case SdoAbort::kLocalControl: return "data cannot be stored because of local control";
    case SdoAbort::kDeviceState: return "data cannot be stored in the present state of the device";
    case SdoAbort::kNoData: return "no data available";
  }
  return "unknown abort code";
}

/// Returns what an abort is for a robot: no answer, or a refusal. [any]
constexpr Status status_of(SdoAbort abort) {
  return abort == SdoAbort::kTimeout ? Status::kBusTimeout : Status::kRefusedByRobot;
}

}  // namespace tactus::can
