// Faults while the drives are armed and while they follow: every row of the table, for the first, a
// middle and the last joint, in every phase, on three layouts of the buses.
#include "tests/drives/fault_rows.hpp"

namespace tactus::can {
namespace {

template <Buses buses>
cia402::Outcome suffer(const cia402::FaultRow<MasterBench>& row, cia402::When when, int joint) {
  MasterBench& bench = fresh_bench(buses);
  lead_to(bench, when);
  SafetyWatch watch(bench);
  cia402::Outcome outcome;
  row.begin(bench, joint);
  const Disturbance& wire = bench.hal.disturbance;
  const int named = wire.to_drive ? (wire.id & 0xF) - 1 : joint;
  await_stop(bench, watch, outcome);
  if (outcome.reaction == 0) return outcome;
  assert_int_equal(outcome.joint, row.status == Status::kBusConflict ? -1 : named);
  heal(bench);
  for (int i = 0; i < 200; ++i) (void)watch.cycle();
  assert_false(bench.executive.busy());  // a drive that is lost is not waited for
  rearm(bench, watch, outcome);
  return outcome;
}

template <Buses buses>
void every_fault_stops_all_drives_or_is_bridged() {
  cia402::judge_faults(std::begin(kFaultRows), std::end(kFaultRows), suffer<buses>);
}

// Proves CAN-11.
void every_fault_on_can_fd_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged<Buses::kFdPacked>();
}
void every_fault_on_three_classic_buses_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged<Buses::kClassicPlain>();
}
void every_fault_on_two_classic_buses_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged<Buses::kClassicPacked>();
}

// Proves CAN-3.
void drives_that_fall_back_are_armed_all_or_named(void**) {
  cia402::arm_drives_that_fall<MasterBench>(
      [](void) -> MasterBench& { return fresh_bench(); },
      [](MasterBench& bench, int joint, double p) {
        drives::Fault fault;
        fault.kind = FaultKind::kSwitchOnDisabled;
        fault.probability = p;
        assert_true(bench.hal.arm.node(joint).faults().add(fault));
      });
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_fault_on_can_fd_stops_all_drives_or_is_bridged),
      cmocka_unit_test(every_fault_on_three_classic_buses_stops_all_drives_or_is_bridged),
      cmocka_unit_test(every_fault_on_two_classic_buses_stops_all_drives_or_is_bridged),
      cmocka_unit_test(drives_that_fall_back_are_armed_all_or_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
