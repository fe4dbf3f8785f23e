// What ended the program the last time, kept in memory that a reset does not touch.
#pragma once

#include "hal/serial/board_frames.hpp"

namespace bare {

using tactus::serial::FaultCause;
using tactus::serial::FaultRecord;

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

}  // namespace bare
