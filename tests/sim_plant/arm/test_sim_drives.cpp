// Tests the drives of the simulated robot: arming and disabling over cycles, faults, and the arm
// while no drive follows.
#include <limits>

#include "tests/sim_plant/arm/sim_hal_bench.hpp"

namespace tactus {
namespace {

using Bench = SimHalBench;

// Proves SIM-4.

struct BadCommand {
  CommandMode mode;
  JointVector value;
};

void a_command_that_cannot_be_executed_is_a_fault_that_closes_the_brakes(void**) {
  Bench& b = g_bench;
  JointVector nan = JointVector::Zero(), infinite = nan;
  nan[kDof - 1] = std::nan("");
  infinite[0] = std::numeric_limits<double>::infinity();
  for (const BadCommand& bad : {BadCommand{kEffort, nan},
                                {kEffort, infinite},
                                {CommandMode::kVelocity, JointVector::Zero()}}) {
    b.start(PlantParams());
    for (int k = 0; k < 100; ++k) b.cycle(wave(k));
    const JointVector q = b.hal.arm().q();
    ASSERT_STATUS(follow(b.hal, bad.mode, bad.value), Status::kDriveFault);
    assert_true(same_bytes(b.hal.arm().q(), q) && b.hal.arm().dq().isZero(0.0));
    ASSERT_OK(b.hal.write({kEffort, b.hold, DriveRequest::kArm}));  // clears the fault
    ASSERT_OK(follow(b.hal, kEffort, b.hold));
  }
}

void a_plant_that_diverges_is_a_fault_until_it_is_loaded_again(void**) {
  Bench& b = g_bench;
  b.start(PlantParams());
  ASSERT_STATUS(follow(b.hal, kEffort, JointVector::Constant(1e12)), Status::kDriveFault);
  for (int k = 0; k < 3; ++k) {
    ASSERT_OK(b.hal.write({kEffort, b.hold, DriveRequest::kArm}));
    ASSERT_OK(measure(b.hal, b.state));
    assert_true(b.state.drives[0].state == DriveState::kFault);
  }
  b.start(PlantParams());
}

void disabled_drives_let_the_arm_stand_and_time_goes_on(void**) {
  Bench& b = g_bench;
  b.start(PlantParams());
  const std::int64_t start_ns = b.hal.time_ns();
  for (int k = 0; k < 100; ++k) b.cycle(wave(k));
  const JointVector q = b.hal.arm().q();
  for (int k = 0; k < 2; ++k) ASSERT_OK(b.hal.write({kEffort, b.hold}));
  ASSERT_STATUS(follow(b.hal, kEffort, b.hold + wave(5)), Status::kNotStarted);
  ASSERT_OK(b.hal.write({kEffort, b.hold, DriveRequest::kArm}));
  ASSERT_OK(measure(b.hal, b.state));
  assert_true(same_bytes(b.state.q, q) && b.state.dq.isZero(0.0));
  assert_int_equal(b.hal.time_ns() - start_ns, 104 * 1000 * 1000);
  ASSERT_OK(follow(b.hal, kEffort, b.state.tau));
  ASSERT_NEAR((b.hal.arm().q() - q).norm(), 0.0, 1e-12);
  static_cast<void>(b.hal.disconnect());
  static_cast<void>(b.hal.disconnect());
  ASSERT_STATUS(measure(b.hal, b.state), Status::kNotStarted);
}

/// In the cycles that the drives are on their way, the arm stands.
void the_drives_take_the_cycles_stated_to_become_enabled_and_disabled(void**) {
  Bench& b = g_bench;
  PlantParams params;
  params.arming_cycles = 20;
  ASSERT_OK(b.hal.load(params, 1));
  b.hal.set_period(kPeriod_s);
  ASSERT_OK(b.hal.connect(kEffort));
  for (const DriveRequest request :
       {DriveRequest::kArm, DriveRequest::kDisable, DriveRequest::kArm}) {
    const bool arms = request == DriveRequest::kArm;
    for (int k = 1; k <= 20; ++k) {
      ASSERT_OK(b.hal.write({kEffort, JointVector::Constant(50.0), request}));
      ASSERT_OK(measure(b.hal, b.state));
      const DriveState under_way = arms ? DriveState::kArming : DriveState::kStopping;
      const DriveState end = arms ? DriveState::kEnabled : DriveState::kDisabled;
      for (const Drive& drive : b.state.drives) {
        assert_true(drive.state == (k < 20 ? under_way : end));
        assert_true(drive.valid);
      }
      assert_true(b.hal.arm().dq().isZero(0.0));
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_command_that_cannot_be_executed_is_a_fault_that_closes_the_brakes),
      cmocka_unit_test(a_plant_that_diverges_is_a_fault_until_it_is_loaded_again),
      cmocka_unit_test(disabled_drives_let_the_arm_stand_and_time_goes_on),
      cmocka_unit_test(the_drives_take_the_cycles_stated_to_become_enabled_and_disabled),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
