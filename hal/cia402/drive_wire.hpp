// Feedback and commands that a bus exchanges with the drives of an arm in every cycle, in the units
// of the drives. CAN and EtherCAT use the same.
#pragma once

#include <array>
#include <cstdint>

#include "hal/cia402/protocol.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::cia402 {

/// The newest process data of one drive.
struct DriveFeedback {
  bool fresh = false;         ///< arrived since the last cycle
  int made_up = 0;            ///< late samples of earlier cycles received with it
  bool has_velocity = false;  ///< 606Ch is mapped; otherwise the positions are differentiated
  std::uint16_t statusword = 0;
  std::int32_t position = 0, velocity = 0;  ///< increments; velocity in units of 60A9h
  std::int16_t torque = 0;                  ///< permille of the rated torque
  std::uint16_t error_code = 0;  ///< 603Fh, or of the last EMCY message; 0: none, or it has gone
  bool emergency = false;        ///< an EMCY message with an error arrived since the last cycle
  /// kOk, or why the drive cannot be used until the next connect(): restarted, silent ...
  Status lost = Status::kOk;

  /// 603Fh is of the last error, which may have gone. [any]
  bool shows_error() const { return (statusword & (kFaultBit | kWarning)) != 0; }
  /// Takes a statusword. The error code is cleared with the error, as not every drive reports its
  /// end. [any]
  void show(std::uint16_t word) {
    const bool showed = shows_error();
    statusword = word;
    if (showed && !emergency) forget_what_has_gone();
  }
  /// [any]
  void forget_what_has_gone() {
    if (!shows_error()) error_code = 0;
  }
};

/// Returns what `lost` means, and what helps. [any]
constexpr const char* lost_text(Status lost) {
  return lost == Status::kBusTimeout
             ? "its heartbeat is missing; check power and cabling, then connect again"
             : "it restarted, or left operation; connect again";
}

struct DriveCommand {
  std::uint16_t controlword = 0;
  bool homes = false;  ///< its mode of operation is homing, not that of the commands
  std::int16_t target_torque = 0, torque_offset = 0;      ///< permille of the rated torque
  std::int32_t target_position = 0;                       ///< increments
  std::int32_t target_velocity = 0, velocity_offset = 0;  ///< in units of 60A9h
};

/// Returns the drive's mode for commands of a pipeline. [any]
constexpr Mode mode_of(CommandMode mode) {
  switch (mode) {
    case CommandMode::kPosition: return Mode::kCyclicPosition;
    case CommandMode::kVelocity: return Mode::kCyclicVelocity;
    case CommandMode::kEffort: break;
  }
  return Mode::kCyclicTorque;
}

/// An object that a bus reads from a drive, or writes to it, by SDO while the process data
/// continues.
struct ObjectRequest {
  int number = 0;  ///< of this request; 0: there is none
  int joint = 0;   ///< from 0
  Object object{};
  bool writes = false;
  std::uint32_t value = 0;  ///< that is written
};

/// Why a request was not done.
struct ObjectRefusal {
  Status status = Status::kOk;  ///< kOk: it was; kBusTimeout, kRefusedByRobot
  const char* why = "";         ///< a constant text
};

using Feedbacks = std::array<DriveFeedback, kDof>;
using DriveCommands = std::array<DriveCommand, kDof>;

}  // namespace tactus::cia402
