// The faults that the master must survive while drives are armed or follow: how each begins, and
// what the master is expected to make of it.
#pragma once

#include "tests/hal/cia402/fault_table.hpp"
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {

using cia402::kFault, cia402::kNever, cia402::kTimeout;
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

inline constexpr int kForGood = 1000;  // cycles
constexpr Wire kLoses = Wire::kLoses, kDoubles = Wire::kDoubles, kDelays = Wire::kDelays,
               kCuts = Wire::kCuts;

// The cycles: 4 without feedback are one more than max_missed; a command times out after 10 ms, a
// heartbeat after three times 50 ms; a brake is watched for 500 ms.
// clang-format off
inline constexpr cia402::FaultRow<MasterBench> kFaultRows[] = {
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
    {"measured torque saturated", drive_fault<FaultKind::kSaturatedTorque>, Status::kStateInvalid, {310, 303, 2}, 3, Status::kOk},
    {"6061h shows another mode", drive_fault<FaultKind::kWrongMode, 9>, kFault, {20, 16, 0}, 3, Status::kOk},
    {"statusword bit 7, warning", drive_fault<FaultKind::kWarning, 0x4210>, Status::kOk, kNever, 0, Status::kOk},
};
// clang-format on

}  // namespace tactus::can
