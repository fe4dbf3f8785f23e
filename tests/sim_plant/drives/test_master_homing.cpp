// Homing of drives on CAN, in arming.
#include "tests/hal/cia402/homing_runs.hpp"
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {

namespace {

using cia402::HomingEvent, cia402::kAtSwitch;

MasterBench& fresh() {
  MasterBench& bench = fresh_bench();
  bench.can.sdo_ms = 50;
  return bench;
}

template <int joint>
void lose_feedback(MasterBench& bench) {
  disturb(bench, Wire::kLoses, false, 0x181 + joint, 1 << 20);
}

// clang-format off
constexpr HomingEvent<MasterBench> kOfTheWire[] = {
    {"feedback lost of the drive that is homed", lose_feedback<kAtSwitch>, Status::kBusTimeout, 5, false, false},
    {"feedback lost of another drive", lose_feedback<6>, Status::kBusTimeout, 5, false, false},
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
  cia402::suffer_everything(kOfTheWire, fresh, kLast, kApart);
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
