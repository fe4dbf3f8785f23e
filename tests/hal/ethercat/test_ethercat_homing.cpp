// Homing of drives on EtherCAT, in arming.
#include "tests/hal/cia402/homing_runs.hpp"
#include "tests/hal/ethercat/fault_bench.hpp"

namespace tactus::ethercat {

namespace {

using cia402::HomingEvent, cia402::kAtSwitch, cia402::kHere;
MasterBench& fresh() {
  MasterBench& bench = fresh_bench();
  bench.ethercat.sdo_ms = 50;
  return bench;
}

void lose_frames(MasterBench& bench) {
  bench.add(LineFaultKind::kLose, 0, 0, kForGood);
}
void cut_line(MasterBench& bench) {
  bench.add(LineFaultKind::kBreak, 5, 0, kForGood);
}

// clang-format off
constexpr HomingEvent<MasterBench> kOfTheWire[] = {
    {"frames lost", lose_frames, Status::kBusTimeout, 6, false, true},
    {"line cut before slave 5", cut_line, Status::kBusTimeout, 6, false, true},
};
// clang-format on

// Proves ECAT-21.
void drives_without_their_reference_are_homed_one_after_the_other_and_once(void**) {
  cia402::home_and_arm_again(fresh_bench());
}

/// From now on the drive of joint kAtSwitch refuses to change its outputs, which have 6060h.
void keep_its_mapping(MasterBench& bench) {
  bench.hal.tamper = [&bench](Frame& frame) {
    FrameReader reader(frame);
    Datagram datagram;
    if (!reader.next(datagram) || datagram.command != Command::kFpwr ||
        datagram.position() != 0x1001 + kAtSwitch || datagram.reg() != 0x1000 ||
        (datagram.data[8] & 0xE0) != 0x20)
      return;
    const auto index = get<std::uint16_t>(datagram.data + 9);
    if (index == 0x1A00) heal(bench);
    if (index != 0x1C12) return;
    drives::Fault fault;
    fault.kind = FaultKind::kSdoAbort;
    fault.node = kAtSwitch + 1;
    fault.value = 0x1600;
    fault.abort = 0x06010002;
    assert_true(bench.hal.line.add(fault));
  };
}

// Proves ECAT-21.
void a_mode_that_is_mapped_is_requested_by_the_cycle_alone(void**) {
  constexpr int kModeByte = 6;  // behind controlword, torque and torque offset
  MasterBench& bench = fresh();
  cia402::count_from_power_on(bench);
  ASSERT_OK(bench.load());
  keep_its_mapping(bench);
  const Status connected = bench.connect();
  if (connected != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(connected);
  bench.hal.tamper = nullptr;
  bench.add(FaultKind::kSdoAbort, kAtSwitch + 1, 0x6060);
  std::string modes;
  Status status = bench.executive.arm();
  while (status == Status::kArming) {
    status = bench.cycle();
    if (status == Status::kArming) status = bench.executive.arm();
    const std::string mode = std::to_string(outputs_sent(bench, kAtSwitch)[kModeByte]) + " ";
    if (modes.size() < mode.size() || modes.substr(modes.size() - mode.size()) != mode)
      modes += mode;
  }
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
  assert_string_equal(modes.c_str(), "10 6 10 ");
  assert_true(axis(bench, kAtSwitch).referenced());
}

// Proves ECAT-22.
void whatever_comes_in_the_midst_of_homing_stops_all_drives(void**) {
  constexpr int kLast = 255, kApart = 5;  // cycles
  cia402::suffer_everything(kOfTheWire, fresh, kLast, kApart);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(drives_without_their_reference_are_homed_one_after_the_other_and_once),
      cmocka_unit_test(a_mode_that_is_mapped_is_requested_by_the_cycle_alone),
      cmocka_unit_test(whatever_comes_in_the_midst_of_homing_stops_all_drives),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
