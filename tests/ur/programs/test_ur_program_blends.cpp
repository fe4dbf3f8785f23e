// Tests blends, movep and movec as programs request them: in a text, and as points of a trajectory.
#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

Vector6 pose_beside(double x, double y, double z) {
  Vector6 pose = forward(kStart).pose();
  pose.head<3>() += Vector3(x, y, z);
  return pose;
}

struct Text {
  std::array<char, 2048> bytes{};
  std::size_t size = 0;

  template <class... Args>
  void line(const char* format, Args... args) {
    const int more = std::snprintf(bytes.data() + size, bytes.size() - size, format, args...);
    size += static_cast<std::size_t>(more);
  }
  /// Writes "name(p[...]" of the given pose.
  void call(const char* name, const Vector6& p) {
    line("  %s(p[%.9f,%.9f,%.9f,%.9f,%.9f,%.9f]", name, p[0], p[1], p[2], p[3], p[4], p[5]);
  }
  std::string_view text() const { return {bytes.data(), size}; }
};

/// Measurements of the tip until the program has ended.
struct Seen {
  double nearest = 1.0;  // distance from a point
  double slowest = 1.0;  // m/s close to it
  int cycles = 0;
};

Seen watch(ProgramBench& bench, const Vector6& point) {
  Seen seen;
  Joints before = bench.image().target_qd;
  for (; seen.cycles < 3000 && bench.running(); ++seen.cycles) {
    bench.tick();
    const double away = (bench.image().target_tcp_pose - point).head<3>().norm();
    seen.nearest = std::min(seen.nearest, away);
    if (away < 0.03)
      seen.slowest = std::min(seen.slowest, bench.image().target_tcp_speed.head<3>().norm());
    assert_true((bench.image().target_qd - before).cwiseAbs().maxCoeff() <= 40.0 * kCycle_s);
    before = bench.image().target_qd;
  }
  assert_int_equal(bench.image().safety_mode, 1);
  return seen;
}

/// Starts two lines with a blend radius of 0.03 m and the given text between them.
void start_lines(ProgramBench& bench, const Vector6& corner, const char* between,
                 const Vector6& end) {
  Text text;
  text.line("def lines():\n");
  text.call("movel", corner);
  text.line(", a=1.2, v=0.25, r=0.03)\n  %s\n", between);
  text.call("movel", end);
  text.line(", a=1.2, v=0.25)\nend\n");
  bench.upload(text.text());
  bench.run(2);
}

// Proves URE-14.

void a_text_blends_and_runs_what_stands_between(void**) {
  static ProgramBench bench;
  const Vector6 corner = pose_beside(0.0, 0.15, 0.0), end = pose_beside(0.0, 0.15, 0.12);
  start_lines(bench, corner, "set_digital_out(3, True)", end);
  assert_true(bench.running());
  assert_int_equal(bench.machine().io.digital_outputs, 0);  // not before the blend
  const Seen seen = watch(bench, corner);
  assert_int_equal(bench.machine().io.digital_outputs, 8);
  assert_true(seen.nearest > 0.005 && seen.nearest < 0.03 && seen.slowest > 0.1);
  assert_true((bench.image().target_tcp_pose - end).head<3>().norm() < 1e-6);
}

void what_takes_time_before_the_next_move_makes_the_arm_stop(void**) {
  static ProgramBench bench;
  const Vector6 corner = pose_beside(0.0, 0.15, 0.0), end = pose_beside(0.0, 0.15, 0.12);
  start_lines(bench, corner, "sleep(1.0)", end);
  assert_true(watch(bench, corner).nearest < 1e-7);
  assert_true((bench.image().target_tcp_pose - end).head<3>().norm() < 1e-6);
}

void the_last_move_is_finished_whatever_its_radius(void**) {
  static ProgramBench bench;
  bench.upload("def last():\n  movej([0.3,-1.2,1.2,-0.1,1.57,0], r=0.05)\nend\n");
  bench.run(2);
  bench.run_to_end();
  ASSERT_NEAR(bench.target()[0], 0.3, 1e-9);
}

void overlapping_blends_are_said_as_c171(void**) {
  static ProgramBench bench;
  Text text;
  text.line("def overlap():\n");
  text.call("movel", pose_beside(0.0, 0.1, 0.0));
  text.line(", r=0.03)\n");
  const Vector6 second = pose_beside(0.0, 0.1, 0.05);
  text.call("movel", second);
  text.line(", r=0.03)\n");
  text.call("movel", pose_beside(0.0, 0.0, 0.05));
  text.line(")\nend\n");
  bench.upload(text.text());
  bench.run(2);
  assert_true(watch(bench, second).nearest < 1e-7);
  constexpr char kCode[] = {0, 0, 0, '\xab', 0, 0, 0, 1};  // 171, 1
  assert_int_equal(bench.said.count({kCode, sizeof kCode}), 1);
}

// Proves URE-15.

void movep_movec_and_servoc_of_a_text(void**) {
  static ProgramBench bench;
  const Vector6 via = pose_beside(0.0, 0.05, 0.05), to = pose_beside(0.0, 0.1, 0.0);
  const Vector6 end = pose_beside(0.0, 0.1, -0.1);
  Text text;
  text.line("def process():\n");
  text.call("movec", via);
  text.line(", p[%.9f,%.9f,%.9f,%.9f,%.9f,%.9f], a=1.2, v=0.1, mode=0)\n", to[0], to[1], to[2],
            to[3], to[4], to[5]);
  text.call("movep", end);
  text.line(", a=1.2, v=0.1)\nend\n");
  bench.upload(text.text());
  bench.run(2);
  const Vector3 center = pose_beside(0.0, 0.05, 0.0).head<3>();
  int on_circle = 0;
  while (bench.running()) {
    bench.tick();
    const Vector3 d = bench.image().target_tcp_pose.head<3>() - center;
    if (d.z() < 1e-9) continue;
    ++on_circle;
    ASSERT_NEAR(d.norm(), 0.05, 1e-6);
  }
  ASSERT_NEAR(on_circle * kCycle_s, 0.05 * 3.14159 / 0.1 + 0.1 / 1.2, 0.1);
  assert_true((bench.image().target_tcp_pose - end).head<3>().norm() < 1e-6);
  Text back;
  back.line("def back():\n");
  back.call("servoc", via);
  back.line(", a=1.2, v=0.1)\nend\n");
  bench.upload(back.text());
  bench.run(2);
  bench.run_to_end();
  assert_true((bench.image().target_tcp_pose - via).head<3>().norm() < 1e-6);
}

// Proves URE-14.

void blend_point(ExternalBench& bench, const Vector6& target, std::int32_t type, double radius) {
  std::array<std::int32_t, 21> ints{};
  for (std::size_t i = 0; i < 6; ++i) ints[i] = fixed(target[static_cast<int>(i)]);
  ints[12] = fixed(0.25);
  ints[13] = fixed(1.2);
  ints[19] = fixed(radius);
  ints[20] = type;
  bench.point(ints);
}

void the_points_of_a_trajectory_are_blended(void**) {
  for (const std::int32_t type : {1, 2}) {
    static ExternalBench bench;
    bench.start();
    bench.forward(0);
    bench.run(2);
    const Vector6 corner = pose_beside(0.0, 0.15, 0.0), end = pose_beside(0.0, 0.15, 0.12);
    bench.forward(1, 3);
    blend_point(bench, corner, type, 0.03);
    blend_point(bench, end, type, 0.02);
    blend_point(bench, kStart, 0, 0.05);  // the last one is not blended
    double nearest = 1.0, slowest = 1.0, nearest_end = 1.0;
    std::int32_t result = -1;
    for (int k = 0; k < 2000 && result < 0; ++k) {
      bench.tick();
      const Vector6& tip = bench.image().target_tcp_pose;
      const double away = (tip - corner).head<3>().norm();
      nearest = std::min(nearest, away);
      nearest_end = std::min(nearest_end, (tip - end).head<3>().norm());
      if (away < 0.03) slowest = std::min(slowest, bench.image().target_tcp_speed.head<3>().norm());
      result = bench.result();
    }
    assert_int_equal(result, 0);
    assert_true(nearest > 0.005 && nearest < 0.03 && slowest > 0.1);
    assert_true(nearest_end > 0.001 && nearest_end < 0.02);
    assert_joints(bench.target(), kStart, 1e-9);
    bench.upload("stop program\n");
    bench.run(5);
  }
}

void a_point_that_is_missing_lets_the_arm_stop_at_the_one_before(void**) {
  static ExternalBench bench;
  bench.start();
  bench.forward(0);
  bench.run(2);
  const Vector6 corner = pose_beside(0.0, 0.15, 0.0);
  bench.forward(1, 2);
  blend_point(bench, corner, 1, 0.03);
  assert_int_equal(bench.await_result(), 2);
  assert_true((bench.image().target_tcp_pose - corner).head<3>().norm() < 1e-6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_text_blends_and_runs_what_stands_between),
      cmocka_unit_test(what_takes_time_before_the_next_move_makes_the_arm_stop),
      cmocka_unit_test(the_last_move_is_finished_whatever_its_radius),
      cmocka_unit_test(overlapping_blends_are_said_as_c171),
      cmocka_unit_test(movep_movec_and_servoc_of_a_text),
      cmocka_unit_test(the_points_of_a_trajectory_are_blended),
      cmocka_unit_test(a_point_that_is_missing_lets_the_arm_stop_at_the_one_before),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
