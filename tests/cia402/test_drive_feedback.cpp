// What is made of feedback that is missing, late, impossible or the last of a drive.
#include "tests/cia402/arm_of_drives.hpp"

namespace tactus::cia402 {
namespace {

/// Drive 2 says nothing in `silent` cycles, and then something in `heard` ones, with what was late.
Status hears(ArmOfDrives& arm, int silent, int heard, int late = 0) {
  for (int i = 0; i < silent + heard; ++i) {
    arm.silent = i < silent ? 1 : -1;
    arm.feedbacks[1].made_up = i == silent ? late : 0;
    arm.cycle(DriveRequest::kArm);
    if (arm.all(DriveState::kEnabled)) continue;
    arm.cycle(DriveRequest::kArm);
    return arm.joint(1).reason;
  }
  return Status::kOk;
}

// Proves CAN-3.
/// Each gap may make what comes after it older; nothing in a frame says how old it is.
void feedback_that_is_missing_again_and_again_stops_the_arm_as_a_long_gap_does(void**) {
  static ArmOfDrives arm;
  arm.arm();
  ASSERT_OK(hears(arm, 3, 50));
  ASSERT_STATUS(hears(arm, 1, 0), Status::kBusTimeout);
  assert_non_null(
      std::strstr(arm.drives.why().c_str(), "joint 2: no feedback in more cycles than"));

  static ArmOfDrives slow;  // one is forgotten in 1000 cycles
  slow.arm();
  ASSERT_OK(hears(slow, 3, 1000));
  ASSERT_OK(hears(slow, 1, 1000));
  ASSERT_OK(hears(slow, 1, 900));
  ASSERT_STATUS(hears(slow, 1, 0), Status::kBusTimeout);

  static ArmOfDrives late;  // frames that come together are as old as ever
  late.arm();
  for (int i = 0; i < 20; ++i) ASSERT_OK(hears(late, 3, 10, 3));
  ASSERT_OK(hears(late, 3, 10, 2));
  ASSERT_OK(hears(late, 2, 10));
  ASSERT_STATUS(hears(late, 1, 0), Status::kBusTimeout);
}

/// One wrong sample must not become the place where the arm is held.
void drives_are_not_enabled_from_a_position_that_jumps(void**) {
  ArmOfDrives arm;
  arm.cycles(4, DriveRequest::kArm);
  arm.feedbacks[2].position += 1 << 20;
  arm.cycle(DriveRequest::kArm);
  arm.feedbacks[2].position -= 1 << 20;
  for (int i = 0; i < Drives::kSteady; ++i) {
    arm.cycle(DriveRequest::kArm);
    assert_int_not_equal(arm.commands[0].controlword, 0x000F);
  }
  arm.arm();
}

/// It ends before the time of arming, and says which joint and why.
void positions_that_go_on_jumping_end_arming_with_joint_and_cause(void**) {
  ArmOfDrives arm;
  arm.settings.step_ms = 50;
  constexpr int kJump = 8000;  // 0.002996 rad, of 0.002175 rad at the largest velocity
  for (int i = 0; i < 70; ++i) {
    arm.feedbacks[2].position += i % 2 == 0 ? kJump : -kJump;
    arm.cycle(DriveRequest::kArm);
    assert_int_not_equal(arm.commands[0].controlword, 0x000F);
  }
  ASSERT_STATUS(arm.joint(2).reason, Status::kStateInvalid);
  const Message why = arm.drives.why();
  assert_non_null(std::strstr(why.c_str(), "joint 3: its position jumps by "));
  assert_non_null(std::strstr(why.c_str(), "0.002996"));
  assert_non_null(std::strstr(why.c_str(), "more than it can move, 0.002175 rad, for longer than"));
}

/// The same arm a second time: the time of the first arming is not that of the next.
void drives_that_are_switched_on_at_once_are_armed_again(void**) {
  ArmOfDrives arm;
  arm.settings.step_ms = 20;
  arm.arm();
  arm.cycles(100, DriveRequest::kDisable);
  for (FakeDrive& fake : arm.fakes) fake.word = 0x0233;
  arm.feedbacks[2].position += 1 << 16;
  arm.cycles(1, DriveRequest::kArm);
  arm.arm();
}

void a_drive_that_was_lost_is_named_with_what_was_missed(void**) {
  for (const bool silent : {true, false}) {
    ArmOfDrives arm;
    arm.arm();
    arm.feedbacks[3].lost = silent ? Status::kBusTimeout : Status::kConnectionLost;
    arm.cycle(DriveRequest::kArm);
    const Message why = arm.drives.why();
    assert_non_null(std::strstr(why.c_str(), silent ? "joint 4: its heartbeat is missing; check"
                                                    : "joint 4: it restarted, or left operation"));
  }
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(feedback_that_is_missing_again_and_again_stops_the_arm_as_a_long_gap_does),
      cmocka_unit_test(drives_are_not_enabled_from_a_position_that_jumps),
      cmocka_unit_test(positions_that_go_on_jumping_end_arming_with_joint_and_cause),
      cmocka_unit_test(drives_that_are_switched_on_at_once_are_armed_again),
      cmocka_unit_test(a_drive_that_was_lost_is_named_with_what_was_missed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
