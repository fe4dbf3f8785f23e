// Tests the modes of a program: force mode, in free air and against a wall that the test simulates
// by pushes; freedrive, in which the arm follows a hand; and the watchdogs of inputs.
#include <random>

#include "kernel/core/text.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {
namespace {

constexpr double kWall = 3000.0;  // N/m

/// Asserts that no joint's target speed changes by more than the acceleration allows.
struct Smooth {
  double most = 8.0;  // rad/s^2
  Joints before = Joints::Zero();
  void tick(ProgramBench& bench) {
    bench.tick();
    const Joints now = bench.image().target_qd;
    assert_true((now - before).cwiseAbs().maxCoeff() <= most * kCycle_s);
    before = now;
  }
};

/// Cycles above a wall below `z`: it pushes the tip up.
void tick_at_wall(ProgramBench& bench, double z, Smooth& smooth, int cycles) {
  for (int k = 0; k < cycles; ++k) {
    const Joints q = bench.machine().body.q();
    const double depth = z - forward(q).p.z();
    Vector6 wrench = Vector6::Zero();
    wrench[2] = kWall * std::max(0.0, depth);
    bench.controller.faults().push = jacobian(q, {}).transpose() * wrench;
    smooth.tick(bench);
  }
}

// Proves URE-16.

void without_contact_the_damping_sets_the_speed(void**) {
  const struct {
    const char* damping;
    double speed;  // w / (d0 + damping d1)
  } kRows[] = {{"", 20.0 / 400.0},
               {"  force_mode_set_damping(0.0)\n", 20.0 / 300.0},
               {"  force_mode_set_damping(1.0)\n", 20.0 / 20300.0},
               {"  force_mode_set_damping(0.025)\n", 20.0 / 800.0}};
  for (const auto& row : kRows) {
    static ProgramBench bench;
    Text<511> lines(row.damping);
    lines << "  "
             "force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,-20,0,0,0],2,[0.1,0.1,0.15,0.3,0.3,0.3])"
             "\n";
    start_and_wait(bench, lines.c_str());
    const Vector6 from = bench.image().target_tcp_pose;
    Smooth smooth;
    for (int k = 0; k < 125; ++k) smooth.tick(bench);
    ASSERT_NEAR(bench.image().target_tcp_speed[2], -row.speed, 0.05 * row.speed + 5e-4);
    // The other axes do not move.
    const Vector6 way = bench.image().target_tcp_pose - from;
    ASSERT_NEAR(way.head<2>().norm(), 0.0, 1e-6);
    ASSERT_NEAR(way.tail<3>().norm(), 0.0, 1e-6);
    bench.upload("stop program\n");
    for (int k = 0; k < 125; ++k) smooth.tick(bench);
    ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 0.0);
    bench.upload("movej([0.0, -1.2, 1.2, -0.1, 1.57, 0.0])\n");
    bench.run(2);
    bench.run_to_end();
    assert_joints(bench.target(), kStart, 1e-9);
    bench.run(100);
  }
}

void beside_a_motion_at_full_speed_the_joints_keep_to_theirs(void**) {
  for (const char* wrench : {"60", "-60"}) {
    static ProgramBench bench;
    Text<255> lines("  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,");
    lines << wrench << ",0,0,0],2,[1,1,0.15,1,1,1])\n  speedj([0,0,0,3.1415,0,0],40,0.3)\n";
    start_and_wait(bench, lines.c_str());
    for (int k = 0; k < 30; ++k) {
      bench.tick();
      assert_true((bench.image().target_qd.cwiseAbs() - MotionLimits().speed).maxCoeff() <= 1e-9);
    }
    bench.run(200);
  }
}

void a_compliant_axis_keeps_to_its_speed_limit(void**) {
  static ProgramBench bench;
  start_and_wait(
      bench, "  force_mode(p[0,0,0,0,0,0],[1,0,0,0,0,1],[80,0,0,0,0,5],2,[0.03,1,1,1,1,0.1])\n");
  Smooth smooth;
  for (int k = 0; k < 200; ++k) {
    smooth.tick(bench);
    assert_true(std::abs(bench.image().target_tcp_speed[0]) <= 0.03 * 1.01);
    assert_true(std::abs(bench.image().target_tcp_speed[5]) <= 0.1 * 1.01);
  }
  ASSERT_NEAR(bench.image().target_tcp_speed[0], 0.03, 1e-4);
  ASSERT_NEAR(bench.image().target_tcp_speed[5], 0.1, 1e-3);
}

void in_contact_the_force_becomes_the_wrench(void**) {
  static ProgramBench bench;
  const double wall = forward(kStart).p.z() - 0.03;
  start_and_wait(bench,
                 "  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,-25,0,0,0],2,[1,1,0.1,1,1,1])\n");
  Smooth smooth;
  tick_at_wall(bench, wall, smooth, 625);
  ASSERT_NEAR(bench.image().actual_tcp_force[2], 25.0, 1.0);
  ASSERT_NEAR(wall - forward(bench.image().actual_q).p.z(), 25.0 / kWall, 1e-3);
  ASSERT_NEAR(bench.image().target_tcp_speed.norm(), 0.0, 1e-3);
  assert_int_equal(bench.image().safety_mode, 1);
  // After the mode has ended, the arm stays in place.
  const Joints here = bench.target();
  bench.upload("stop program\n");
  tick_at_wall(bench, wall, smooth, 125);
  assert_joints(bench.target(), here, 1e-3);
}

void the_task_frame_turns_the_axes(void**) {
  static ProgramBench bench;
  // The frame's x axis is the base's y axis.
  start_and_wait(
      bench,
      "  force_mode(p[0,0,0,0,0,1.5707963],[1,0,0,0,0,0],[20,0,0,0,0,0],2,[0.1,1,1,1,1,1])\n");
  const Vector6 from = bench.image().target_tcp_pose;
  bench.run(100);
  const Vector6 way = bench.image().target_tcp_pose - from;
  assert_true(way[1] > 0.01);
  ASSERT_NEAR(way[0], 0.0, 1e-6);
  ASSERT_NEAR(way[2], 0.0, 1e-6);
}

void type_1_points_to_the_frame_and_type_3_along_the_way(void**) {
  static ProgramBench bench;
  // The origin is straight below the tip, so y points down.
  const Vector3 tip = forward(kStart).p;
  std::array<char, 256> lines;
  std::snprintf(lines.data(), lines.size(),
                "  force_mode(p[%.9f,%.9f,-1,0,0,0],[0,1,0,0,0,0],[0,10,0,0,0,0],1,[1,0.1,1,1,1,1]"
                ")\n",
                tip.x(), tip.y());
  start_and_wait(bench, lines.data());
  bench.run(100);
  Vector6 way = bench.image().target_tcp_pose - forward(kStart).pose();
  assert_true(way[2] < -0.01);
  ASSERT_NEAR(way.head<2>().norm(), 0.0, 1e-5);
  bench.upload("stop program\n");
  bench.run(100);
  // The tip moves along the base's y axis: that is the frame's x, and its y is minus the base's x.
  start_and_wait(bench,
                 "  force_mode(p[0,0,0,0,0,0],[0,1,0,0,0,0],[0,10,0,0,0,0],3,[1,0.1,1,1,1,1])\n"
                 "  speedl([0,0.05,0,0,0,0], 0.5, 1.0)\n");
  const Vector6 from = bench.image().target_tcp_pose;
  bench.run(100);
  way = bench.image().target_tcp_pose - from;
  assert_true(way[0] < -0.005 && way[1] > 0.02);
}

void beside_a_move_the_other_axes_follow_the_program(void**) {
  static ProgramBench bench;
  Vector6 to = forward(kStart).pose();
  to[1] += 0.1;
  std::array<char, 512> lines;
  std::snprintf(lines.data(), lines.size(),
                "  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,10,0,0,0],2,[1,1,0.1,1,1,1])\n"
                "  movel(p[%.9f,%.9f,%.9f,%.9f,%.9f,%.9f], v=0.1)\n  end_force_mode()\n",
                to[0], to[1], to[2], to[3], to[4], to[5]);
  start_and_wait(bench, lines.data());
  Smooth smooth;
  for (int k = 0; k < 250; ++k) smooth.tick(bench);
  const Vector6 end = bench.image().target_tcp_pose;
  ASSERT_NEAR(end[1], to[1], 1e-6);
  ASSERT_NEAR(end[0], to[0], 1e-6);
  assert_true(end[2] - to[2] > 0.01);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
}

void a_tip_that_is_too_far_off_stops_the_arm(void**) {
  static ProgramBench bench;
  start_and_wait(
      bench,
      "  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,0,0,0,0],2,[0.0002,0.0002,0.1,1,1,1])\n");
  bench.run(20);
  assert_int_equal(bench.image().safety_mode, 1);
  bench.controller.faults().push = joints({100, 0, 0, 0, 0, 0});
  bench.run(60);
  assert_int_equal(bench.image().safety_mode, 3);
}

void a_type_that_does_not_exist_is_refused(void**) {
  static ProgramBench bench;
  start_and_wait(bench,
                 "  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,9,0,0,0],4,[1,1,0.1,1,1,1])\n");
  bench.run(5);
  assert_int_equal(bench.image().safety_mode, 3);
}

/// Random frames, axes, wrenches and pushes during a move, begun and ended at random times.
void random_force_modes_never_jump(void**) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    ProgramBench bench;
    start_and_wait(bench, "  movej([0.3,-1.1,1.3,-0.2,1.4,0.2], v=0.3)\n");
    Smooth smooth{12.0};
    for (int k = 0; k < 300; ++k) {
      if (k % 60 == 20) {
        ForceMode mode;
        mode.type = 1 + static_cast<int>(random() % 3);
        for (int i = 0; i < 6; ++i) {
          mode.task_frame[i] = uniform(random);
          mode.selection[i] = random() % 2 == 0 ? 1.0 : 0.0;
          mode.wrench[i] = (i < 3 ? 30.0 : 3.0) * uniform(random);
          mode.limits[i] = i < 3 ? 0.08 : 0.15;
        }
        bench.machine().start_force_mode(mode);
        for (int i = 0; i < 6; ++i) bench.controller.faults().push[i] = 4.0 * uniform(random);
      }
      if (k % 60 == 55) bench.machine().force_mode = {};
      smooth.tick(bench);
      assert_true(
          (bench.image().target_qd.cwiseAbs().array() <= MotionLimits().speed.array()).all());
      assert_int_equal(bench.image().safety_mode, 1);
    }
  }
}

// Proves URE-17.

void in_freedrive_the_arm_yields_and_bears_its_weight(void**) {
  static ProgramBench bench;
  start_and_wait(bench, "  freedrive_mode()\n  sleep(2.0)\n  end_freedrive_mode()\n");
  bench.run(50);
  assert_joints(bench.machine().body.q(), kStart, 1e-6);
  assert_int_equal(bench.image().robot_mode, 7);
  assert_int_equal(bench.image().robot_status_bits & 4u, 4u);
  bench.controller.faults().push = joints({20, 0, 0, 0, 0, 0});
  bench.run(75);
  bench.controller.faults().push.setZero();
  const double pushed = bench.image().actual_q[0] - kStart[0];
  assert_true(pushed > 0.05 && bench.image().actual_qd[0] > 0.05);
  assert_joints(bench.target(), bench.machine().body.q(), 1e-9);
  // The hand lets go while the mode ends: the targets brake from the arm's position.
  bench.controller.faults().push = joints({20, 0, 0, 0, 0, 0});
  Joints before = bench.target(), before_qd = bench.image().target_qd;
  for (int k = 0; k < 200; ++k) {
    if (k == 130) bench.controller.faults().push.setZero();
    bench.tick();
    assert_true((bench.target() - before).cwiseAbs().maxCoeff() < 2.1 * kCycle_s);
    before = bench.target();
    const Joints qd = bench.image().target_qd;
    assert_true((qd - before_qd).cwiseAbs().maxCoeff() < 8.0 * kCycle_s);
    before_qd = qd;
    if (bench.machine().freedrive) assert_joints(qd, bench.image().actual_qd, 1e-9);
  }
  assert_false(bench.machine().freedrive);
  assert_int_equal(bench.image().robot_status_bits & 4u, 0u);
  assert_int_equal(bench.image().safety_mode, 1);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
  assert_joints(bench.image().actual_q, bench.target(), 1e-3);
}

void freedrive_ends_with_its_program(void**) {
  static ProgramBench bench;
  start_and_wait(bench, "  freedrive_mode()\n");
  bench.run(20);
  assert_true(bench.machine().freedrive);
  bench.upload("movej([0.2, -1.2, 1.2, -0.1, 1.57, 0.0])\n");
  bench.run(2);
  assert_false(bench.machine().freedrive);
  bench.run_to_end();
  ASSERT_NEAR(bench.target()[0], 0.2, 1e-9);
}

constexpr char kC207[] = {0, 0, 0, '\xcf', 0, 0, 0, 0};  // code 207, argument 0

void start(ProgramBench& bench, const char* arguments) {
  Text<127> line("  rtde_set_watchdog(");
  start_and_wait(bench, (line << arguments << ")\n").c_str());
  bench.run(2);
  assert_true(bench.running());
}

/// A client writes the register in this cycle.
void kick(ProgramBench& bench) {
  const InputField field = find_input("input_int_register_24", bench.machine().settings.version);
  bench.machine().io.written[field.variable()] = bench.machine().cycle;
}

// Proves URP-13.

void a_kick_in_time_keeps_the_program(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_24\", 10, \"stop\"");
  for (int k = 0; k < 250; ++k) {
    if (k % 12 == 0) kick(bench);
    bench.tick();
    assert_true(bench.running());
  }
  // 0.1 s is twelve cycles and a half.
  kick(bench);
  bench.run(12);
  assert_int_equal(bench.image().safety_mode, 1);
  bench.run(2);
  assert_int_equal(bench.image().safety_mode, 3);
  assert_false(bench.running());
  assert_true(bench.said.has({kC207, sizeof kC207}));
}

void pause_is_what_is_done_without_a_word(void**) {
  for (const char* arguments :
       {"\"input_int_register_24\", 10", "\"input_int_register_24\", 10, action=\"pause\""}) {
    static ProgramBench bench;
    bench.said.size = 0;
    start(bench, arguments);
    bench.run(30);
    assert_true(bench.image().program_paused && !bench.image().program_running);
    assert_int_equal(bench.image().safety_mode, 1);
    assert_int_equal(bench.said.count({kC207, sizeof kC207}), 1);
    // Resumed, it runs until the input has arrived and is late again.
    bench.controller.runner().resume();
    bench.run(30);
    assert_true(bench.running());
    kick(bench);
    bench.run(5);
    assert_true(bench.running());
    bench.run(30);
    assert_true(bench.image().program_paused);
    bench.upload("stop program\n");
    bench.run(2);
  }
}

void a_pause_brakes_the_arm_and_no_more(void**) {
  static ProgramBench bench;
  bench.upload(
      "def moves():\n  rtde_set_watchdog(\"input_int_register_24\", 2, \"pause\")\n"
      "  movej([1.0,-1.2,1.2,-0.1,1.57,0])\nend\n");
  bench.run_s(1.0);
  assert_true(bench.image().program_paused);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
  assert_true(bench.target()[0] > 0.05 && bench.target()[0] < 0.9);
}

void to_ignore_is_to_do_nothing(void**) {
  for (const char* arguments :
       {"\"input_int_register_24\", 10, \"ignore\"", "\"input_int_register_24\", 0, \"stop\""}) {
    static ProgramBench bench;
    start(bench, arguments);
    bench.run(100);
    assert_true(bench.running());
    assert_false(bench.said.has({kC207, sizeof kC207}));
  }
}

void it_ends_with_the_program(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_24\", 10, \"stop\"");
  bench.upload("def other():\n  while True:\n    sync()\n  end\nend\n");
  bench.run(100);
  assert_true(bench.running());
}

void an_input_that_does_not_exist_is_said(void**) {
  static ProgramBench bench;
  start(bench, "\"input_int_register_99\", 10, \"stop\"");
  bench.run(50);
  assert_true(bench.running());
  assert_true(bench.said.has("rtde_set_watchdog: there is no such input"));
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(without_contact_the_damping_sets_the_speed),
      cmocka_unit_test(beside_a_motion_at_full_speed_the_joints_keep_to_theirs),
      cmocka_unit_test(a_compliant_axis_keeps_to_its_speed_limit),
      cmocka_unit_test(in_contact_the_force_becomes_the_wrench),
      cmocka_unit_test(the_task_frame_turns_the_axes),
      cmocka_unit_test(type_1_points_to_the_frame_and_type_3_along_the_way),
      cmocka_unit_test(beside_a_move_the_other_axes_follow_the_program),
      cmocka_unit_test(random_force_modes_never_jump),
      cmocka_unit_test(a_tip_that_is_too_far_off_stops_the_arm),
      cmocka_unit_test(a_type_that_does_not_exist_is_refused),
      cmocka_unit_test(in_freedrive_the_arm_yields_and_bears_its_weight),
      cmocka_unit_test(freedrive_ends_with_its_program),
      cmocka_unit_test(a_kick_in_time_keeps_the_program),
      cmocka_unit_test(pause_is_what_is_done_without_a_word),
      cmocka_unit_test(a_pause_brakes_the_arm_and_no_more),
      cmocka_unit_test(to_ignore_is_to_do_nothing),
      cmocka_unit_test(it_ends_with_the_program),
      cmocka_unit_test(an_input_that_does_not_exist_is_said),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
