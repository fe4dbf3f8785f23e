// Faults while the drives are armed and while they follow: every row of the table, for the first, a
// middle and the last joint, in every phase, on three layouts of the buses.
#include <string>

#include "tests/sim_plant/drives/fault_rows.hpp"

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

struct LostFrames {
  int id;
  int most;          // cycles until the stop is sent
  const char* says;  // behind the joint
};

/// A drive that no longer hears this program says so by EMCY (CiA 301), and the reason that users
/// see is its code in words. A heartbeat concerns all drives, a command its own.
void drives_that_do_not_hear_the_master_are_told_with_what_they_miss(void**) {
  constexpr LostFrames kLost[] = {
      {0x77F, 151, "the master's heartbeat is missing (error code 8130h)"},
      {0x203, 11, "the command PDO is missing (error code 8250h)"}};
  for (const LostFrames& lost : kLost)
    for (const cia402::When when : {cia402::When::kReleasing, cia402::When::kFollowing}) {
      MasterBench& bench = fresh_bench(Buses::kClassicPlain);
      bench.can.master_node = 127;
      lead_to(bench, when);
      SafetyWatch watch(bench);
      disturb(bench, Wire::kLoses, true, lost.id, 1 << 20);
      cia402::Outcome outcome;
      await_stop(bench, watch, outcome);
      assert_in_range(outcome.reaction, 1, lost.most);
      ASSERT_STATUS(outcome.status, Status::kDriveFault);
      const std::string why = bench.hal.trouble().c_str();
      const int named = lost.id == 0x203 ? 3 : outcome.joint + 1;
      const std::string expected = "joint " + std::to_string(named) + ": " + lost.says;
      if (why != expected) print_error("%s\n", why.c_str());
      assert_true(why == expected);
      assert_int_equal(outcome.joint, named - 1);
      heal(bench);
      ASSERT_OK(bench.start());
    }
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
      cmocka_unit_test(drives_that_do_not_hear_the_master_are_told_with_what_they_miss),
      cmocka_unit_test(drives_that_fall_back_are_armed_all_or_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
