// Seven drives as one robot: armed together or not at all, stopped together, by any of them.
#include "tests/hal/cia402/arm_of_drives.hpp"

namespace tactus::cia402 {
namespace {

bool any_torque(const ArmOfDrives& arm) {
  for (const DriveCommand& command : arm.commands)
    if (command.target_torque != 0) return true;
  return false;
}

// Proves CAN-3.
void no_drive_is_enabled_before_all_are_switched_on(void**) {
  ArmOfDrives arm;
  arm.fake(3).stays = true;
  for (int i = 0; i < 100; ++i) {
    arm.cycle(DriveRequest::kArm);
    for (const FakeDrive& fake : arm.fakes) assert_int_not_equal(fake.word, 0x1237);
    assert_false(any_torque(arm));
  }
  arm.fake(3).stays = false;
  arm.cycles(4, DriveRequest::kArm);
  for (const FakeDrive& fake : arm.fakes) assert_int_equal(fake.word, 0x1237);
}

void arming_holds_the_arm_with_its_weight_before_it_is_told(void**) {
  ArmOfDrives arm;
  arm.arm();
  assert_int_equal(arm.drives.phase(), ArmingPhase::kArmed);
  const JointVector g = gravity<Robot>(joint_trig<Robot>(arm.state.q), Tool{});
  for (int j = 0; j < kDof; ++j) {
    const double step = j < 4 ? 3e-3 : 0.5e-3;
    ASSERT_NEAR(arm.commands[static_cast<std::size_t>(j)].target_torque * step, g[j], step);
  }
}

/// The torque comes with the robot's torque rate, while the brakes are closed.
void the_torque_of_the_hold_has_no_step(void**) {
  ArmOfDrives arm;
  DriveCommands before{};
  for (int i = 0; i < 100; ++i) {
    arm.cycle(DriveRequest::kArm);
    for (std::size_t j = 0; j < kDof; ++j)
      assert_in_range(arm.commands[j].target_torque - before[j].target_torque + 2001, 0,
                      j < 4 ? 2001 + 335 : 4002);
    before = arm.commands;
  }
}

void commands_are_followed_only_when_armed(void**) {
  ArmOfDrives arm;
  arm.command.value.setConstant(6.0);
  arm.cycles(3, DriveRequest::kFollow);
  assert_false(any_torque(arm));
  arm.arm();
  arm.cycle(DriveRequest::kFollow);
  assert_int_equal(arm.commands[0].target_torque, 2000);
  assert_int_equal(arm.commands[6].target_torque, 12000);
}

/// Every way in which one drive can leave "operation enabled".
void one_drive_that_stops_stops_all_of_them_in_the_same_cycle(void**) {
  for (const int word : {0x0218, 0x0250, 0x0231, 0x0233, 0x0217, 0x021F, 0x0000, 0x0004, 0xFFFF}) {
    ArmOfDrives arm;
    arm.arm();
    arm.command.value.setConstant(1.0);
    arm.cycle(DriveRequest::kFollow);
    arm.fake(4).word = static_cast<std::uint16_t>(word);
    arm.fake(4).stays = true;
    arm.feedbacks[4].error_code = 0x7305;
    arm.cycle(DriveRequest::kFollow);
    assert_false(any_torque(arm));
    for (std::size_t j = 0; j < kDof; ++j)
      if (j != 4) assert_int_equal(arm.commands[j].controlword, 0x0002);
    assert_int_equal(arm.joint(4).state, DriveState::kFault);
    ASSERT_STATUS(arm.joint(4).reason, Status::kDriveFault);
    assert_int_equal(arm.joint(4).code, 0x7305);
    for (int i = 0; i < 50; ++i) {
      arm.cycle(DriveRequest::kFollow);
      assert_false(any_torque(arm));
      for (const DriveCommand& command : arm.commands)
        assert_int_equal(command.controlword & 0x0008, 0);
    }
  }
}

void after_a_fault_only_a_new_arming_leads_up(void**) {
  ArmOfDrives arm;
  arm.arm();
  arm.fake(0).word = 0x0218;
  arm.cycles(50, DriveRequest::kFollow);
  arm.cycles(50, DriveRequest::kArm);
  assert_int_equal(arm.drives.phase(), ArmingPhase::kFailed);
  arm.cycles(5, DriveRequest::kDisable);
  assert_true(arm.joint(0).state == DriveState::kFault);
  assert_true(arm.joint(1).state == DriveState::kDisabled);
  arm.arm();
}

void a_drive_that_is_silent_is_bridged_and_then_lost(void**) {
  ArmOfDrives arm;
  arm.arm();
  arm.told = false;
  for (int i = 0; i < arm.settings.max_missed; ++i) {
    arm.cycle(DriveRequest::kFollow);
    assert_true(arm.all(DriveState::kEnabled));
    assert_true(arm.joint(0).valid);
  }
  arm.cycle(DriveRequest::kFollow);
  assert_int_equal(arm.joint(0).state, DriveState::kFault);
  ASSERT_STATUS(arm.joint(0).reason, Status::kBusTimeout);
  assert_false(arm.joint(0).valid);
}

void the_age_of_the_state_is_that_of_the_oldest_joint(void**) {
  ArmOfDrives arm;
  arm.cycle(DriveRequest::kDisable);
  const std::int64_t heard_ns = arm.state.stamp_ns;
  Feedbacks some = arm.feedbacks;
  for (DriveFeedback& feedback : some) feedback.fresh = true;
  some[5].fresh = false;
  arm.drives.watch(some, heard_ns + 1'000'000);
  arm.drives.show(arm.state);
  assert_true(arm.state.stamp_ns == heard_ns);
}

void a_torque_at_the_end_of_its_numbers_is_no_measurement(void**) {
  for (const std::int16_t torque : {std::int16_t{32767}, std::int16_t{-32768}}) {
    ArmOfDrives arm;
    arm.arm();
    arm.feedbacks[1].torque = torque;
    arm.cycle(DriveRequest::kFollow);
    assert_false(arm.joint(1).valid);
    assert_true(arm.joint(2).valid);
  }
}

void a_command_that_is_not_finite_stops_the_drives(void**) {
  ArmOfDrives arm;
  arm.arm();
  arm.command.value.setConstant(1.0);
  arm.command.value[2] = std::nan("");
  arm.cycle(DriveRequest::kFollow);
  assert_false(any_torque(arm));
  arm.cycle(DriveRequest::kFollow);
  ASSERT_STATUS(arm.joint(2).reason, Status::kCommandNotFinite);
}

void an_error_message_of_an_enabled_drive_stops_all(void**) {
  ArmOfDrives arm;
  arm.arm();
  arm.feedbacks[6].emergency = true;
  arm.feedbacks[6].error_code = 0x4310;
  arm.cycle(DriveRequest::kFollow);
  assert_int_equal(arm.joint(6).code, 0x4310);
  assert_non_null(
      std::strstr(arm.drives.why().c_str(), "joint 7: excess temperature of the drive"));
  assert_non_null(std::strstr(arm.drives.why().c_str(), "4310h"));
}

void a_drive_without_its_reference_is_refused(void**) {
  ArmOfDrives arm;
  arm.settings.referenced_bit = 14;
  arm.cycle(DriveRequest::kArm);
  arm.cycle(DriveRequest::kArm);
  ASSERT_STATUS(arm.joint(0).reason, Status::kNotReferenced);
  assert_int_equal(arm.joint(0).state, DriveState::kFault);
}

void a_torque_limit_beyond_the_drives_numbers_is_refused(void**) {
  ArmOfDrives arm;
  arm.settings.rated_torque[1] = 2.0;
  Message why;
  ASSERT_STATUS(arm.drives.configure(arm.settings, Tool{}, 1000, 10000, why), Status::kBadValue);
  assert_non_null(std::strstr(why.c_str(),
                              "joint 2: [cia402] rated_torque is 2 N m, of which 32767 permille are"
                              " 65.534 N m, less than the joint's torque limit of 87 N m"));
}

/// Moves joint 2 by `increments` a cycle, in `cycles`, while it is held.
void move_held(ArmOfDrives& arm, int increments, int cycles) {
  for (int i = 0; i < cycles; ++i) {
    arm.feedbacks[1].position += increments;
    arm.cycle(DriveRequest::kArm);
  }
}

/// A motor with the wrong sign drives its joint away from where it is held. A spring of 200 N m/rad
/// and a damper of 10 N m s/rad push as at 0.05 rad; slowly, that is at 0.05 rad.
void a_joint_that_moves_while_it_is_held_stops_all_drives(void**) {
  constexpr double kRad = 2.0 * M_PI / 16777216.0;
  for (const int increments : {10, 100, 1000, -1000}) {
    ArmOfDrives arm;
    arm.arm();
    const double step_rad = std::abs(increments) * kRad;
    const int within = static_cast<int>((0.05 - 0.05 * step_rad / 1e-3) / step_rad);
    move_held(arm, increments, within - 1);
    assert_true(arm.all(DriveState::kEnabled));
    move_held(arm, increments, 2);
    assert_false(any_torque(arm));
    ASSERT_STATUS(arm.joint(1).reason, Status::kMoved);
    const Message why = arm.drives.why();
    assert_non_null(std::strstr(
        why.c_str(), increments > 0 ? "joint 2: moves by 0.05" : "joint 2: moves by -0.05"));
    assert_non_null(std::strstr(why.c_str(), "more than [cia402] hold_tolerance, 0.05 rad; check"));
    for (const DriveCommand& command : arm.commands) assert_int_equal(command.controlword, 0x0002);
  }
}

void a_held_joint_that_comes_back_fast_is_not_refused(void**) {
  ArmOfDrives arm;
  arm.arm();
  for (int i = 0; i < 20; ++i) {
    move_held(arm, 200, 400);  // 0.03 rad at 0.075 rad/s, and back at 2.1
    move_held(arm, -5600, 14);
    move_held(arm, -200, 8);
  }
  assert_true(arm.all(DriveState::kEnabled));
}

/// What moved it would move it on, a little farther in every arming.
void an_arm_that_has_moved_while_it_was_held_is_not_enabled_again(void**) {
  ArmOfDrives arm;
  arm.arm();
  for (int i = 0; i < 14; ++i) {  // the last seven until the brakes hold
    arm.feedbacks[1].position += 20000;
    arm.cycle(DriveRequest::kArm);
  }
  ASSERT_STATUS(arm.joint(1).reason, Status::kMoved);
  for (int again = 0; again < 3; ++again) {
    arm.cycles(100, DriveRequest::kDisable);
    for (int i = 0; i < 300; ++i) {
      arm.cycle(DriveRequest::kArm);
      for (const DriveCommand& command : arm.commands) assert_true(command.controlword != 0x000F);
    }
    ASSERT_STATUS(arm.joint(1).reason, Status::kMoved);
    assert_non_null(std::strstr(arm.drives.why().c_str(),
                                "joint 2: left its place while it was held, is 0.1048"));
  }
}

void arming_does_not_end_while_the_bus_asks_its_drives(void**) {
  ArmOfDrives arm;
  arm.answers = false;
  arm.cycles(200, DriveRequest::kArm);
  assert_true(arm.all(DriveState::kArming));
  arm.answers = true;
  arm.cycles(kDof + 2, DriveRequest::kArm);
  assert_true(arm.all(DriveState::kEnabled));
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_drive_is_enabled_before_all_are_switched_on),
      cmocka_unit_test(arming_holds_the_arm_with_its_weight_before_it_is_told),
      cmocka_unit_test(the_torque_of_the_hold_has_no_step),
      cmocka_unit_test(commands_are_followed_only_when_armed),
      cmocka_unit_test(one_drive_that_stops_stops_all_of_them_in_the_same_cycle),
      cmocka_unit_test(after_a_fault_only_a_new_arming_leads_up),
      cmocka_unit_test(a_drive_that_is_silent_is_bridged_and_then_lost),
      cmocka_unit_test(the_age_of_the_state_is_that_of_the_oldest_joint),
      cmocka_unit_test(a_torque_at_the_end_of_its_numbers_is_no_measurement),
      cmocka_unit_test(a_command_that_is_not_finite_stops_the_drives),
      cmocka_unit_test(an_error_message_of_an_enabled_drive_stops_all),
      cmocka_unit_test(a_drive_without_its_reference_is_refused),
      cmocka_unit_test(a_joint_that_moves_while_it_is_held_stops_all_drives),
      cmocka_unit_test(a_held_joint_that_comes_back_fast_is_not_refused),
      cmocka_unit_test(an_arm_that_has_moved_while_it_was_held_is_not_enabled_again),
      cmocka_unit_test(arming_does_not_end_while_the_bus_asks_its_drives),
      cmocka_unit_test(a_torque_limit_beyond_the_drives_numbers_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
