// The homing mode of an emulated drive that counts from power-on.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

constexpr std::size_t kJoint = 3;
constexpr int kNode = 4;
constexpr unsigned kEnd = 0x3400, kReferenced = 0x4000;  // of the statusword
constexpr std::int32_t kOffset = -100000;                // increments

/// Enabled in homing mode with a method, and not started.
DrivesBench& enabled(int method) {
  DriveArmSettings settings = one_bus();
  settings.homing[kJoint].incremental = settings.homing[kJoint].shows = true;
  settings.homing[kJoint].upper_rad = robot_mjcf().ready_pose[kJoint] + 0.01;
  settings.homing[kJoint].offset = kOffset;
  DrivesBench& bench = fresh(settings);
  bench.configure(6);
  bench.put(kNode, 0x6098, 0, method, 1);
  for (const int word : {0x06, 0x07, 0x0F}) {
    bench.controlword[kJoint] = static_cast<std::uint16_t>(word);
    bench.cycle();
  }
  bench.cycles(200);
  return bench;
}
void start(DrivesBench& bench, int cycles) {
  bench.controlword[kJoint] = 0x1F;
  bench.cycles(cycles);
}
unsigned end_of(const DrivesBench& bench) {
  return bench.feedback[kJoint].status & kEnd;
}

// Proves DRV-8.
void a_drive_counts_from_power_on_until_it_is_homed_at_its_switch(void**) {
  DrivesBench& bench = enabled(18);
  const double q = bench.arm.arm().q()[kJoint];
  assert_int_equal(end_of(bench), 0x0400);
  assert_int_equal(bench.feedback[kJoint].status & kReferenced, 0);
  assert_in_range(bench.feedback[kJoint].position + 1000, 0, 2000);
  start(bench, 30);
  assert_int_equal(end_of(bench), 0);
  assert_true(bench.arm.arm().q()[kJoint] > q + 0.001);
  start(bench, 600);
  assert_int_equal(end_of(bench), 0x1400);
  assert_true((bench.feedback[kJoint].status & kReferenced) != 0);
  ASSERT_NEAR(bench.arm.arm().q()[kJoint], q + 0.01, 1e-3);
  assert_in_range(bench.feedback[kJoint].position - kOffset + 1000, 0, 2000);
}

void homing_is_interrupted_by_its_bit_and_ends_in_an_error_by_an_unknown_method(void**) {
  DrivesBench& bench = enabled(18);
  start(bench, 10);
  bench.controlword[kJoint] = 0x0F;
  bench.cycles(200);
  assert_int_equal(end_of(bench), 0x0400);
  const double q = bench.arm.arm().q()[kJoint];
  bench.cycles(200);
  ASSERT_NEAR(bench.arm.arm().q()[kJoint], q, 1e-4);
  DrivesBench& unknown = enabled(5);
  start(unknown, 5);
  assert_int_equal(end_of(unknown), 0x2400);
  assert_int_equal(unknown.feedback[kJoint].status & kReferenced, 0);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_counts_from_power_on_until_it_is_homed_at_its_switch),
      cmocka_unit_test(homing_is_interrupted_by_its_bit_and_ends_in_an_error_by_an_unknown_method),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
