// What ended the program the last time, kept in memory that a reset does not touch.
#pragma once

#include "hal/serial/board_frames.hpp"

namespace bare {

using tactus::serial::FaultCause;
using tactus::serial::FaultRecord;

/// The record of the last run; kNone: none, or it was cleared. [any]
const FaultRecord& fault_record();
/// [any]
void forget_fault();
/// Keeps a record, sends the request to disable the drives, and restarts the board.
/// [any, also out of a fault]
[[noreturn]] void end_with(const FaultRecord& record);

/// Sends the request to disable the drives, the last action of the program. Needs only its own
/// stack.
void send_disable();
/// The number of the present cycle. [any]
std::uint32_t cycle_number();

}  // namespace bare
