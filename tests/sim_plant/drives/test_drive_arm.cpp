// What the arm offers to the brakes and to drives that compensate gravity.
#include "sim_plant/arm/arm.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// An arm that has fallen for 100 ms, so that every joint moves.
Arm& falling() {
  static Arm arm;
  assert_int_equal(static_cast<int>(arm.load(PlantParams())), 0);
  arm.step(JointVector::Constant(0.5), 0.1);
  return arm;
}

// Proves DRV-5.
void gravity_is_what_holds_the_arm_and_changes_nothing(void**) {
  Arm& arm = falling();
  const JointVector q = arm.q(), dq = arm.dq();
  const JointVector g = arm.gravity();
  assert_true(arm.q() == q && arm.dq() == dq);
  assert_true(dq.norm() > 0.1);
  assert_true((arm.stand() - g).norm() < 1e-12);
}

void held_joints_accelerate_as_told_and_the_others_keep_their_torque(void**) {
  Arm& arm = falling();
  std::array<bool, kDof> held{};
  held[0] = held[3] = held[5] = true;
  JointVector ddq, tau;
  for (int i = 0; i < kDof; ++i) {
    ddq[i] = 3.0 - i;
    tau[i] = 0.3 * i - 1.0;
  }
  const JointVector torque = arm.torque_holding(held, ddq, tau);
  const JointVector before = arm.dq();
  constexpr double kStep_s = 1e-6;
  arm.step(torque, kStep_s);
  const JointVector after = (arm.dq() - before) / kStep_s;
  for (int i = 0; i < kDof; ++i) {
    if (held[static_cast<std::size_t>(i)])
      ASSERT_NEAR(after[i], ddq[i], 1e-3);
    else
      ASSERT_NEAR(torque[i], tau[i], 0.0);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(gravity_is_what_holds_the_arm_and_changes_nothing),
      cmocka_unit_test(held_joints_accelerate_as_told_and_the_others_keep_their_torque),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
