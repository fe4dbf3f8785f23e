// Tests what a UR's HAL makes of the calibration that a controller tells: which arm it takes, and
// which it refuses with the remedies. A board with the table of one arm: test_ur_calibrate.cpp.
#include "sim_plant/ur/motion/calibration.hpp"
#include "tests/ur/hal/ur_emulated_bench.hpp"

namespace tactus::ur {
namespace {

UrArmBench& arm_of(unsigned seed) {
  Settings settings;
  settings.dh = draw_calibration(seed);
  return fresh_arm(settings);
}

ArmCalibration told_by(const DhTable& dh) {
  std::array<std::uint8_t, 256> bytes;
  ByteWriter out(bytes.data(), bytes.size());
  write_kinematics(dh, out);
  ArmCalibration arm;
  assert_true(arm.take(ByteReader(out.data() + 5, out.size() - 5)));
  return arm;
}

// Proves URH-36.
void a_calibrated_arm_is_refused_by_the_nominal_board_with_both_remedies(void**) {
  UrArmBench& bench = arm_of(3);
  ASSERT_STATUS(bench.executive.start(), Status::kMismatch);
  assert_true(
      bench.says("the arm has a calibration of its own, and this program the table of the "
                 "nominal UR10: the tip is 0.00"));
  assert_true(bench.says("; scripts/robot-calibrate --address ADDRESS --name ur10_NAME writes"));
  assert_true(bench.says("; or [ur] calibration = any takes it as it is"));
}

void any_arm_is_taken_where_the_file_says_so(void**) {
  UrArmBench& bench = arm_of(3);
  bench.settings.calibration = Calibration::kAny;
  ASSERT_OK(start(bench));
}

void nominal_parameters_fit_whatever_their_checksums(void**) {
  DhTable rounded;  // as manufacturers write them
  rounded.alpha[0] = rounded.alpha[3] = 1.570796327;
  assert_true(told_by(kDh).fits_table());
  assert_true(told_by(rounded).fits_table());
  for (auto table : {&DhTable::theta, &DhTable::a, &DhTable::d, &DhTable::alpha})
    for (std::size_t joint = 0; joint < 6; ++joint)
      for (const double error : {2e-9, -2e-9, kRequired}) {
        DhTable other;
        (other.*table)[joint] += error;
        assert_false(told_by(other).fits_table());
      }
}

void a_calibration_that_cannot_be_read_is_not_told(void**) {
  for (const std::size_t length : {0, 4, 6, 224, 226, 255}) {
    UrHalBench& bench = g_bench.emplace();
    bench.robot.faults.kinematics_length = length;
    ASSERT_STATUS(bench.connect(), Status::kBusTimeout);
    assert_true(bench.says("has not told the arm's calibration; check primary_port"));
    assert_true(bench.says("[ur] calibration = any"));
  }
}

/// Somebody calibrates the arm while the board is connected.
void every_arming_compares(void**) {
  UrHalBench& bench = g_bench.emplace();
  ASSERT_OK(bench.connect());
  bench.robot.change([&](FakeImage&) {
    bench.robot.faults.kinematics.a[1] -= 1e-3;
    bench.robot.tell_kinematics();
  });
  ASSERT_STATUS(bench.arm(), Status::kMismatch);
  assert_true(bench.says(", but none in force; [ur] calibration = any takes it"));
  assert_int_equal(bench.robot.uploads(), 0);
  bench.settings.calibration = Calibration::kAny;
  ASSERT_OK(bench.arm());
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_calibrated_arm_is_refused_by_the_nominal_board_with_both_remedies),
      cmocka_unit_test(any_arm_is_taken_where_the_file_says_so),
      cmocka_unit_test(nominal_parameters_fit_whatever_their_checksums),
      cmocka_unit_test(a_calibration_that_cannot_be_read_is_not_told),
      cmocka_unit_test(every_arming_compares),
  };
  return cmocka_run_group_tests(tests, nullptr, [](void** state) {
    end_bench(state);
    return end_arm(state);
  });
}
