// Tests external control: its modes, the lines after its loop, and commands during the motion.
#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

// Proves URP-5.

void speeds_of_joints_and_of_the_tool_are_held(void**) {
  static ExternalBench bench;
  bench.start();
  Vector6 speed = Vector6::Zero();
  speed[1] = 0.2;
  bench.reverse_for(100, ControlMode::kSpeedJ, speed);
  ASSERT_NEAR(bench.image().target_qd[1], 0.2, 1e-9);
  const double z = bench.image().target_tcp_pose[2];
  speed << 0, 0, 0.05, 0, 0, 0;
  bench.reverse_for(125, ControlMode::kSpeedL, speed);
  ASSERT_NEAR(bench.image().target_tcp_speed[2], 0.05, 1e-3);
  ASSERT_NEAR(bench.image().target_tcp_pose[2] - z, 0.05, 0.01);
}

void a_pose_is_reached_by_the_posture_next_to_the_arm(void**) {
  static ExternalBench bench;
  bench.start();
  Vector6 pose = forward(kStart).pose();
  pose[2] += 0.02;
  bench.reverse_for(125, ControlMode::kPose, pose);
  ASSERT_NEAR(bench.image().actual_tcp_pose[2], pose[2], 1e-4);
  assert_true((bench.target() - kStart).norm() < 0.1);
}

void freedrive_begins_and_ends_as_told(void**) {
  static ExternalBench bench;
  bench.start();
  bench.reverse_raw(200, ControlMode::kFreedrive, 1);
  bench.run(2);
  assert_true(bench.machine().freedrive);
  bench.reverse_raw(200, ControlMode::kFreedrive, 0);
  bench.run(2);
  assert_true(bench.machine().freedrive);
  bench.reverse_raw(200, ControlMode::kFreedrive, -1);
  bench.run(2);
  assert_false(bench.machine().freedrive);
  bench.reverse_raw(200, ControlMode::kFreedrive, 1);
  bench.run(2);
  bench.run(40);  // silence
  assert_false(bench.machine().freedrive);
  assert_false(bench.running());
}

// Proves URP-6.

void a_change_of_mode_stops_the_old_motion_first(void**) {
  static ExternalBench bench;
  bench.start();
  stream(bench, 0.0, 0.5, 100);
  bench.reverse(200, ControlMode::kIdle);
  double before = bench.image().target_qd[0];
  for (int k = 0; k < 40; ++k) {
    bench.tick();
    const double now = bench.image().target_qd[0];
    assert_true(now <= before + 1e-12 && before - now <= 4.0 * kCycle_s + 1e-9);
    before = now;
    bench.reverse(200, ControlMode::kIdle);
  }
  ASSERT_NEAR(before, 0.0, 0.0);
  assert_true(bench.running());
  // A set-point close to the arm is accepted again.
  const double here = bench.target()[0];
  bench.reverse_for(50, ControlMode::kServoJ, beside(here + 0.1));
  ASSERT_NEAR(bench.target()[0], here + 0.1, 1e-3);
}

constexpr std::string_view kBehind =
    "  socket_open(\"10.0.0.7\", 4711, \"behind\")\n  sleep(1.0)\n";

void what_stands_behind_the_loop_runs_after_stopped(void**) {
  static ExternalBench bench;
  ExternalText text;
  text.behind = kBehind;
  bench.start(text);
  stream(bench, 0.0, 0.2, 20);
  bench.reverse(100, ControlMode::kStopped);
  bench.run(25);
  assert_true(bench.running());
  assert_int_equal(bench.link("behind").port(), 4711);
  assert_false(bench.connected("reverse_socket"));
  bench.run_s(1.1);
  assert_false(bench.running());
  assert_false(bench.connected("behind"));
}

void after_a_time_out_it_runs_where_the_text_does_not_halt(void**) {
  static ExternalBench bench;
  constexpr std::string_view kSays = "    textmsg(\"Socket timed out waiting for command\")\n",
                             kHalts =
                                 "    textmsg(\"Socket timed out waiting for command\")\n"
                                 "    halt\n";
  for (const std::string_view text : {kSays, kHalts, std::string_view()}) {
    ExternalText parts;
    parts.cancelled = text;
    parts.behind = kBehind;
    bench.start(parts);
    stream(bench, 0.0, 0.2, 20);
    bench.run(25);
    assert_int_equal(bench.running(), text == kSays);
    bench.run_s(1.1);
    assert_false(bench.running());
  }
}

void undefined_fields_of_a_stop_are_not_looked_at(void**) {
  static ExternalBench bench;
  bench.start();
  bench.reverse(100, ControlMode::kStopped, Vector6::Constant(2000.0));
  bench.run(5);
  assert_false(bench.running());
  assert_joints(bench.target(), kStart, 0.0);
}

// Proves URP-12.

void command(ExternalBench& bench, std::initializer_list<double> values, bool raw_first = true) {
  std::array<std::int32_t, 28> ints{};
  std::size_t i = 0;
  for (const double value : values) {
    ints[i] = i == 0 && raw_first ? static_cast<std::int32_t>(value) : fixed(value);
    ++i;
  }
  bench.send("script_command_socket", ints.data(), ints.size());
  bench.run(2);
}

void commands_beside_the_motion_are_obeyed(void**) {
  static ExternalBench bench;
  bench.start();
  command(bench, {1, 3.5, 0.01, -0.02, 0.03});
  ASSERT_NEAR(bench.machine().payload, 3.5, 0.0);
  ASSERT_NEAR(bench.machine().payload_cog[1], -0.02, 1e-12);
  command(bench, {2, 24});
  assert_int_equal(bench.machine().io.tool_voltage, 24);
  command(bench, {10, 0, 0, 0.1, 0, 0, 0.5});
  ASSERT_NEAR(bench.machine().tcp_offset[5], 0.5, 1e-12);
  command(bench, {12, 1.25, 0, 0, 0.04});
  ASSERT_NEAR(bench.machine().payload, 1.25, 0.0);
  command(bench, {3, 0.1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -20, 0, 0, 0, 2, 0.1, 0.1, 0.15});
  assert_true(bench.machine().force_mode.active);
  ASSERT_NEAR(bench.machine().force_mode.task_frame[0], 0.1, 1e-12);
  ASSERT_NEAR(bench.machine().force_mode.selection[2], 1.0, 1e-12);
  ASSERT_NEAR(bench.machine().force_mode.wrench[2], -20.0, 1e-12);
  assert_int_equal(bench.machine().force_mode.type, 2);
  ASSERT_NEAR(bench.machine().force_mode.limits[2], 0.15, 1e-12);
  command(bench, {4});
  assert_false(bench.machine().force_mode.active);
}

void a_contact_is_told_and_so_is_none(void**) {
  static ExternalBench bench;
  std::int32_t answer = -1;
  bench.start();
  command(bench, {5});
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 0);
  command(bench, {6});
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 1);
  assert_int_equal(answer, 1);
  command(bench, {5});
  bench.controller.faults().push = joints({60, 0, 0, 0, 0, 0});
  bench.reverse_for(60, ControlMode::kSpeedJ);
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 1);
  assert_int_equal(answer, 0);
  command(bench, {6});
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 0);
}

void a_contact_ends_a_trajectory_that_says_nothing(void**) {
  static ExternalBench bench;
  std::int32_t answer = -1;
  bench.start();
  command(bench, {6});  // no detection was started
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 1);
  assert_int_equal(answer, 1);
  bench.forward(1, 2);
  for (const double to : {0.3, 0.4})
    bench.spline_point(beside(to), Joints::Zero(), Joints::Zero(), 2.0, 1);
  command(bench, {5});
  bench.controller.faults().push = joints({60, 0, 0, 0, 0, 0});
  bench.run(100);
  assert_int_equal(bench.received("script_command_socket", &answer, 1), 1);
  assert_int_equal(answer, 0);
  bench.reverse(0, ControlMode::kStopped);  // only after the detection has ended
  bench.run(50);
  assert_int_equal(bench.result(), -1);
  assert_true(bench.running());
  command(bench, {6});
  bench.reverse(0, ControlMode::kStopped);
  bench.run(50);
  assert_false(bench.running());
}

// Proves URP-40.

void torques_are_answered_with_a_popup(void**) {
  static ExternalBench bench;
  bench.start();
  bench.reverse_for(50, ControlMode::kTorque, Vector6::Constant(5.0));
  assert_true(bench.running());
  assert_int_equal(bench.said.count("5.23"), 1);
  assert_joints(bench.target(), kStart, 0.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(speeds_of_joints_and_of_the_tool_are_held),
      cmocka_unit_test(a_pose_is_reached_by_the_posture_next_to_the_arm),
      cmocka_unit_test(freedrive_begins_and_ends_as_told),
      cmocka_unit_test(a_change_of_mode_stops_the_old_motion_first),
      cmocka_unit_test(what_stands_behind_the_loop_runs_after_stopped),
      cmocka_unit_test(after_a_time_out_it_runs_where_the_text_does_not_halt),
      cmocka_unit_test(undefined_fields_of_a_stop_are_not_looked_at),
      cmocka_unit_test(commands_beside_the_motion_are_obeyed),
      cmocka_unit_test(a_contact_is_told_and_so_is_none),
      cmocka_unit_test(a_contact_ends_a_trajectory_that_says_nothing),
      cmocka_unit_test(torques_are_answered_with_a_popup),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
