// Tests trajectories of external control: moves, streams, and the events that end them; and the
// points of releases of the client library, which put a move's speed at different places in a
// point: the text of the program defines the place.
#include <cmath>

#include "tests/ur/programs/ur_external_bench.hpp"

namespace tactus::ur {
namespace {

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
  assert_spline_succeeds(bench, here + 0.1, 0.5);
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

constexpr std::string_view kOfEachMove =
    "    if raw_point[21] == MOTION_TYPE_MOVEJ:\n"
    "      acceleration = raw_point[13] / MULT_jointstate\n"
    "      velocity = raw_point[7] / MULT_jointstate\n"
    "    elif raw_point[21] == MOTION_TYPE_MOVEC:\n"
    "      acceleration = raw_point[13] / MULT_jointstate\n"
    "      velocity = raw_point[14] / MULT_jointstate\n"
    "    end\n";
constexpr std::string_view kOfAllMoves =
    "    velocity = raw_point[13] / MULT_jointstate\n"
    "    acceleration = raw_point[14] / MULT_jointstate\n"
    "    if raw_point[21] == MOTION_TYPE_MOVEC:\n"
    "      mode = raw_point[15] / MULT_jointstate\n"
    "    end\n";

/// Duration, s, of a trajectory of this one point, which must succeed.
double seconds_for(std::string_view text, const std::array<std::int32_t, 21>& point) {
  static ExternalBench bench;
  ExternalText parts;
  parts.spline = text;
  bench.start(parts);
  bench.forward(1, 1);
  bench.point(point);
  int cycles = 0;
  assert_int_equal(bench.await_result(2000, [&] { ++cycles; }), 0);
  // Returns to the beginning for the next point.
  bench.upload("movej([0.0, -1.2, 1.2, -0.1, 1.57, 0.0], t=1.0)\n");
  bench.run_to_end();
  return cycles * kCycle_s;
}

/// From rest to rest with a trapezoid of speed.
double trapezoid_s(double way, double v, double a) {
  return way > v * v / a ? way / v + v / a : 2.0 * std::sqrt(way / a);
}

void put(std::array<std::int32_t, 21>& point, std::size_t first, double value, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) point[i] = fixed(value);
}

// Proves URP-40.

void a_move_has_its_speed_where_the_text_reads_it(void**) {
  std::array<std::int32_t, 21> point{};
  for (std::size_t i = 0; i < 6; ++i) point[i] = fixed(beside(1.0)[static_cast<int>(i)]);
  put(point, 6, 0.5, 6);
  put(point, 12, 2.0, 6);
  ASSERT_NEAR(seconds_for(kOfEachMove, point), trapezoid_s(1.0, 0.5, 2.0), 0.12);
  put(point, 12, 0.25, 1);
  put(point, 13, 1.0, 1);
  ASSERT_NEAR(seconds_for(kOfAllMoves, point), trapezoid_s(1.0, 0.25, 1.0), 0.12);
  ASSERT_NEAR(seconds_for("", point), trapezoid_s(1.0, 0.25, 1.0), 0.12);
}

void a_circle_has_its_speed_where_the_text_reads_it(void**) {
  const Vector6 from = forward(kStart).pose();
  constexpr double kRadius = 0.05, kHalf = kRadius * 3.14159;
  Vector6 via = from, end = from;
  via[1] += kRadius;
  via[2] += kRadius;
  end[2] += 2.0 * kRadius;
  std::array<std::int32_t, 21> point{};
  for (std::size_t i = 0; i < 6; ++i) {
    point[i] = fixed(end[static_cast<int>(i)]);
    point[6 + i] = fixed(via[static_cast<int>(i)]);
  }
  point[20] = 3;
  put(point, 12, 0.4, 1);
  put(point, 13, 0.1, 1);
  ASSERT_NEAR(seconds_for(kOfAllMoves, point), trapezoid_s(kHalf, 0.4, 0.1), 0.12);
  ASSERT_NEAR(seconds_for(kOfEachMove, point), trapezoid_s(kHalf, 0.1, 0.4), 0.12);
}

void places_outside_a_point_are_those_of_all_moves(void**) {
  std::array<std::int32_t, 21> point{};
  for (std::size_t i = 0; i < 6; ++i) point[i] = fixed(beside(1.0)[static_cast<int>(i)]);
  put(point, 12, 0.25, 1);
  put(point, 13, 1.0, 1);
  for (const std::string_view text :
       {"    velocity = raw_point[0]\n", "    velocity = raw_point[22]\n",
        "    velocity = raw_point[1e300]\n", "    acceleration = raw_point[i]\n"})
    ASSERT_NEAR(seconds_for(text, point), trapezoid_s(1.0, 0.25, 1.0), 0.12);
}

void times_have_the_scale_that_the_text_gives(void**) {
  const Joints goal = beside(0.2);
  for (const bool spline : {false, true}) {
    std::array<std::int32_t, 21> point{};
    for (std::size_t i = 0; i < 6; ++i) point[i] = fixed(goal[static_cast<int>(i)]);
    point[18] = 1500;
    point[19] = spline ? 1 : 0;
    point[20] = spline ? 51 : 0;
    ASSERT_NEAR(seconds_for("  MULT_time = 1000\n", point), 1.5, 0.12);
    point[18] = 1500000;
    ASSERT_NEAR(seconds_for("  MULT_time = 1000000\n", point), 1.5, 0.12);
    ASSERT_NEAR(seconds_for("  MULT_time = 0\n", point), 1.5, 0.12);
  }
}

void a_blend_radius_has_the_scale_of_times(void**) {
  static ExternalBench bench;
  ExternalText parts;
  parts.spline = "  MULT_time = 1000\n";
  bench.start(parts);
  const Vector6 corner = beside(0.4);
  bench.forward(1, 2);
  std::array<std::int32_t, 21> point{};
  for (std::size_t i = 0; i < 6; ++i) point[i] = fixed(corner[static_cast<int>(i)]);
  put(point, 12, 1.0, 1);
  put(point, 13, 1.4, 1);
  point[19] = 50;  // mm
  bench.point(point);
  bench.move_point(kStart, 0, 1.0, 1.4);
  double nearest = 1.0;
  const Vector3 at = forward(corner).pose().head<3>();
  std::int32_t result = -1;
  for (int k = 0; k < 500 && result < 0; ++k) {
    bench.tick();
    nearest = std::min(nearest, (bench.image().target_tcp_pose.head<3>() - at).norm());
    result = bench.result();
  }
  assert_int_equal(result, 0);
  assert_true(nearest > 0.002 && nearest < 0.05);
}

void an_optimove_is_passed_over_with_a_popup(void**) {
  static ExternalBench bench;
  bench.start();
  int popups = 0;
  for (const std::int32_t type : {4, 5, 12, 13}) {
    bench.forward(1, 2);
    bench.move_point(beside(0.2), type, 0.5, 0.5);
    bench.move_point(kStart, 0, 1.0, 1.4);
    assert_int_equal(bench.await_result(), 0);
    assert_joints(bench.target(), kStart, 1e-6);
    assert_int_equal(bench.said.count("5.21"), ++popups);
  }
  assert_true(bench.running());
}

// Proves URP-7.

void points_behind_a_refused_one_are_none_of_the_next_trajectory(void**) {
  static ExternalBench bench;
  bench.start();
  bench.forward(1, 3);
  spline_to(bench, 0.3, 0.0);  // no time: cancelled
  spline_to(bench, 0.4, 1.0);
  spline_to(bench, 0.5, 1.0);
  assert_int_equal(bench.await_result(), 1);
  bench.run(5);
  bench.forward(1, 2);
  spline_to(bench, 0.0, 0.0);
  spline_to(bench, -0.1, 0.5);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], -0.1, 1e-3);
}

void a_point_that_did_not_come_is_not_waited_for(void**) {
  static ExternalBench bench;
  bench.start();
  bench.forward(1, 1);
  assert_int_equal(bench.await_result(), 2);
  assert_spline_succeeds(bench, 0.1, 0.5);
}

void in_motion_a_point_has_a_cycle_more_to_come(void**) {
  static ExternalBench bench;
  ExternalText parts;
  parts.spline = "    write_output_float_register(1, splineTimerTraveled)\n";
  bench.start(parts);
  bench.forward(1, 2);
  Joints dq = Joints::Zero();
  dq[0] = 0.4;
  bench.spline_point(beside(0.2), dq, Joints::Zero(), 1.0, 1);
  while (bench.machine().io.output.doubles[1] < 1.0 - 1e-9) bench.tick();
  bench.tick();  // without it
  spline_to(bench, 0.4, 1.0);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], 0.4, 1e-3);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
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
      cmocka_unit_test(a_move_has_its_speed_where_the_text_reads_it),
      cmocka_unit_test(a_circle_has_its_speed_where_the_text_reads_it),
      cmocka_unit_test(places_outside_a_point_are_those_of_all_moves),
      cmocka_unit_test(times_have_the_scale_that_the_text_gives),
      cmocka_unit_test(a_blend_radius_has_the_scale_of_times),
      cmocka_unit_test(an_optimove_is_passed_over_with_a_popup),
      cmocka_unit_test(points_behind_a_refused_one_are_none_of_the_next_trajectory),
      cmocka_unit_test(a_point_that_did_not_come_is_not_waited_for),
      cmocka_unit_test(in_motion_a_point_has_a_cycle_more_to_come),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
