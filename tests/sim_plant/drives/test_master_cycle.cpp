// The master against the emulated drives: armed, commanded and stopped through an executive.
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {
namespace {

MasterBench& fresh() {
  static MasterBench* bench = nullptr;
  delete bench;
  return *(bench = new MasterBench);
}

void explain(MasterBench& bench, Status status) {
  if (status != Status::kOk)
    print_error("%s: %s\n", name(status), bench.hal.master.trouble().c_str());
}

// Proves CAN-10.
void the_arm_is_taken_over_and_held_where_it_stands(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  const JointVector before = bench.hal.arm.arm().q();
  const Status status = bench.start();
  explain(bench, status);
  ASSERT_OK(status);
  ASSERT_OK(bench.cycles(500));
  const JointVector moved = bench.hal.arm.arm().q() - before;
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(moved[j], 0.0, 1e-3);
}

/// The first command goes on from the torque of the hold, which is not that of the motors.
void drives_that_carry_the_weight_are_taken_over_without_a_step(void**) {
  MasterBench& bench = fresh();
  bench.plant.gravity_by_drive = true;
  bench.drive.gravity = cia402::Gravity::kDrive;
  std::string text = cia402::kHoldingPipeline;
  text.erase(text.find("g = model.g\n"), 12);
  ASSERT_OK(bench.load(text.c_str()));
  const JointVector before = bench.hal.arm.arm().q();
  ASSERT_OK(bench.start());
  for (int i = 0; i < 500; ++i) {
    ASSERT_OK(bench.cycle());
    const JointVector moved = bench.hal.arm.arm().q() - before;
    for (int j = 0; j < kDof; ++j) ASSERT_NEAR(moved[j], 0.0, 1e-3);
    for (int j = 0; j < kDof; ++j) assert_true(std::abs(bench.hal.torque_sent(j)) < 1000);
  }
}

/// On a ceiling, as the file says: as still as an upright one. Not said: refused with what to look
/// at, before the arm has gone far, even if the brakes open as late as they may.
void an_arm_that_hangs_is_taken_over_if_the_file_says_so(void**) {
  const std::string upright = cia402::kHoldingPipeline;
  const std::string hanging =
      std::string(upright).insert(upright.find("tau_c"), "mounting = 3.14159265 0 0\n");
  struct Case {
    const std::string& text;
    double brake_release_s, hold_damping;
  };
  for (const auto& [text, release_s, damping] : {Case{hanging, 0.15, 10.0},
                                                 {upright, 0.15, 10.0},
                                                 {upright, 0.1995, 10.0},
                                                 {upright, 0.15, 0.0}}) {
    MasterBench& bench = fresh();
    bench.plant.brake_release_s = release_s;
    bench.drive.hold_damping.setConstant(damping);
    bench.plant.plant.mounting = Vector3(M_PI, 0.0, 0.0);
    ASSERT_OK(bench.load(text.c_str()));
    const JointVector before = bench.hal.arm.arm().q();
    const Status status = bench.start();
    const auto moved = [&] { return (bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff(); };
    if (&text == &hanging) {
      ASSERT_OK(status);
      ASSERT_OK(bench.cycles(500));
      assert_true(moved() < 1e-3);
      continue;
    }
    ASSERT_STATUS(status, Status::kMoved);
    assert_non_null(std::strstr(bench.hal.trouble().c_str(), "mounting and tool of [robot]"));
    for (int again = 0; again < 3; ++again) {
      for (int i = 0; i < 1000; ++i) (void)bench.cycle();  // until the brakes hold
      ASSERT_STATUS(bench.arm(), Status::kMoved);
    }
    print_message("hanging unsaid it moves by %.3f rad; brakes %.1f ms, damping %.0f\n", moved(),
                  1e3 * release_s, damping);
    assert_true(moved() < 0.08);
  }
}

// Proves CAN-19.
/// 603Fh is left from the day before, and the drive sends its EMCY to nobody.
void faults_that_stood_before_are_told_with_their_codes_and_cleared(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  for (const int joint : {1, 6}) inject(bench, joint, drives::FaultKind::kEmergency, 0x7500);
  bench.hal.arm.advance(10'000'000);
  for (const int joint : {1, 6})
    assert_true(bench.hal.arm.node(joint).axis().state() == cia402::State::kFault);
  heal(bench);
  const Status status = bench.start();
  explain(bench, status);
  ASSERT_OK(status);
  const cia402::Detail first = detail_of(bench, Cause::kOldFault);
  assert_string_equal(first.joints.c_str(), "27");
  assert_int_equal(first.code, 0x7500);

  bench.executive.halt();
  while (bench.executive.busy()) (void)bench.cycle();
  const std::uint32_t from = bench.executive.events().count();
  inject(bench, 3, drives::FaultKind::kEmergency, 0x4310);
  for (int i = 0; i < 10; ++i) (void)bench.cycle();
  heal(bench);
  ASSERT_OK(bench.arm());
  const cia402::Detail second = detail_of(bench, Cause::kOldFault, from);
  assert_string_equal(second.joints.c_str(), "4");
  assert_int_equal(second.code, 0x4310);
}

/// 603Fh is that of the last error, which may have gone.
void warnings_stop_nothing_and_are_told_with_their_codes(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  drives::Fault warning;
  warning.kind = drives::FaultKind::kWarning;
  warning.value = 0x4210;
  assert_true(bench.hal.arm.node(2).faults().add(warning));
  warning.until = 1;  // gone before the first SYNC
  assert_true(bench.hal.arm.node(4).faults().add(warning));
  ASSERT_OK(bench.start());
  assert_int_equal(bench.hal.master.node(4).feedback.error_code, 0);
  ASSERT_OK(bench.cycles(100));
  const cia402::Detail told = detail_of(bench, Cause::kWarning);
  assert_string_equal(told.joints.c_str(), "3");
  assert_int_equal(told.code, 0x4210);
  heal(bench);
  ASSERT_OK(bench.cycles(10));
  assert_int_equal(bench.hal.master.node(2).feedback.error_code, 0);
  assert_string_equal(detail_of(bench, Cause::kOldFault).joints.c_str(), "");
}

constexpr int kFeedbackOf2 = 0x182;

/// The first late frame comes with the next one, and nothing is older than before.
void feedback_that_is_late_again_and_again_and_comes_with_the_next_goes_on(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  for (int i = 0; i < 30; ++i) {
    disturb(bench, Wire::kDelays, false, kFeedbackOf2, 1);
    ASSERT_OK(bench.cycles(10));
  }
}

/// Whatever has been lost, or is later by so many cycles from now on.
void feedback_that_is_lost_again_and_again_stops_the_arm(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  for (int i = 0; i < 3; ++i) {
    disturb(bench, Wire::kLoses, false, kFeedbackOf2, 1);
    ASSERT_OK(bench.cycles(100));
  }
  disturb(bench, Wire::kLoses, false, kFeedbackOf2, 1);
  ASSERT_STATUS(bench.cycles(100), Status::kBusTimeout);
  const Message trouble = bench.hal.trouble();
  assert_non_null(std::strstr(trouble.c_str(), "joint 2: no feedback in more cycles than"));
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_arm_is_taken_over_and_held_where_it_stands),
      cmocka_unit_test(an_arm_that_hangs_is_taken_over_if_the_file_says_so),
      cmocka_unit_test(drives_that_carry_the_weight_are_taken_over_without_a_step),
      cmocka_unit_test(faults_that_stood_before_are_told_with_their_codes_and_cleared),
      cmocka_unit_test(warnings_stop_nothing_and_are_told_with_their_codes),
      cmocka_unit_test(feedback_that_is_late_again_and_again_and_comes_with_the_next_goes_on),
      cmocka_unit_test(feedback_that_is_lost_again_and_again_stops_the_arm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
