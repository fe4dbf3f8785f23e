// Random faults of drives and line.
#include "tests/hal/cia402/random_faults.hpp"
#include "tests/hal/ethercat/fault_bench.hpp"

namespace tactus::ethercat {
namespace {

constexpr FaultKind kKinds[] = {
    FaultKind::kEmergency,      FaultKind::kSwitchOnDisabled, FaultKind::kWrongMode,
    FaultKind::kBrakeStuck,     FaultKind::kSdoAbort,         FaultKind::kSdoSilence,
    FaultKind::kNonsenseStatus, FaultKind::kSaturatedTorque,  FaultKind::kReboot};
constexpr LineFaultKind kLines[] = {LineFaultKind::kBreak, LineFaultKind::kLose,
                                    LineFaultKind::kDelay, LineFaultKind::kCounter,
                                    LineFaultKind::kFall};

/// In every second run one drive has no LRW.
MasterBench& fresh(Random& random) {
  MasterBench& bench = fresh_bench();
  const auto slave = static_cast<std::size_t>(random.below(2 * kDof));
  if (slave < kDof) bench.plant.no_lrw[slave] = true;
  bench.ethercat.state_ms = 300;
  bench.ethercat.sdo_ms = 50;
  return bench;
}

void begin_fault(MasterBench& bench, Random& random) {
  if (random.below(2) == 0) {
    segment::LineFault fault;
    fault.kind = kLines[random.below(5)];
    fault.slave = random.below(kDof + 1);
    fault.at = bench.hal.line.arm().periods();
    fault.until = fault.at + 1 + random.below(20);
    fault.probability = random.below(2) == 0 ? 1.0 : 0.2;
    fault.value = static_cast<std::uint16_t>(random.below(65536));
    static_cast<void>(bench.hal.line.add(fault));  // no room: no fault
    return;
  }
  drives::Fault fault;
  fault.kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
  fault.probability = random.below(2) == 0 ? 1.0 : 0.1;
  if (fault.kind == FaultKind::kNonsenseStatus)
    fault.value = static_cast<std::uint32_t>(random.below(65536));
  static_cast<void>(bench.hal.line.slave(random.below(kDof)).faults().add(fault));
}

// Proves ECAT-8.
void no_fault_leads_to_a_command_that_is_not_allowed(void**) {
  cia402::survive_random_faults(fresh, begin_fault);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_fault_leads_to_a_command_that_is_not_allowed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
