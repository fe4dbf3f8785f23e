// Tests external control with the texts of later releases of the client library, which read and
// answer some messages differently.
#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::string_view kLeftOnly = "      if trajectory_points_left > 0:\n";
constexpr std::string_view kCounts =
    "    elif params[2] == TRAJECTORY_MODE_CANCEL:\n"
    "      trajectory_points_left = n - (STREAMING_SENTINEL - trajectory_points_left)\n"
    "      socket_send_int(TRAJECTORY_RESULT_CANCELED, \"trajectory_socket\")\n";

void begin(ExternalBench& bench, std::string_view line = "", std::string_view cancelled = "") {
  ExternalText text;
  text.spline = line;
  if (!cancelled.empty()) text.cancelled = cancelled;
  bench.start(text);
  bench.forward(0);
  bench.run(2);
}
/// Asserts that no result arrives within these seconds.
void assert_silent(ExternalBench& bench, double seconds) {
  for (int k = 0; k * kCycle_s < seconds; ++k) {
    bench.tick();
    assert_int_equal(bench.result(), -1);
  }
}

// Proves URP-40.

/// The position half way through one second, from rest to (p, v, a) at its end.
double middle(double p, double v, double a, bool quintic) {
  return quintic ? 0.5 * p - 5.0 / 32.0 * v + a / 64.0 : 0.5 * p - 0.125 * v;
}

void a_spline_has_its_rates_by_the_scale_in_the_text(void**) {
  for (const bool quintic : {false, true})
    for (const double scale : {1e6, 1e8}) {
      static ExternalBench bench;
      begin(bench, scale > 1e6 ? "  MULT_velacc = 100000000\n" : "");
      const double from = bench.target()[0];
      Joints dq = Joints::Zero(), ddq = Joints::Zero();
      dq[0] = 0.5 * scale / 1e6;
      ddq[0] = 1.0 * scale / 1e6;
      bench.forward(1, 2);
      bench.spline_point(beside(from + 0.25), dq, ddq, 1.0, quintic ? 2 : 1);
      spline_to(bench, from + 0.5, 1.0);
      bench.run_s(0.5);
      ASSERT_NEAR(bench.target()[0] - from, middle(0.25, 0.5, 1.0, quintic), 0.01);
      assert_int_equal(bench.await_result(), 0);
      ASSERT_NEAR(bench.target()[0] - from, 0.5, 1e-3);
    }
}

// Proves URE-15, URP-40.

void a_circle_goes_through_joints_and_poses(void**) {
  static ExternalBench bench;
  begin(bench);
  constexpr struct {
    std::int32_t type;
    bool end_is_joints, via_is_joints;  // the end comes first in the name of the type
  } kTypes[] = {{3, false, false}, {9, true, true}, {10, true, false}, {11, false, true}};
  for (const auto& [type, end_is_joints, via_is_joints] : kTypes) {
    const Joints q = bench.target();
    const Vector6 from = forward(q).pose();
    Vector6 via = from, end = from;
    via[1] += 0.05;
    via[2] += 0.05;
    end[2] += 0.1;
    const Vector3 center = from.head<3>() + Vector3(0.0, 0.0, 0.05);
    Joints end_q, via_q;
    assert_true(inverse(Frame::of(end), {}, q, end_q) && inverse(Frame::of(via), {}, q, via_q));
    std::array<std::int32_t, 21> point{};
    for (std::size_t i = 0; i < 6; ++i) {
      const int k = static_cast<int>(i);
      point[i] = fixed(end_is_joints ? end_q[k] : end[k]);
      point[6 + i] = fixed(via_is_joints ? via_q[k] : via[k]);
    }
    point[12] = fixed(0.1);
    point[13] = fixed(0.5);
    point[20] = type;
    bench.forward(1, 1);
    bench.point(point);
    double nearest = 1.0;
    const auto watch = [&] {
      const Vector3 tip = bench.image().target_tcp_pose.head<3>();
      nearest = std::min(nearest, (tip - via.head<3>()).norm());
      ASSERT_NEAR((tip - center).norm(), 0.05, 2e-5);
    };
    assert_int_equal(bench.await_result(1000, watch), 0);
    assert_true(nearest < 2e-3);
    assert_true((bench.image().target_tcp_pose - end).head<3>().norm() < 1e-4);
    bench.forward(1, 1);
    bench.move_point(kStart, 0, 1.0, 2.0);
    assert_int_equal(bench.await_result(), 0);
  }
}

void a_point_of_an_unknown_type_is_passed_over(void**) {
  static ExternalBench bench;
  begin(bench);
  double to = 0.0;
  for (const std::int32_t type : {-1, 14, 50, 52, 1 << 30}) {
    to += 0.05;
    bench.forward(1, 3);
    bench.move_point(beside(-1.0), type, 1.0, 1.0);
    bench.move_point(beside(to), 0, 1.0, 2.0);
    bench.move_point(beside(-1.0), type, 1.0, 1.0);
    assert_int_equal(bench.await_result(), 0);
    ASSERT_NEAR(bench.target()[0], to, 1e-6);
  }
}

// Proves URP-7.

void left_on_its_last_point_a_trajectory_says_nothing(void**) {
  static ExternalBench bench;
  begin(bench, kLeftOnly);
  bench.forward(1, 1);
  spline_to(bench, 0.5, 1.0);
  bench.run(60);
  bench.reverse(0, ControlMode::kIdle);
  assert_silent(bench, 1.0);
  assert_true(bench.target()[0] < 0.4);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 0.0);
}

void on_the_first_of_two(ExternalBench& bench) {
  begin(bench, kLeftOnly);
  bench.forward(1, 2);
  spline_to(bench, 0.5, 1.0);
  spline_to(bench, 0.6, 1.0);
  bench.run(60);
}

void left_with_points_to_come_it_says_cancelled(void**) {
  static ExternalBench bench;
  on_the_first_of_two(bench);
  bench.reverse(0, ControlMode::kIdle);
  assert_int_equal(bench.await_result(100), 1);
  // The result is the same if a point was refused and more points follow it.
  bench.forward(1, 2);
  spline_to(bench, 0.9, 0.0);
  spline_to(bench, 0.6, 1.0);
  assert_int_equal(bench.await_result(), 1);
  bench.reverse(0, ControlMode::kIdle);
  assert_int_equal(bench.await_result(100), 1);
}

void stopped_it_says_cancelled_before_the_program_goes_on(void**) {
  static ExternalBench bench;
  on_the_first_of_two(bench);
  bench.reverse(100, ControlMode::kStopped);
  assert_int_equal(bench.await_result(100), 1);
}

void a_start_behind_a_cancel_waits_for_its_answer(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(1, 1);
  spline_to(bench, 0.5, 1.0);
  bench.run(60);
  bench.forward(-1);
  bench.forward(1, 1);
  spline_to(bench, 0.0, 1.0);
  assert_int_equal(bench.await_result(), 1);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], 0.0, 1e-3);
}

void a_start_breaks_off_the_move_before_it(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(1, 1);
  bench.move_point(beside(1.0), 0, 0.5, 1.0);
  bench.run(125);
  bench.forward(1, 1);
  bench.move_point(kStart, 0, 1.0, 2.0);
  double farthest = 0.0;
  const auto watch = [&] { farthest = std::max(farthest, bench.target()[0]); };
  assert_int_equal(bench.await_result(1000, watch), 0);
  assert_true(farthest < 0.6);
  assert_joints(bench.target(), kStart, 1e-6);
}

void a_stream_cancelled_without_a_number_is_read_away_until_it_is_silent(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(2);
  spline_to(bench, 0.2, 1.0);
  bench.run(30);
  bench.forward(-1);
  assert_silent(bench, 0.4);
  spline_to(bench, 0.9, 1.0);  // late, and not the next trajectory's
  assert_silent(bench, 0.4);
  assert_int_equal(bench.await_result(50), 1);
  assert_spline_succeeds(bench, 0.0, 1.0);
}

void a_stream_cancelled_with_its_number_is_read_away_so_far(void**) {
  static ExternalBench bench;
  begin(bench, "", kCounts);
  bench.forward(2);
  for (const double to : {0.1, 0.2, 0.3}) spline_to(bench, to, 1.0);
  bench.run(30);
  bench.forward(-1, 3);
  assert_int_equal(bench.await_result(40), 1);
  assert_spline_succeeds(bench, 0.0, 1.0);
}

/// The read that failed counts as a point.
void the_end_of_a_stream_that_failed_says_what_is_left_of_it(void**) {
  static ExternalBench bench;
  begin(bench);
  bench.forward(2);
  spline_to(bench, 0.1, 0.5);
  assert_int_equal(bench.await_result(), 2);
  for (const double to : {0.7, 0.8}) spline_to(bench, to, 1.0);
  bench.forward(3, 4);
  bench.forward(1, 1);
  bench.run(2);
  spline_to(bench, 0.0, 1.0);
  assert_int_equal(bench.await_result(), 0);
  ASSERT_NEAR(bench.target()[0], 0.0, 1e-3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_spline_has_its_rates_by_the_scale_in_the_text),
      cmocka_unit_test(a_circle_goes_through_joints_and_poses),
      cmocka_unit_test(a_point_of_an_unknown_type_is_passed_over),
      cmocka_unit_test(left_on_its_last_point_a_trajectory_says_nothing),
      cmocka_unit_test(left_with_points_to_come_it_says_cancelled),
      cmocka_unit_test(stopped_it_says_cancelled_before_the_program_goes_on),
      cmocka_unit_test(a_start_behind_a_cancel_waits_for_its_answer),
      cmocka_unit_test(a_start_breaks_off_the_move_before_it),
      cmocka_unit_test(a_stream_cancelled_without_a_number_is_read_away_until_it_is_silent),
      cmocka_unit_test(a_stream_cancelled_with_its_number_is_read_away_so_far),
      cmocka_unit_test(the_end_of_a_stream_that_failed_says_what_is_left_of_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
