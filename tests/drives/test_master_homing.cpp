// Homing of drives on CAN, in arming.
#include "tests/cia402/homing_runs.hpp"
#include "tests/drives/fault_bench.hpp"

namespace tactus::can {

namespace {

using cia402::HomingEvent, cia402::kAtSwitch, cia402::kHere;
using drives::FaultKind;

MasterBench& fresh() {
  MasterBench& bench = fresh_bench();
  bench.can.sdo_ms = 50;
  return bench;
}

template <FaultKind kind, std::uint32_t value, int joint>
void drive_fault(MasterBench& bench) {
  inject(bench, joint, kind, value);
}
template <int joint>
void lose_feedback(MasterBench& bench) {
  disturb(bench, Wire::kLoses, false, 0x181 + joint, 1 << 20);
}
void stop(MasterBench& bench) {
  bench.executive.halt();
}

constexpr auto kFault = Status::kDriveFault;
// clang-format off
constexpr HomingEvent<MasterBench> kEvents[] = {
    {"stop requested", stop, Status::kHalted, 1, false, false},
    {"feedback lost of the drive that is homed", lose_feedback<kAtSwitch>, Status::kBusTimeout, 5, false, false},
    {"feedback lost of another drive", lose_feedback<6>, Status::kBusTimeout, 5, false, false},
    {"EMCY and fault of the drive that is homed", drive_fault<FaultKind::kEmergency, 0x7121, kAtSwitch>, kFault, 4, true, false},
    {"EMCY and fault of another drive", drive_fault<FaultKind::kEmergency, 0x7121, 6>, kFault, 4, true, false},
    {"switch on disabled by itself", drive_fault<FaultKind::kSwitchOnDisabled, 0, kAtSwitch>, kFault, 4, true, false},
    {"reboot of the drive that is homed", drive_fault<FaultKind::kReboot, 0, kAtSwitch>, Status::kBusTimeout, 6, false, true},
    {"no answers by SDO", drive_fault<FaultKind::kSdoSilence, 0, kAtSwitch>, Status::kBusTimeout, 1500, true, false},
    {"6060h is refused", drive_fault<FaultKind::kSdoAbort, 0x6060, kAtSwitch>, Status::kRefusedByRobot, 1500, true, false},
    {"6098h is refused", drive_fault<FaultKind::kSdoAbort, 0x6098, kAtSwitch>, Status::kRefusedByRobot, 1500, true, false},
    {"6061h shows another mode", drive_fault<FaultKind::kWrongMode, 9, kAtSwitch>, kFault, 1500, true, false},
    {"homing ends in an error", drive_fault<FaultKind::kHomingFails, 2, kAtSwitch>, Status::kNotReferenced, 1500, true, false},
    {"homing ends in an error while it moves", drive_fault<FaultKind::kHomingFails, 3, kHere>, Status::kNotReferenced, 1500, true, false},
    {"homing does not end", drive_fault<FaultKind::kHomingFails, 1, kAtSwitch>, Status::kNotReferenced, 3000, true, false},
};
// clang-format on

// Proves CAN-21.
void drives_without_their_reference_are_homed_one_after_the_other_and_once(void**) {
  for (const Buses buses :
       {Buses::kFdPacked, Buses::kFdPlain, Buses::kClassicPlain, Buses::kClassicPacked})
    cia402::home_and_arm_again(fresh_bench(buses));
}

// Proves CAN-22.
void whatever_comes_in_the_midst_of_homing_stops_all_drives(void**) {
  constexpr int kLast = 255, kApart = 5;  // cycles
  cia402::suffer_everything(std::begin(kEvents), std::end(kEvents), fresh, kLast, kApart);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(drives_without_their_reference_are_homed_one_after_the_other_and_once),
      cmocka_unit_test(whatever_comes_in_the_midst_of_homing_stops_all_drives),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
