// Where the joints are, by the counts of their drives.
#include "tests/hal/cia402/arm_of_drives.hpp"

namespace tactus::cia402 {
namespace {

// Proves CAN-2.
void a_position_outside_the_range_is_refused_with_its_joint(void**) {
  ArmOfDrives arm;
  arm.feedbacks[3].position = 16777216;  // a turn, where the joint has -3.07 to -0.07 rad
  Message why;
  ASSERT_STATUS(arm.drives.attach(CommandMode::kEffort, arm.feedbacks, why),
                Status::kNotReferenced);
  assert_non_null(std::strstr(why.c_str(), "joint 4: its drive counts 16777216 increments"));
}

void a_single_turn_encoder_is_placed_in_the_joints_range(void**) {
  ArmOfDrives arm;
  arm.settings.encoder = Encoder::kSingleTurn;
  const double q = -1.5;
  const double turn = 6.283185307179586;
  arm.feedbacks[3].position = static_cast<std::int32_t>((q + turn) / turn * 16777216.0);
  Message why;
  ASSERT_OK(arm.drives.attach(CommandMode::kPosition, arm.feedbacks, why));
  arm.command.mode = CommandMode::kPosition;
  arm.arm();
  ASSERT_NEAR(arm.state.q[3], q, 1e-6);
  assert_int_equal(arm.commands[3].target_position, arm.feedbacks[3].position);
}

/// A drive that counts from 0 to a turn, in a motion over that edge, there and back.
void a_single_turn_encoder_may_begin_anew_in_a_motion(void**) {
  constexpr std::int32_t kTurn = 16777216, kStep = 3000;
  constexpr double kStep_rad = 6.283185307179586 * kStep / kTurn;
  ArmOfDrives arm(CommandMode::kPosition);
  arm.settings.encoder = Encoder::kSingleTurn;
  std::int32_t& count = arm.feedbacks[0].position;
  count = kTurn - 50 * kStep;
  Message why;
  ASSERT_OK(arm.drives.attach(CommandMode::kPosition, arm.feedbacks, why));
  arm.arm();
  for (int i = 0; i < 400; ++i) {
    const double at = -50 * kStep_rad + kStep_rad * (i < 200 ? i : 400 - i);
    arm.command.value[0] = at;
    for (int j = 1; j < kDof; ++j) arm.command.value[j] = arm.state.q[j];
    arm.cycle(DriveRequest::kFollow);
    ASSERT_NEAR(arm.state.q[0], at, 1e-9);
    assert_true(arm.all(DriveState::kEnabled));
    assert_int_equal(arm.commands[0].target_position, count);
    count = ((count + (i < 200 ? kStep : -kStep)) % kTurn + kTurn) % kTurn;
  }
}

/// The joint's range must say which turn it is.
void more_than_a_turn_of_the_encoder_in_the_range_is_refused(void**) {
  ArmOfDrives arm;
  Message why;
  arm.settings.encoder = Encoder::kSingleTurn;
  arm.settings.gear_ratio[2] = 10.0;
  ASSERT_STATUS(arm.drives.configure(arm.settings, Tool{}, 1000, 10000, why), Status::kBadValue);
  assert_string_equal(
      why.c_str(),
      "joint 3: [cia402] encoder = single_turn knows its place within a turn, 0.628"
      "319 rad with gear_ratio 10, less than the range of the joint, 5.7946 rad; use"
      " multi_turn, or an encoder at the joint (gear_ratio 1)");
  arm.settings.encoder = Encoder::kMultiTurn;
  ASSERT_OK(arm.drives.configure(arm.settings, Tool{}, 1000, 10000, why));
}

void increments_of_a_single_turn_are_whole(void**) {
  ArmOfDrives arm;
  Message why;
  arm.settings.increments[6] = 1.5;
  ASSERT_OK(arm.drives.configure(arm.settings, Tool{}, 1000, 10000, why));
  arm.settings.encoder = Encoder::kSingleTurn;
  ASSERT_STATUS(arm.drives.configure(arm.settings, Tool{}, 1000, 10000, why), Status::kBadValue);
  assert_string_equal(
      why.c_str(), "joint 7: [cia402] increments is 1.5; a single turn has a whole number of them");
}

/// The first target of an enabled drive is where it is.
void positions_are_attached_without_a_step(void**) {
  ArmOfDrives arm(CommandMode::kPosition);
  for (int i = 0; i < 60; ++i) {
    arm.cycle(DriveRequest::kArm);
    for (std::size_t j = 0; j < kDof; ++j)
      assert_int_equal(arm.commands[j].target_position, arm.feedbacks[j].position);
  }
}

/// Without a velocity from the drive, also over cycles without feedback.
void positions_are_differentiated_over_the_time_between_them(void**) {
  ArmOfDrives arm;
  Feedbacks told = arm.feedbacks;
  const auto tell = [&](bool fresh, std::int32_t moved) {
    for (DriveFeedback& feedback : told) {
      feedback.fresh = fresh;
      feedback.position += moved;
    }
    arm.drives.watch(told, 0);
    arm.drives.show(arm.state);
  };
  const double step_rad = 6.283185307179586 / 16777216.0;
  tell(true, 0);
  tell(true, 1000);
  ASSERT_NEAR(arm.state.dq[2], 1000 * step_rad / 1e-3, 1e-9);
  tell(false, 0);
  tell(false, 0);
  tell(true, 3000);
  ASSERT_NEAR(arm.state.dq[2], 1000 * step_rad / 1e-3, 1e-9);
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_position_outside_the_range_is_refused_with_its_joint),
      cmocka_unit_test(a_single_turn_encoder_is_placed_in_the_joints_range),
      cmocka_unit_test(a_single_turn_encoder_may_begin_anew_in_a_motion),
      cmocka_unit_test(more_than_a_turn_of_the_encoder_in_the_range_is_refused),
      cmocka_unit_test(increments_of_a_single_turn_are_whole),
      cmocka_unit_test(positions_are_attached_without_a_step),
      cmocka_unit_test(positions_are_differentiated_over_the_time_between_them),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
