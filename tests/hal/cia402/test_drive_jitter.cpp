// Arming beside cycles that begin a little early or late, as the wake-ups of a computer do.
#include "tests/hal/cia402/arm_of_drives.hpp"

namespace tactus::cia402 {
namespace {

constexpr std::int64_t kJitter_ns = 30'000;

/// Returns the cycles until the drives are armed, if those in which the brakes open are shifted.
int cycles_to_arm(std::int64_t shift_ns) {
  ArmOfDrives arm;
  int cycles = 0;
  for (; arm.drives.phase() != ArmingPhase::kArmed && cycles < 200; ++cycles) {
    const std::int64_t now_ns = arm.now_ns;
    if (arm.drives.phase() == ArmingPhase::kReleasing) arm.now_ns += shift_ns;
    arm.cycle(DriveRequest::kArm);
    arm.now_ns = now_ns + 1'000'000;
  }
  return cycles;
}

// Proves CAN-3.
void arming_takes_as_many_cycles_whatever_the_jitter_of_their_beginnings(void**) {
  const int cycles = cycles_to_arm(0);
  assert_in_range(cycles, 110, 140);
  assert_int_equal(cycles_to_arm(-kJitter_ns), cycles);
  assert_int_equal(cycles_to_arm(kJitter_ns), cycles);
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(arming_takes_as_many_cycles_whatever_the_jitter_of_their_beginnings),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
