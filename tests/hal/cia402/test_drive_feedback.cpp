// What is made of feedback that is missing, late, impossible or the last of a drive.
#include <algorithm>
#include <limits>

#include "tests/hal/cia402/arm_of_drives.hpp"

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

// Proves CAN-18.

constexpr double kIncrements_per_rad = 16777216.0 / 6.283185307179586;

void put_position(ArmOfDrives& arm, std::size_t j, double moved_rad, std::int32_t from) {
  arm.feedbacks[j].position = from + static_cast<std::int32_t>(moved_rad * kIncrements_per_rad);
}

/// In the cycle of the sample, with the figures, in both directions.
void a_position_that_jumps_while_the_arm_is_enabled_stops_it(void**) {
  for (const double jump_rad : {0.577, -0.577, 0.0098, -0.0098}) {
    ArmOfDrives arm;
    arm.settings.hold_tolerance = 1.0;
    arm.arm();
    put_position(arm, 2, jump_rad, arm.feedbacks[2].position);
    arm.cycle(DriveRequest::kFollow);
    const bool possible = std::abs(jump_rad) < 4.0 * JointLimits{}.dq_max[2] * 1e-3;
    ASSERT_STATUS(arm.joint(2).reason, possible ? Status::kOk : Status::kStateInvalid);
    if (possible) continue;
    assert_non_null(std::strstr(arm.drives.why().c_str(), "joint 3: its position jumps by "));
    for (const DriveCommand& command : arm.commands) assert_int_equal(command.target_torque, 0);
  }
}

/// A joint that swings to and fro at `most_rad_s`, whose drive tells `told` of its velocity,
/// `late_s` late. Returns the cycles until it is stopped, or -1.
int stopped_after(double told, double late_s, double noise_rad_s = 0.0, double most_rad_s = 2.0) {
  ArmOfDrives arm;
  arm.settings.hold_tolerance = 3.0;
  arm.measures_velocity = true;
  arm.arm();
  const std::int32_t from = arm.feedbacks[0].position;
  const double rate = most_rad_s < 1.0 ? 1.0 : 10.0, swing_rad = most_rad_s / rate;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    put_position(arm, 0, swing_rad * std::sin(rate * t), from);
    const double dq = most_rad_s * std::cos(rate * std::max(t - late_s, 0.0));
    const double noise = i % 2 == 0 ? noise_rad_s : -noise_rad_s;
    constexpr double kMost = std::numeric_limits<std::int32_t>::max();
    arm.feedbacks[0].velocity = static_cast<std::int32_t>(
        std::clamp((told * dq + noise) * kIncrements_per_rad, -kMost, kMost));
    arm.cycle(DriveRequest::kFollow);
    if (arm.joint(0).reason == Status::kOk) continue;
    ASSERT_STATUS(arm.joint(0).reason, Status::kStateInvalid);
    assert_non_null(
        std::strstr(arm.drives.why().c_str(), "its velocities of the last 50 ms add up to "));
    return i;
  }
  return -1;
}

void a_velocity_that_is_not_the_rate_of_the_positions_stops_the_arm_within_50_ms(void**) {
  for (const double told : {0.0, -1.0, 1.0 / 60.0, 60.0, 2.0, 16777216.0 / 60.0}) {
    const int cycles = stopped_after(told, 0.0);
    assert_true(cycles >= 0 && cycles < 50);
  }
  const int slowly = stopped_after(0.0, 0.0, 0.0, 0.3);
  assert_true(slowly >= 0 && slowly < 150);
  assert_int_equal(stopped_after(1.0, 0.0), -1);
  assert_int_equal(stopped_after(1.0, 0.004), -1);  // a filter of the drive
  assert_int_equal(stopped_after(1.0, 0.002, 0.2), -1);
  assert_int_equal(stopped_after(0.9, 0.0), -1);
}

/// Not while the brakes open, and not for less than the time that is allowed.
void a_drive_that_goes_on_limiting_its_command_stops_the_arm(void**) {
  for (const int allowed_ms : {50, 10, 0}) {
    ArmOfDrives arm;
    arm.settings.limited_ms = allowed_ms;
    arm.arm();
    arm.cycles(100, DriveRequest::kFollow);
    int lasted = 0;
    for (; lasted < 1000 && arm.joint(3).reason == Status::kOk; ++lasted) {
      arm.fake(3).word |= kInternalLimit;
      arm.cycle(DriveRequest::kFollow);
      arm.fake(3).word &= static_cast<std::uint16_t>(~kInternalLimit);
    }
    assert_int_equal(lasted, allowed_ms > 0 ? allowed_ms + 1 : 1000);
    if (allowed_ms == 0) continue;
    ASSERT_STATUS(arm.joint(3).reason, Status::kDriveFault);
    assert_non_null(std::strstr(arm.drives.why().c_str(), "(statusword bit 11) for "));
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
      cmocka_unit_test(a_position_that_jumps_while_the_arm_is_enabled_stops_it),
      cmocka_unit_test(a_velocity_that_is_not_the_rate_of_the_positions_stops_the_arm_within_50_ms),
      cmocka_unit_test(a_drive_that_goes_on_limiting_its_command_stops_the_arm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
