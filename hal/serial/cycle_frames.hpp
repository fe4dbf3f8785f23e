// The payloads of the frames of the cycle: the robot's state to the board, the command from it.
#pragma once

#include "hal/net/protocol_bytes.hpp"
#include "hal/serial/protocol.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::serial {

/// A command, and how the cycle went that gave it.
struct CycleResult {
  std::uint32_t cycle = 0;    ///< number of the cycle since the start
  std::int64_t stamp_ns = 0;  ///< when it began
  RobotCommand command;
  Status status = Status::kNotStarted;  ///< of the cycle
  std::uint8_t rung = 0xFF;             ///< of the degrade ladder; 0xFF: there was no cycle
  std::uint8_t reports = 0;             ///< that wait for a message that takes them
  std::uint64_t row = 0;                ///< hash of the row of recorded outputs, 0: none
};

/// Appends a state. [any]
void write_state(ByteWriter& to, Order order, const RobotState& state);
/// Reads one; false, and nothing is changed: it is no state of this robot. Not-a-number passes: the
/// guard judges values. [cyclic]
bool read_state(ByteReader& from, Order& order, RobotState& state);

/// [cyclic]
void write_result(ByteWriter& to, const CycleResult& result);
/// False, and nothing is changed: it is no result of this robot. [any]
bool read_result(ByteReader& from, CycleResult& result);

}  // namespace tactus::serial
