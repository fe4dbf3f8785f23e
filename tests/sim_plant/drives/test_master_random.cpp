// Random faults of drives, wire and other nodes, on random layouts of the buses.
#include "tests/hal/cia402/random_faults.hpp"
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {
namespace {

using drives::FaultKind;

constexpr FaultKind kKinds[] = {
    FaultKind::kDropTpdo,         FaultKind::kDuplicateTpdo, FaultKind::kDelayTpdo,
    FaultKind::kTruncateTpdo,     FaultKind::kStopHeartbeat, FaultKind::kEmergency,
    FaultKind::kSwitchOnDisabled, FaultKind::kWrongMode,     FaultKind::kBrakeStuck,
    FaultKind::kSdoAbort,         FaultKind::kSdoSilence,    FaultKind::kNonsenseStatus,
    FaultKind::kSaturatedTorque,  FaultKind::kReboot};
constexpr Wire kWires[] = {Wire::kLoses, Wire::kDoubles, Wire::kDelays, Wire::kCuts};

MasterBench& fresh(Random& random) {
  return fresh_bench(static_cast<Buses>(random.below(4)));
}

void begin_foreign(MasterBench& bench, Random& random, int joint) {
  const int ids[] = {0x080,         0x000,         0x201,         0x77F, 0x181 + joint,
                     0x081 + joint, 0x701 + joint, 0x581 + joint, 0x123};
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(ids[random.below(9)]);
  frame.size = static_cast<std::uint8_t>(random.below(9));
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random.below(256));
  bench.hal.strange.push_back(frame);
  bench.hal.down = random.below(5) == 0;
}

void begin_fault(MasterBench& bench, Random& random) {
  const int joint = random.below(kDof);
  switch (random.below(4)) {
    case 0:
      disturb(bench, kWires[random.below(4)], true, command_id(bench, joint, random.below(2) == 0),
              1 + random.below(20));
      break;
    case 1:
      disturb(bench, kWires[random.below(4)], false, 0x181 + joint, 1 + random.below(10));
      break;
    case 2: begin_foreign(bench, random, joint); break;
    default: {
      drives::Fault fault;
      fault.kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
      fault.probability = random.below(2) == 0 ? 1.0 : 0.1;
      fault.value = fault.kind == FaultKind::kNonsenseStatus
                        ? static_cast<std::uint32_t>(random.below(65536))
                        : 0U;
      static_cast<void>(bench.hal.arm.node(joint).faults().add(fault));  // no room: no fault
    }
  }
}

// Proves CAN-12.
void no_fault_leads_to_a_command_that_is_not_allowed(void**) {
  cia402::survive_random_faults(fresh, begin_fault);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_fault_leads_to_a_command_that_is_not_allowed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
