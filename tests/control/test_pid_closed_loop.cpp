// JRG -> PID -> simulated FER with no gravity model: the integral carries the arm.
#include "tests/oracles/kdl.hpp"
#include "tests/support/closed_loop.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr const char* kPidWithoutGravity =
    "tau_c = pid.tau\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pid]\ntype = pid\nq_d = jrg.q_d\nq = robot.q\ndq_d = jrg.dq_d\ndq = robot.dq\n"
    "tau_measured = robot.tau\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"
    "ki = 500 400 400 300 20 20 10\n";

void load(ClosedLoop& loop) {
  loop.blocks = kPidWithoutGravity;
  loop.gains = "";
  loop.plant.friction = 0.0;
  loop.plant.rotor_inertia = JointVector::Constant(0.1);
  ASSERT_OK(loop.start(1000, 1));
}

// Proves PI-4.

void attaching_with_the_measured_torque_moves_nothing(void**) {
  static ClosedLoop loop;
  load(loop);
  ASSERT_OK(loop.run(1.0));
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(loop.hal.arm().q()[j], loop.plant.initial_q[j], 1e-9);
}

// Proves PI-6.

void the_integral_removes_the_steady_error_and_holds_the_weight(void**) {
  static ClosedLoop loop;
  load(loop);
  assert_true(loop.go(0.4, 2.0).ok());
  ASSERT_OK(loop.run(25.0));
  double weight[kDof];
  kdl_gravity(loop.hal.arm().q().data(), {}, weight);
  const auto& tau = *static_cast<const JointVector*>(loop.pipeline.ports.find("pid.tau")->value);
  for (int j = 0; j < kDof; ++j) {
    ASSERT_NEAR(loop.hal.arm().q()[j], loop.plant.initial_q[j] + 0.4, 1e-6);
    ASSERT_NEAR(tau[j], weight[j], 1e-3);
  }
  assert_true(std::fabs(weight[1]) > 10.0);
  assert_int_equal(loop.executive.guard().telemetry().limited_cycles, 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(attaching_with_the_measured_torque_moves_nothing),
      cmocka_unit_test(the_integral_removes_the_steady_error_and_holds_the_weight),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
