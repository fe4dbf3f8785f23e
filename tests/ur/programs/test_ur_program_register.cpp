// Tests the register program: its handshake, moves, servoing, force mode and watchdog.
#include "tests/ur/programs/ur_register_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

const Joints kStart = ProgramBench::settings().initial_q;

// Proves URP-10.

void a_blocking_command_is_done_when_the_arm_stands(void**) {
  for (const bool with_offset : {false, true}) {
    static RegisterBench bench;
    bench.start(with_offset);
    bench.command(1, {0.3, -1.2, 1.2, -0.1, 1.57, 0.0, 1.05, 1.4});
    const Joints q = joints({0.3, -1.2, 1.2, -0.1, 1.57, 0.0});
    assert_joints(bench.image().actual_q, q, 1e-3);
    bench.command(1, {0.0, -1.2, 1.2, -0.1, 1.57, 0.0, 1.05, 1.4});
  }
}

void poses_are_moved_to_by_joints_and_on_a_line(void**) {
  static RegisterBench bench;
  bench.start();
  Vector6 pose = forward(kStart).pose();
  pose[2] -= 0.05;
  bench.command(2, {pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], 1.05, 1.4});
  ASSERT_NEAR(bench.image().actual_tcp_pose[2], pose[2], 1e-3);
  pose[2] += 0.08;
  bench.command(3, {pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], 0.25, 1.2});
  ASSERT_NEAR(bench.image().actual_tcp_pose[2], pose[2], 1e-3);
  bench.command(4, {0.0, -1.2, 1.2, -0.1, 1.57, 0.0, 0.25, 1.2});
  assert_joints(bench.image().actual_q, kStart, 1e-3);
}

void servoj_stays_ready_and_stops_softly_at_the_last_target(void**) {
  static RegisterBench bench;
  bench.start();
  double at = 0.0;
  for (int k = 0; k < 125; ++k) {
    at += 0.3 * kCycle_s;
    bench.write(11, {at, -1.2, 1.2, -0.1, 1.57, 0.0, 0.5, 0.5, 0.008, 0.1, 300.0});
    bench.tick();
    assert_int_equal(bench.answer(), 1);
  }
  bench.run(250);  // the client has left
  assert_true(bench.running());
  ASSERT_NEAR(bench.target()[0], at, 1e-3);
  ASSERT_NEAR(bench.image().target_qd[0], 0.0, 1e-3);
  bench.command(16, {10.0});
}

void speedj_is_held_until_it_is_stopped(void**) {
  static RegisterBench bench;
  bench.start();
  bench.write(9, {0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.5, 0.008});
  bench.run(125);
  assert_int_equal(bench.answer(), 1);
  ASSERT_NEAR(bench.image().target_qd[1], 0.2, 1e-9);
  bench.command(15, {10.0});
  ASSERT_NEAR(bench.image().target_qd[1], 0.0, 1e-12);
}

void force_mode_is_ready_at_once_and_its_end_done(void**) {
  static RegisterBench bench;
  bench.start();
  bench.machine().io.input.ints[1] = 2;  // type
  bench.machine().io.input.ints[4] = 1;  // z
  bench.write(6, {0, 0, 0, 0, 0, 0, 0, 0, 10, 0, 0, 0, 0.1, 0.1, 0.1, 1, 1, 1}, 2);
  bench.run(100);
  assert_int_equal(bench.answer(), 1);
  assert_true(bench.image().target_tcp_pose[2] - forward(kStart).p.z() > 0.01);
  bench.command(7);
}

void a_watchdog_that_is_not_fed_ends_the_program(void**) {
  static RegisterBench bench;
  bench.start();
  bench.command(35, {10.0});
  bench.run_s(0.5);
  assert_false(bench.running());
}

/// The text names a register for each offset; the offset decides which one is watched.
void the_watchdog_is_fed_by_the_register_of_the_offset(void**) {
  constexpr std::string_view kWatches =
      "  if reg_offset_int == 0:\n    rtde_set_watchdog(\"input_int_register_0\", hz, \"stop\")\n"
      "  else:\n    rtde_set_watchdog(\"input_int_register_24\", hz, \"stop\")\n  end\n";
  for (const bool with_offset : {false, true}) {
    RegisterBench& bench = *new RegisterBench;
    bench.start(with_offset, kWatches);
    bench.command(35, {10.0});
    const InputField fed =
        find_input(with_offset ? "input_int_register_24" : "input_int_register_0", {});
    for (int k = 0; k < 10; ++k) {
      bench.machine().io.written[fed.variable()] = bench.machine().cycle;
      bench.run(6);
      assert_true(bench.running());
    }
    bench.run(13);
    assert_false(bench.running());
    delete &bench;
  }
}

void command_255_ends_it(void**) {
  static RegisterBench bench;
  bench.start();
  bench.write(255);
  bench.run(3);
  assert_false(bench.running());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_blocking_command_is_done_when_the_arm_stands),
      cmocka_unit_test(poses_are_moved_to_by_joints_and_on_a_line),
      cmocka_unit_test(servoj_stays_ready_and_stops_softly_at_the_last_target),
      cmocka_unit_test(speedj_is_held_until_it_is_stopped),
      cmocka_unit_test(force_mode_is_ready_at_once_and_its_end_done),
      cmocka_unit_test(a_watchdog_that_is_not_fed_ends_the_program),
      cmocka_unit_test(the_watchdog_is_fed_by_the_register_of_the_offset),
      cmocka_unit_test(command_255_ends_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
