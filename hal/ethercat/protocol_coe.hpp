// The mailbox of a slave and CoE, CANopen over EtherCAT (ETG.1000.6): headers and objects. The
// bodies of SDO are those of CiA 301. Both ends share them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

namespace tactus::ethercat {

// Mailbox header: length u16, address u16, channel and priority, type and counter.
inline constexpr std::size_t kMailboxBytes = 6;
inline constexpr std::uint8_t kMailboxError = 0, kMailboxCoe = 3;  ///< types
inline constexpr std::uint8_t kMailboxTypeBits = 0x0F, kMailboxCounterBits = 0x70;
inline constexpr int kMailboxCounterShift = 4;

// CoE header: u16, of which the upper four bits are the service.
inline constexpr std::size_t kCoeBytes = 2;
inline constexpr std::size_t kCoeBody = kMailboxBytes + kCoeBytes;
inline constexpr int kCoeServiceShift = 12;
inline constexpr std::uint16_t kCoeEmergency = 1, kCoeSdoRequest = 2, kCoeSdoAnswer = 3,
                               kCoeInformation = 8;  // the last one

// SDO information: fragments left u16 after opcode u8 and a reserved byte.
inline constexpr std::uint8_t kListRequest = 1, kListAnswer = 2, kDescriptionRequest = 3,
                              kDescriptionAnswer = 4, kEntryRequest = 5, kEntryAnswer = 6,
                              kInformationError = 7;

/// Bit 4 of an SDO command that begins a transfer: all sub-indices of the object.
inline constexpr std::uint8_t kCompleteAccess = 0x10;

// Objects of the communication profile.
inline constexpr std::uint16_t kSmTypes = 0x1C00, kRxAssign = 0x1C12, kTxAssign = 0x1C13;
inline constexpr std::uint16_t kRxMapping = 0x1600, kTxMapping = 0x1A00;

// An error reply of the mailbox itself: type u16, code u16 (ETG.1000.4).
inline constexpr std::size_t kMailboxErrorBytes = 4;
inline constexpr std::uint16_t kMailboxUnsupported = 0x0002, kMailboxNoService = 0x0004,
                               kMailboxBadHeader = 0x0005, kMailboxTooShort = 0x0006,
                               kMailboxWrongSize = 0x0008;

/// Returns what the code of an error reply means, never null. [any]
constexpr const char* mailbox_error_text(std::uint16_t code) {
  constexpr const char* kTexts[] = {"no error",
                                    "wrong syntax of the header",
                                    "unsupported protocol",
                                    "wrong channel",
                                    "unsupported service",
                                    "invalid header",
                                    "too short",
                                    "no memory",
                                    "inconsistent length"};
  return code < std::size(kTexts) ? kTexts[code] : "a code that the standard does not have";
}

}  // namespace tactus::ethercat
