// Where the joints are, by the counts of their drives.
#include "tests/cia402/arm_of_drives.hpp"

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
      cmocka_unit_test(positions_are_attached_without_a_step),
      cmocka_unit_test(positions_are_differentiated_over_the_time_between_them),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
