// The transitions of a drive that a controlword causes (CiA 402, state machine), as a table. Those
// that the drive makes by itself are in axis.cpp.
#pragma once

#include <cstdint>

#include "hal/cia402/protocol.hpp"

namespace tactus::drives {

enum class Command : std::uint8_t {
  kNone,
  kDisableVoltage,
  kQuickStop,
  kShutdown,
  kSwitchOn,  ///< also: disable operation
  kEnableOperation,
};

/// Returns the command in a controlword; a word with bit 7 is a fault reset and none of these.
/// [any]
constexpr Command command_of(std::uint16_t controlword) {
  if ((controlword & 0x0082) == 0x0000) return Command::kDisableVoltage;
  if ((controlword & 0x0086) == 0x0002) return Command::kQuickStop;
  if ((controlword & 0x0087) == 0x0006) return Command::kShutdown;
  if ((controlword & 0x008F) == 0x0007) return Command::kSwitchOn;
  if ((controlword & 0x008F) == 0x000F) return Command::kEnableOperation;
  return Command::kNone;
}

struct Transition {
  cia402::State from;
  Command command;
  cia402::State to;
  int number;  ///< in the standard
};

/// From "ready to switch on", "enable operation" also switches on, and transition 4 follows.
inline constexpr Transition kTransitions[] = {
    {cia402::State::kSwitchOnDisabled, Command::kShutdown, cia402::State::kReadyToSwitchOn, 2},
    {cia402::State::kReadyToSwitchOn, Command::kSwitchOn, cia402::State::kSwitchedOn, 3},
    {cia402::State::kReadyToSwitchOn, Command::kEnableOperation, cia402::State::kSwitchedOn, 3},
    {cia402::State::kSwitchedOn, Command::kEnableOperation, cia402::State::kOperationEnabled, 4},
    {cia402::State::kOperationEnabled, Command::kSwitchOn, cia402::State::kSwitchedOn, 5},
    {cia402::State::kSwitchedOn, Command::kShutdown, cia402::State::kReadyToSwitchOn, 6},
    {cia402::State::kReadyToSwitchOn, Command::kQuickStop, cia402::State::kSwitchOnDisabled, 7},
    {cia402::State::kReadyToSwitchOn, Command::kDisableVoltage, cia402::State::kSwitchOnDisabled,
     7},
    {cia402::State::kOperationEnabled, Command::kShutdown, cia402::State::kReadyToSwitchOn, 8},
    {cia402::State::kOperationEnabled, Command::kDisableVoltage, cia402::State::kSwitchOnDisabled,
     9},
    {cia402::State::kSwitchedOn, Command::kDisableVoltage, cia402::State::kSwitchOnDisabled, 10},
    {cia402::State::kSwitchedOn, Command::kQuickStop, cia402::State::kSwitchOnDisabled, 10},
    {cia402::State::kOperationEnabled, Command::kQuickStop, cia402::State::kQuickStopActive, 11},
    {cia402::State::kQuickStopActive, Command::kDisableVoltage, cia402::State::kSwitchOnDisabled,
     12},
    {cia402::State::kQuickStopActive, Command::kEnableOperation, cia402::State::kOperationEnabled,
     16},
};

/// Returns the transition, or null if the command is not valid in the state. [any]
constexpr const Transition* find_transition(cia402::State state, Command command) {
  for (const Transition& row : kTransitions)
    if (row.from == state && row.command == command) return &row;
  return nullptr;
}

}  // namespace tactus::drives
