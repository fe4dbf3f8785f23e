// Frames with which a board identifies itself: its greeting, and the record of its last fatal
// fault.
#pragma once

#include "hal/net/protocol_bytes.hpp"
#include "hal/serial/protocol.hpp"
#include "kernel/core/text.hpp"

namespace tactus::serial {

enum class FaultCause : std::uint8_t {
  kNone,
  kFault,       ///< of the core: the registers say which
  kStack,       ///< a stack is full
  kWatchdog,    ///< a cycle did not end
  kBackground,  ///< a piece of background work did not end
  kAbort,       ///< the program gave up
};

/// The cause in words: "a full stack". Null: there is no such cause. [any]
constexpr const char* name(FaultCause cause) {
  switch (cause) {
    case FaultCause::kNone: return "none";
    case FaultCause::kFault: return "a fault of the core";
    case FaultCause::kStack: return "a full stack";
    case FaultCause::kWatchdog: return "a cycle that did not end, by the watchdog";
    case FaultCause::kBackground: return "background work that did not end";
    case FaultCause::kAbort: return "the program gave up";
  }
  return nullptr;
}

struct FaultRecord {
  FaultCause cause = FaultCause::kNone;
  std::uint32_t count = 0;  ///< of faults since the board was switched on
  std::uint32_t cycle = 0;  ///< number of the cycle in which it happened
  std::uint32_t pc = 0, lr = 0, sp = 0;
  /// Status of the fault. [Arm, DDI 0403E, B3.2.15, B3.2.16]
  std::uint32_t cfsr = 0, hfsr = 0;
  std::uint32_t address = 0;  ///< faulting address, if valid by CFSR
};

struct Greeting {
  std::uint8_t version = kVersion;  ///< of the protocol
  std::uint8_t joints = 0;
  Text<31> robot;
  std::uint64_t text = 0;                ///< FNV-1a hash of the text of its pipeline
  FaultCause fault = FaultCause::kNone;  ///< of the record that it keeps
};

/// Append a record, a greeting. [any]
void write(ByteWriter& to, const FaultRecord& record);
void write(ByteWriter& to, const Greeting& greeting);
/// Read one; false: it is malformed. [any]
bool read(ByteReader& from, FaultRecord& record);
bool read(ByteReader& from, Greeting& greeting);

}  // namespace tactus::serial
