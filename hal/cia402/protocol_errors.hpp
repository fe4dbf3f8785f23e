// The error codes of a drive, 603Fh and the first two bytes of an EMCY message (CiA 301, table of
// emergency error codes; CiA 402, error codes). A code without a row of its own is explained by its
// class, the upper digits.
#pragma once

#include <cstdint>

namespace tactus::cia402 {

struct ErrorText {
  std::uint16_t code, mask;
  const char* text;
};

/// The first row whose masked code is equal explains a code: single codes before their classes.
inline constexpr ErrorText kErrorTexts[] = {
    {0x0000, 0xFFFF, "no error"},
    {0x2310, 0xFFFF, "continuous over-current"},
    {0x2320, 0xFFFF, "short circuit"},
    {0x3210, 0xFFFF, "DC link over-voltage"},
    {0x3220, 0xFFFF, "DC link under-voltage"},
    {0x4210, 0xFFFF, "excess temperature of the device"},
    {0x4310, 0xFFFF, "excess temperature of the drive"},
    {0x5112, 0xFFFF, "low supply voltage"},
    {0x6320, 0xFFFF, "a parameter is wrong"},
    {0x7121, 0xFFFF, "motor blocked"},
    {0x7305, 0xFFFF, "encoder 1"},
    {0x8110, 0xFFFF, "CAN overrun, a message was lost"},
    {0x8120, 0xFFFF, "CAN error passive"},
    {0x8130, 0xFFFF, "the master's heartbeat is missing"},
    {0x8140, 0xFFFF, "recovered from bus-off"},
    {0x8210, 0xFFFF, "a PDO is too short"},
    {0x8220, 0xFFFF, "a PDO is too long"},
    {0x8250, 0xFFFF, "the command PDO is missing"},
    {0x8400, 0xFFFF, "speed control"},
    {0x8611, 0xFFFF, "following error"},
    {0x8700, 0xFFFF, "SYNC is missing or unsteady"},
    {0x1000, 0xFF00, "generic error"},
    {0x2000, 0xF000, "current"},
    {0x3000, 0xF000, "voltage"},
    {0x4000, 0xF000, "temperature"},
    {0x5000, 0xF000, "hardware of the device"},
    {0x6000, 0xF000, "software of the device"},
    {0x7000, 0xF000, "additional modules"},
    {0x8100, 0xFF00, "communication"},
    {0x8200, 0xFF00, "protocol"},
    {0x8000, 0xF000, "monitoring"},
    {0x9000, 0xFF00, "external error"},
    {0xF000, 0xFF00, "additional functions"},
    {0xFF00, 0xFF00, "the manufacturer's own"},
};

/// Returns what an error code means, never null. [any]
constexpr const char* error_text(std::uint16_t code) {
  for (const ErrorText& row : kErrorTexts)
    if ((code & row.mask) == row.code) return row.text;
  return "unknown";
}

}  // namespace tactus::cia402
