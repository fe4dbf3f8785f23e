// The arm behind the emulated drives: brakes, torque, stops and the drives' own loops.
#include "tests/sim_plant/drives/drives_motion.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-5.
void enabling_and_disabling_do_not_move_an_arm_whose_gravity_is_held(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  const JointVector q = bench.arm.arm().q();
  hold_gravity(bench);
  bench.enable();
  double most = 0.0;
  for (int i = 0; i < 400; ++i) {
    bench.cycle();
    most = std::max(most, farthest(bench, q));
  }
  assert_true(all_are(bench, 0xFFFF, 0x1237));
  bench.command_all(0x0007);
  for (int i = 0; i < 200; ++i) {
    bench.cycle();
    most = std::max(most, farthest(bench, q));
  }
  assert_true(all_are(bench, 0xFFFF, 0x0233));
  ASSERT_NEAR(most, 0.0, 2e-4);
  bench.torque.fill(20000);
  const JointVector rest = bench.arm.arm().q();
  bench.cycles(50);
  assert_true(bench.arm.arm().q() == rest);
}

void the_plant_is_the_arm_driven_by_the_commands_of_the_cycle_before(void**) {
  static Arm reference;
  ASSERT_OK(reference.load(PlantParams()));
  DriveArmSettings settings = one_bus();
  settings.brake_release_s = 0.0;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  const JointVector g = reference.gravity();
  hold_gravity(bench);
  bench.enable();
  JointVector tau;
  for (int k = 0; k < 300; ++k) {
    for (int i = 0; i < kDof; ++i) tau[i] = bench.torque[static_cast<std::size_t>(i)] * kLsb_Nm[i];
    swing(bench, g, k);
    bench.cycle();
    reference.step(tau, 1e-3);
    for (int i = 0; i < kDof; ++i) {
      const Feedback& f = bench.feedback[static_cast<std::size_t>(i)];
      ASSERT_NEAR(bench.arm.arm().q()[i], reference.q()[i], 1e-12);
      ASSERT_NEAR(f.position * kIncrement, reference.q()[i], 0.51 * kIncrement);
      ASSERT_NEAR(f.torque * kLsb_Nm[i], tau[i], 0.51 * kLsb_Nm[i]);
    }
  }
  assert_true(reference.dq().norm() > 0.1);
}

void velocity_is_in_increments_per_second(void**) {
  DriveArmSettings settings = one_bus();
  settings.brake_release_s = 0.0;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  bench.enable();
  bench.cycles(40);  // it falls
  for (int i = 0; i < kDof; ++i) {
    const auto velocity = static_cast<std::int32_t>(bench.get(i + 1, 0x606C, 0));
    ASSERT_NEAR(velocity, bench.arm.arm().dq()[i] / kIncrement, 0.51);
  }
}

void one_closed_brake_holds_its_joint_while_the_others_fall(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(200);
  bench.controlword[1] = 0x0000;
  bench.cycle();
  const double q = bench.arm.arm().q()[1];
  bench.torque.fill(0);
  for (int i = 0; i < 100; ++i) {
    bench.cycle();
    ASSERT_NEAR(bench.arm.arm().q()[1], q, 2e-5);
  }
  assert_true(std::abs(bench.arm.arm().dq()[3]) > 0.3);
}

void a_quick_stop_brings_a_falling_arm_to_rest(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(200);
  bench.torque.fill(0);
  bench.cycles(100);
  const double speed = bench.arm.arm().dq().cwiseAbs().maxCoeff();
  assert_true(speed > 0.3);
  const JointVector q = bench.arm.arm().q();
  bench.command_all(0x0002);
  bench.cycles(3);
  assert_true(all_are(bench, 0x6F, 0x07));
  bench.cycles(400);
  assert_true(all_are(bench, 0x4F, 0x40));
  ASSERT_NEAR(bench.arm.arm().dq().norm(), 0.0, 1e-9);
  // By 10 rad/s^2 the way is v^2 / 20; the loops add a little.
  ASSERT_NEAR(farthest(bench, q), speed * speed / 20.0, 0.02);
}

void an_offset_adds_to_the_target_torque_and_both_are_limited(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  bench.put(4, 0x60B2, 0, 500, 2);
  bench.put(4, 0x6072, 0, 2000, 2);
  bench.torque[3] = 1000;
  bench.enable();
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, 1500);
  bench.torque[3] = 1600;
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, 2000);
  assert_int_equal(bench.get(4, 0x6074, 0), 2000);
  assert_int_equal(bench.feedback[3].status & 0x0800, 0x0800);
  bench.torque[3] = -32768;
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, -2000);
}

void drives_that_compensate_gravity_hold_the_arm_with_no_torque(void**) {
  DriveArmSettings settings = one_bus();
  settings.gravity_by_drive = true;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  const JointVector q = bench.arm.arm().q();
  bench.enable();
  bench.cycles(1000);
  assert_true(all_are(bench, 0xFFFF, 0x1237));
  ASSERT_NEAR(farthest(bench, q), 0.0, 1e-5);
}

void a_joint_that_is_too_fast_is_a_fault(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  bench.enable();
  for (int i = 0; i < 2000 && (bench.feedback[3].status & 0x4F) != 0x08; ++i) {
    bench.cycle();
    assert_true(std::abs(bench.arm.arm().dq()[3]) < 3.3);  // 6080h is 30 rpm
  }
  assert_int_equal(bench.get(4, 0x603F, 0), 0x8400);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(enabling_and_disabling_do_not_move_an_arm_whose_gravity_is_held),
      cmocka_unit_test(the_plant_is_the_arm_driven_by_the_commands_of_the_cycle_before),
      cmocka_unit_test(velocity_is_in_increments_per_second),
      cmocka_unit_test(one_closed_brake_holds_its_joint_while_the_others_fall),
      cmocka_unit_test(a_quick_stop_brings_a_falling_arm_to_rest),
      cmocka_unit_test(an_offset_adds_to_the_target_torque_and_both_are_limited),
      cmocka_unit_test(drives_that_compensate_gravity_hold_the_arm_with_no_torque),
      cmocka_unit_test(a_joint_that_is_too_fast_is_a_fault),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
