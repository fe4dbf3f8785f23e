// The faults that the master must survive while drives are armed or follow: how each begins, and
// what the master is expected to make of it.
#pragma once

#include "tests/drives/fault_bench.hpp"

namespace tactus::can {

enum class When : std::uint8_t { kSwitchingOn, kReleasing, kFollowing };
inline constexpr const char* kWhenNames[] = {"switching on", "brakes opening", "following"};

struct FaultRow {
  const char* fault;
  void (*begin)(MasterBench& bench, int joint);
  Status status;            ///< that the executive latches
  std::array<int, 3> most;  ///< by When: cycles until the stop is sent; 0: nothing happens
  int off;                  ///< most cycles from there until no drive has power
  Status arms;              ///< of the next arm(); if it refuses, only start() leads back
};

using drives::FaultKind;

inline int tpdo(int j) {
  return 0x181 + j;
}

template <FaultKind kind, std::uint32_t value = 0>
void drive_fault(MasterBench& bench, int joint) {
  inject(bench, joint, kind, value);
}
template <Wire wire, bool to_drive, int count>
void wire_fault(MasterBench& bench, int joint) {
  disturb(bench, wire, to_drive, to_drive ? command_id(bench, joint) : tpdo(joint), count);
}

inline constexpr std::array<int, 3> kNever = {0, 0, 0};
inline constexpr int kForGood = 1000;  // cycles
constexpr Wire kLoses = Wire::kLoses, kDoubles = Wire::kDoubles, kDelays = Wire::kDelays,
               kCuts = Wire::kCuts;
constexpr Status kTimeout = Status::kBusTimeout, kFault = Status::kDriveFault;

// The cycles: 4 without feedback are one more than max_missed; a command times out after 10 ms, a
// heartbeat after three times 50 ms; a brake is watched for 500 ms.
// clang-format off
inline constexpr FaultRow kFaultRows[] = {
    {"feedback lost in 1 cycle", wire_fault<kLoses, false, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback lost in 3 cycles", wire_fault<kLoses, false, 3>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback lost", wire_fault<kLoses, false, kForGood>, kTimeout, {4, 4, 4}, 3, Status::kOk},
    {"feedback doubled in 10 cycles", wire_fault<kDoubles, false, 10>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback doubled", wire_fault<kDoubles, false, kForGood>, Status::kBusConflict, {30, 30, 30}, 3, Status::kBusConflict},
    {"feedback one cycle late, once", wire_fault<kDelays, false, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback one cycle late", wire_fault<kDelays, false, kForGood>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback cut in 1 cycle", wire_fault<kCuts, false, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"feedback cut", wire_fault<kCuts, false, kForGood>, kTimeout, {4, 4, 4}, 3, Status::kOk},
    {"command lost in 1 cycle", wire_fault<kLoses, true, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"command lost in 8 cycles", wire_fault<kLoses, true, 8>, Status::kOk, kNever, 0, Status::kOk},
    {"command lost", wire_fault<kLoses, true, kForGood>, kFault, {11, 11, 11}, 3, Status::kOk},
    {"command doubled", wire_fault<kDoubles, true, kForGood>, Status::kOk, kNever, 0, Status::kOk},
    {"command one cycle late, once", wire_fault<kDelays, true, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"command cut", wire_fault<kCuts, true, kForGood>, kFault, {11, 2, 2}, 10, Status::kOk},
    {"heartbeat missing", drive_fault<FaultKind::kStopHeartbeat>, kTimeout, {151, 151, 151}, 3, kTimeout},
    {"EMCY and fault", drive_fault<FaultKind::kEmergency, 0x4310>, kFault, {2, 2, 2}, 3, Status::kOk},
    {"switch on disabled by itself", drive_fault<FaultKind::kSwitchOnDisabled>, kFault, {0, 2, 2}, 3, Status::kOk},
    {"brake does not open", drive_fault<FaultKind::kBrakeStuck>, kFault, {508, 501, 0}, 3, Status::kOk},
    {"reboot", drive_fault<FaultKind::kReboot>, kTimeout, {5, 5, 5}, 3, Status::kConnectionLost},
    {"measured torque saturated", drive_fault<FaultKind::kSaturatedTorque>, Status::kStateInvalid, {210, 203, 2}, 3, Status::kOk},
    {"6061h shows another mode", drive_fault<FaultKind::kWrongMode, 9>, kFault, {20, 16, 0}, 3, Status::kOk},
};
// clang-format on

}  // namespace tactus::can
