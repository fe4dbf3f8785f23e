// Drives that fall back on their way up: by themselves, to any lower state, in any cycle.
#include <cstring>

#include "tests/hal/cia402/arm_of_drives.hpp"
#include "tests/support/random.hpp"

namespace tactus::cia402 {
namespace {

// The states with their statuswords, lowest first.
constexpr std::uint16_t kLadder[] = {0x0250, 0x0231, 0x0233, 0x1237};
constexpr int kTop = 3;

int height(std::uint16_t word) {
  int at = kTop;
  while (at > 0 && kLadder[at] != word) --at;
  return at;
}

/// Lets the drive of a joint fall; false: it is at the bottom.
bool fall(ArmOfDrives& arm, int joint, int below) {
  FakeDrive& drive = arm.fake(joint);
  const int at = height(drive.word);
  if (at == 0) return false;
  drive.word = kLadder[below % at];
  return true;
}

bool names(const ArmOfDrives& arm, std::uint32_t joints) {
  const Message why = arm.drives.why();
  bool any = false;
  for (int j = 0; j < kDof; ++j) {
    const Message of = joint_text(j) << ": ";
    const bool this_one = std::strncmp(why.c_str(), of.c_str(), std::strlen(of.c_str())) == 0;
    any = any || (this_one && (joints >> j & 1U) != 0);
  }
  if (!any) print_error("none of %x: %s\n", joints, why.c_str());
  return any;
}

struct Tally {
  int armed = 0, refused = 0, longest = 0;
};

/// Arms while the drives of `weak` joints fall with a probability of 1 in `seldom` in each cycle.
void arm_with_falls(Random& random, std::uint32_t weak, int seldom, Tally& tally) {
  constexpr int kMost = 2500;  // cycles: a drive may seem to stay in a state, for step_ms
  ArmOfDrives arm;
  arm.settings.brake_ms = random.below(12);
  std::uint32_t fallen = 0;
  int cycles = 0;
  for (; cycles < kMost && arm.drives.phase() != ArmingPhase::kFailed; ++cycles) {
    arm.cycle(DriveRequest::kArm);
    if (arm.all(DriveState::kEnabled)) break;
    for (int j = 0; j < kDof; ++j)
      if ((weak >> j & 1U) != 0 && random.below(seldom) == 0 && fall(arm, j, random.below(kTop)))
        fallen |= 1U << j;
  }
  tally.longest = std::max(tally.longest, cycles);
  assert_true(cycles < kMost);
  if (arm.drives.phase() == ArmingPhase::kFailed) {
    ++tally.refused;
    assert_true(names(arm, fallen));
    for (const DriveCommand& command : arm.commands)
      assert_int_equal(command.controlword & 0x0008, 0);
    return;
  }
  ++tally.armed;
  for (const DriveFeedback& feedback : arm.feedbacks)
    assert_int_equal(feedback.statusword, kLadder[kTop]);
}

// Proves CAN-3.
void arming_ends_with_all_joints_enabled_or_names_one_that_fell(void**) {
  Random random{402};
  Tally tally;
  for (int run = 0; run < 2000; ++run) {
    const auto weak = static_cast<std::uint32_t>(1 + random.below((1 << kDof) - 1));
    arm_with_falls(random, weak, 1 + random.below(600), tally);
  }
  print_message("%d armed, %d refused, after %d cycles at most\n", tally.armed, tally.refused,
                tally.longest);
  assert_true(tally.armed > 200 && tally.refused > 200);
}

/// Takes the drives to a phase, and lets one fall once in `every` cycles, `times`.
ArmingPhase phase_after(ArmOfDrives& arm, int joint, int times, int every) {
  for (int i = 0; times > 0 && i < 2000 && arm.drives.phase() != ArmingPhase::kFailed; ++i) {
    arm.cycle(DriveRequest::kArm);
    if (i % every == every - 1 && fall(arm, joint, 0)) --times;
  }
  arm.cycles(50 + arm.settings.held_ms(), DriveRequest::kArm);
  return arm.drives.phase();
}

void a_few_falls_are_bridged_and_more_are_refused_by_name(void**) {
  constexpr int kEvery = 3;  // before all are steady
  for (const int joint : {0, 3, 6}) {
    ArmOfDrives arm;
    assert_int_equal(phase_after(arm, joint, DriveMachine::kMostFalls, kEvery),
                     ArmingPhase::kArmed);
    ArmOfDrives weak;
    assert_int_equal(phase_after(weak, joint, DriveMachine::kMostFalls + 1, kEvery),
                     ArmingPhase::kFailed);
    assert_true(names(weak, 1U << joint));
    assert_non_null(std::strstr(weak.drives.why().c_str(), "switch on disabled"));
    assert_non_null(std::strstr(weak.drives.why().c_str(), "(statusword 0250h)"));
    weak.cycles(5, DriveRequest::kDisable);
    weak.arm();  // a new arming counts anew
  }
}

/// A joint that holds the others up for longer than an arming may take, in any state on the way.
void the_time_of_an_arming_names_the_joint_that_all_wait_for(void**) {
  for (const int joint : {0, 3, 6})
    for (const std::uint16_t word : {kLadder[0], kLadder[1]}) {
      ArmOfDrives arm;
      arm.settings.step_ms = 60000;
      Message why;
      ASSERT_OK(arm.drives.configure(arm.settings, Tool{}, 1000, 200, why));
      arm.fake(joint).word = word;
      arm.fake(joint).stays = true;
      arm.cycles(198, DriveRequest::kArm);
      assert_int_equal(arm.drives.phase(), ArmingPhase::kSwitchingOn);
      arm.cycles(2, DriveRequest::kArm);  // the executive ends arming behind the 200th
      assert_int_equal(arm.joint(joint).state, DriveState::kFault);
      ASSERT_STATUS(arm.joint(joint).reason, Status::kArmingTime);
      assert_true(names(arm, 1U << joint));
      assert_non_null(std::strstr(arm.drives.why().c_str(), name(state_of(word))));
    }
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(arming_ends_with_all_joints_enabled_or_names_one_that_fell),
      cmocka_unit_test(the_time_of_an_arming_names_the_joint_that_all_wait_for),
      cmocka_unit_test(a_few_falls_are_bridged_and_more_are_refused_by_name),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
