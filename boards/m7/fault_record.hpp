// FaultRecord: what ended the program the last time, kept in memory that a reset does not touch.
#pragma once

#include <cstdint>

namespace m7 {

enum class FaultCause : std::uint8_t {
  kNone,
  kFault,       ///< of the core: the registers say which
  kStack,       ///< a stack is full
  kWatchdog,    ///< a cycle did not end
  kBackground,  ///< a piece of background work did not end
  kAbort,       ///< the program gave up
};

struct FaultRecord {
  FaultCause cause = FaultCause::kNone;
  std::uint32_t count = 0;  ///< of faults since the board was switched on
  std::uint32_t cycle = 0;  ///< number of the cycle in which it happened
  std::uint32_t pc = 0, lr = 0, sp = 0;
  std::uint32_t cfsr = 0, hfsr = 0;  ///< status of the fault [DDI 0403E, B3.2.15, B3.2.16]
  std::uint32_t address = 0;         ///< that it concerns, if CFSR says that one is known
};

/// The record that the last run left; kNone: none, or it was forgotten. [any]
const FaultRecord& fault_record();
/// [any]
void forget_fault();
/// Keeps a record, tells the plant that its drives are to be disabled, and starts the board again.
/// [any, also out of a fault]
[[noreturn]] void end_with(const FaultRecord& record);

/// What the board's program does last, with nothing but its own stack: disables the drives.
void last_words();
/// The number of the present cycle. [any]
std::uint32_t cycle_number();

}  // namespace m7
