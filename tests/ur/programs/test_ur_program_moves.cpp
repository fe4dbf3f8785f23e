// Tests trajectories of external control: moves, streams, and the events that end them.
#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

void spline_to(ExternalBench& bench, double dq0, double time_s) {
  bench.spline_point(beside(dq0), Joints::Zero(), Joints::Zero(), time_s, 1);
}

void begin(ExternalBench& bench, const ExternalText& text = {}) {
  bench.start(text);
  bench.forward(0);
  bench.run(2);
}

// Proves URP-8.

void moves_come_to_their_targets(void**) {
  static ExternalBench bench;
  begin(bench);
  Vector6 pose = forward(kStart).pose();
  pose[2] += 0.05;
  bench.forward(1, 4);
  bench.move_point(beside(0.3), 0, 1.0, 2.0);
  bench.move_point(kStart, 0, 0.0, 0.0, 1.0);
  bench.move_point(pose, 1, 0.25, 1.2);
  bench.move_point(kStart, 7, 0.25, 1.2);
  assert_int_equal(bench.await_result(), 0);
  assert_joints(bench.target(), kStart, 1e-6);
  bench.forward(1, 1);
  bench.move_point(pose, 6, 1.0, 1.4);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.image().target_tcp_pose[2], pose[2], 1e-6);
}

void a_joint_target_out_of_reach_fails_without_motion(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(1, 1);
  bench.move_point(beside(-123.0), 0, 1.0, 1.0);
  assert_int_equal(bench.await_result(), 2);
  assert_joints(bench.target(), kStart, 0.0);
  assert_true(bench.running());
}

void a_pose_out_of_reach_is_a_protective_stop(void**) {
  static ExternalBench bench;
  begin(bench);
  Vector6 pose = Vector6::Zero();
  pose[0] = 4.0;
  bench.forward(1, 1);
  bench.move_point(pose, 1, 0.25, 1.2);
  bench.run(5);
  assert_int_equal(bench.image().safety_mode, 3);
  assert_false(bench.running());
}

// Proves URP-7.

void a_cancelled_trajectory_brakes_and_says_so(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(1, 2);
  spline_to(bench, 0.5, 1.0);
  spline_to(bench, 1.0, 1.0);
  bench.run(60);
  bench.forward(-1);
  assert_int_equal(bench.await_result(200), 1);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 0.0);
  assert_true(bench.target()[0] < 0.5);
  // The remaining points are not part of the next trajectory.
  const double here = bench.target()[0];
  bench.forward(1, 1);
  spline_to(bench, here + 0.1, 0.5);
  assert_int_equal(bench.await_result(200), 0);
  ASSERT_NEAR(bench.target()[0], here + 0.1, 1e-3);
}

void without_its_line_nothing_is_said(void**) {
  static ExternalBench bench;
  ExternalText text;
  text.cancelled = "";
  begin(bench, text);
  bench.forward(1, 1);
  spline_to(bench, 0.5, 1.0);
  bench.run(60);
  bench.forward(-1);
  assert_int_equal(bench.await_result(200), -1);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 0.0);
}

void a_change_of_mode_cancels(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(1, 1);
  spline_to(bench, 0.5, 1.0);
  bench.run(60);
  bench.reverse(0, ControlMode::kIdle);
  assert_int_equal(bench.await_result(200), 1);
  assert_true(bench.running());
}

void silence_stops_a_trajectory(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.reverse_raw(200, ControlMode::kForward, 1, 1);
  spline_to(bench, 0.5, 2.0);
  bench.run(20);
  assert_true(bench.running());
  bench.run(30);
  assert_false(bench.running());
  assert_int_equal(bench.image().safety_mode, 1);
}

void a_stream_ends_with_the_number_it_names(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(2);
  for (int i = 1; i <= 5; ++i) {
    spline_to(bench, 0.05 * i, 0.2);
    if (i == 3) bench.run(30);
  }
  bench.run(20);
  assert_int_equal(bench.result(), -1);
  bench.forward(3, 5);
  bench.forward(3, 1);  // a second end is ignored
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], 0.25, 1e-3);
}

void a_stream_with_too_few_points_fails(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(3, 5);  // outside a stream
  bench.run(5);
  assert_int_equal(bench.result(), -1);
  bench.forward(2);
  spline_to(bench, 0.05, 0.2);
  bench.forward(3, 2);
  assert_int_equal(bench.await_result(), 2);
}

void points_may_come_before_the_start_and_in_pieces(void**) {
  static ExternalBench bench;
  begin(bench);
  std::uint8_t bytes[84] = {};
  ByteWriter writer(bytes, sizeof bytes);
  const Joints q = beside(0.1);
  for (int i = 0; i < 6; ++i) writer.i32(fixed(q[i]));
  for (int i = 6; i < 18; ++i) writer.i32(0);
  writer.i32(500000);
  writer.i32(1);
  writer.i32(51);
  Link& link = bench.link("trajectory_socket");
  link.receive(bytes, 30);
  bench.forward(1, 1);
  bench.run(10);
  link.receive(bytes + 30, 54);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], 0.1, 1e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(moves_come_to_their_targets),
      cmocka_unit_test(a_joint_target_out_of_reach_fails_without_motion),
      cmocka_unit_test(a_pose_out_of_reach_is_a_protective_stop),
      cmocka_unit_test(a_cancelled_trajectory_brakes_and_says_so),
      cmocka_unit_test(without_its_line_nothing_is_said),
      cmocka_unit_test(a_change_of_mode_cancels),
      cmocka_unit_test(silence_stops_a_trajectory),
      cmocka_unit_test(a_stream_ends_with_the_number_it_names),
      cmocka_unit_test(a_stream_with_too_few_points_fails),
      cmocka_unit_test(points_may_come_before_the_start_and_in_pieces),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
