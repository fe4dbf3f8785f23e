// Tests the register program: its handshake, moves, servoing, force mode and watchdog; and motions
// of more than one move: paths, jogging, servoc, and the progress of asynchronous motions.
#include "tests/ur/programs/ur_register_bench.hpp"

namespace tactus::ur {
namespace {

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

// The texts' reports of progress: before 2022, and since.
constexpr std::string_view kValue = "  thread move_thread():\n  end\n";
constexpr std::string_view kCounted =
    "  global async_op_id = 0\n  thread move_thread():\n  end\n"
    "  thread stop_thread():\n  end\n";

/// The register since 2022: operation from bit 24, writes from bit 16, running in bit 15.
std::int32_t counted(std::int32_t operation, std::int32_t writes, std::int32_t running,
                     std::int32_t progress) {
  return operation * 0x1000000 + writes * 0x10000 + running * 0x8000 + progress;
}

constexpr std::string_view kPath =
    "  def exec_move_path():\n"
    "    # three points\n"
    "\tsignal_async_progress(0)\n"
    "\tmovej([0.2,-1.2,1.2,-0.1,1.57,0],a=1.4,v=1.0,r=0)\n"
    "\tsignal_async_progress(1)\n"
    "\tmovel([0.2,-1.1,1.2,-0.1,1.57,1e-05],a=1.2,v=0.5,r=0)\n"
    "\tsignal_async_progress(2)\n"
    "\tmovej([0.1,-1.2,1.2,-0.1,1.57,0],a=1.4,v=1.0,r=0)\n"
    "  end\n";

/// A text composed of two parts.
struct Text {
  std::array<char, 2048> bytes;
  std::size_t size = 0;
  Text(std::string_view a, std::string_view b) {
    for (const std::string_view part : {a, b}) {
      std::memcpy(bytes.data() + size, part.data(), part.size());
      size += part.size();
    }
  }
  operator std::string_view() const { return {bytes.data(), size}; }
};

// Proves URP-22.

void a_path_goes_through_all_its_points(void**) {
  static RegisterBench bench;
  bench.start(true, Text(kValue, kPath));
  assert_int_equal(bench.answer(2), -1);
  bench.write(45);
  std::int32_t told = bench.answer(2);
  bool first = false, second = false;
  while (bench.answer() != 2) {
    bench.tick();
    first = first || (bench.target() - joints({0.2, -1.2, 1.2, -0.1, 1.57, 0.0})).norm() < 1e-6;
    second = second || (bench.target() - joints({0.2, -1.1, 1.2, -0.1, 1.57, 1e-5})).norm() < 1e-4;
    assert_true(bench.answer(2) == told || bench.answer(2) == told + 1);
    told = bench.answer(2);
  }
  assert_true(first && second);
  assert_int_equal(told, 2);
  assert_joints(bench.image().actual_q, joints({0.1, -1.2, 1.2, -0.1, 1.57, 0.0}), 1e-3);
  bench.finish();
}

void a_path_in_the_background_leaves_the_program_ready(void**) {
  static RegisterBench bench;
  bench.start(false, Text(kValue, kPath));
  const int cycles = bench.command(45, {}, 1);
  assert_in_range(cycles, 1, 3);
  int k = 0;
  for (; k < 1000 && bench.answer(2) >= 0; ++k) {
    bench.tick();
    assert_int_equal(bench.answer(), 1);
  }
  assert_int_equal(bench.answer(2), -2);
  assert_true(k > 150);
  assert_joints(bench.image().actual_q, joints({0.1, -1.2, 1.2, -0.1, 1.57, 0.0}), 1e-3);
}

void a_path_is_broken_off_by_a_stop(void**) {
  static RegisterBench bench;
  bench.start(false, Text(kValue, kPath));
  bench.command(45, {}, 1);
  bench.run(20);
  assert_in_range(bench.command(34, {3.0}), 1, 60);
  const Joints q = bench.target();
  bench.run(250);
  assert_joints(bench.target(), q, 0.0);
  assert_true((q - joints({0.2, -1.2, 1.2, -0.1, 1.57, 0.0})).norm() > 0.05);
}

void a_path_that_leaves_the_joints_range_stops_the_arm(void**) {
  static RegisterBench bench;
  bench.start(false,
              "  def exec_move_path():\n\tmovej([-123,-1.2,1.2,-0.1,1.57,0],a=1,v=1,r=0)\n  end\n");
  bench.write(45);
  bench.run(3);
  assert_true(bench.machine().safety.protective_stopped());
  assert_int_not_equal(bench.answer(), 2);
}

// Proves URP-23.

void progress_is_a_value_in_older_texts(void**) {
  static RegisterBench bench;
  bench.start(true, kValue);
  for (const std::int32_t end : {-2, -1, -2}) {
    const double q0 = bench.target()[0] + 0.1;
    bench.command(1, {q0, -1.2, 1.2, -0.1, 1.57, 0.0, 1.0, 1.4}, 1);
    assert_int_equal(bench.answer(2), 0);
    bench.run(150);
    assert_int_equal(bench.answer(2), end);
    ASSERT_NEAR(bench.target()[0], q0, 1e-9);
  }
  bench.command(1, {0.0, -1.2, 1.2, -0.1, 1.57, 0.0, 1.0, 1.4}, 1);
  bench.run(10);
  assert_true(bench.command(34, {2.0}, 1) > 5);  // these texts always wait for a stop
  assert_int_equal(bench.answer(2), 0);          // and report no progress of an interrupted motion
}

void progress_is_counted_in_newer_texts(void**) {
  static RegisterBench bench;
  bench.start(true, kCounted);
  assert_int_equal(bench.answer(2), counted(0, 1, 0, 0));
  bench.command(1, {0.3, -1.2, 1.2, -0.1, 1.57, 0.0, 0.5, 1.0}, 1);
  assert_int_equal(bench.answer(2), counted(1, 2, 1, 0));
  bench.run(20);
  // The move has ended; an asynchronous stop has begun.
  const int cycles = bench.command(34, {0.5}, 1);
  assert_in_range(cycles, 1, 3);
  assert_int_equal(bench.answer(2), counted(2, 4, 1, 0));
  assert_true(bench.image().target_qd[0] > 0.0);
  bench.run(200);
  assert_int_equal(bench.answer(2), counted(2, 5, 0, 0));
  assert_true(bench.image().target_qd.isZero(0.0));
  bench.command(1, {0.0, -1.2, 1.2, -0.1, 1.57, 0.0, 1.0, 1.4}, 1);
  bench.run(20);
  bench.command(34, {2.0}, 0);
  assert_int_equal(bench.answer(2), counted(3, 7, 0, 0));
}

void counters_have_seven_bits(void**) {
  AsyncProgress progress(AsyncProgress::Coding::kCounted);
  for (int k = 0; k < 127; ++k) progress.write(0);
  assert_int_equal(progress.write(0), counted(0, 0, 1, 0));
  assert_int_equal(progress.write(40000), counted(0, 1, 1, 32767));
  assert_int_equal(progress.write(-1), counted(0, 2, 0, 0));
}

// Proves URP-24.

void jogging_is_along_the_axes_that_it_began_with(void**) {
  // The tool's z at the start, by the published rotation matrix of this posture.
  const Vector3 z(-0.995003850, -0.000796327, 0.099833385);
  for (const int feature : {0, 1, 2}) {
    RegisterBench& bench = *new RegisterBench;
    bench.start();
    const double quarter = std::acos(-1.0) / 2.0;  // of a frame whose x is the base's y
    const double f = feature;
    bench.write(41, {0.0, 0.0, 0.05, 0, 0, 0, f, 0, 0, 0, 0, 0, quarter});
    bench.finish();
    bench.run(60);
    const Vector3 along = feature == 1 ? z : Vector3(0.0, 0.0, 1.0);
    Vector3 v = bench.image().target_tcp_speed.head<3>();
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(v[i], 0.05 * along[i], 1e-4);
    bench.write(41, {0.05, 0.0, 0.0, 0, 0, 0, f, 0, 0, 0, 0, 0, quarter});
    bench.finish();
    bench.run(60);
    v = bench.image().target_tcp_speed.head<3>();
    const Vector3 x(0.000792348, -0.999999683, -0.000079500);  // first column
    const Vector3 then = feature == 0 ? Vector3(1, 0, 0) : feature == 1 ? x : Vector3(0, 1, 0);
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(v[i], 0.05 * then[i], 1e-4);
    bench.command(42);
    assert_true(bench.image().target_qd.isZero(0.0));
    bench.run(20);
    assert_true(bench.image().target_qd.isZero(0.0));
    delete &bench;
  }
}

void the_axes_stay_while_the_tool_turns(void**) {
  static RegisterBench bench;
  bench.start();
  bench.write(41, {0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0, 0, 0, 0, 0, 0});
  bench.finish();
  bench.run(125);
  bench.write(41, {0.0, 0.0, 0.05, 0.0, 0.0, 0.0, 1.0, 0, 0, 0, 0, 0, 0});
  bench.finish();
  bench.run(250);
  const Vector3 z(-0.995003850, -0.000796327, 0.099833385);  // the tool's at the beginning
  for (int i = 0; i < 3; ++i) ASSERT_NEAR(bench.image().target_tcp_speed[i], 0.05 * z[i], 1e-4);
}

void newer_texts_jog_with_the_acceleration_asked_for(void**) {
  static RegisterBench bench;
  bench.start(false, "  global jog_acc = 0.5\n");
  bench.write(41, {0.0, 0.0, 0.2, 0, 0, 0, 0.0, 0.1, 0, 0, 0, 0, 0, 0});
  bench.run(125);
  const double v = bench.image().target_tcp_speed[2];
  assert_true(v > 0.08 && v < 0.11);
  bench.finish();
}

void servoc_goes_to_its_pose_and_is_done_until_it_is_taken_back(void**) {
  static RegisterBench bench;
  bench.start();
  Vector6 pose = forward(kStart).pose();
  pose[2] += 0.05;
  bench.write(12, pose, {0.1, 0.5, 0.0});
  bench.run(150);
  assert_int_equal(bench.answer(), 2);
  ASSERT_NEAR(bench.image().actual_tcp_pose[2], pose[2], 1e-3);
  bench.finish();
  bench.command(16, {10.0});
  assert_true(bench.running());
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_blocking_command_is_done_when_the_arm_stands),
      cmocka_unit_test(poses_are_moved_to_by_joints_and_on_a_line),
      cmocka_unit_test(servoj_stays_ready_and_stops_softly_at_the_last_target),
      cmocka_unit_test(speedj_is_held_until_it_is_stopped),
      cmocka_unit_test(force_mode_is_ready_at_once_and_its_end_done),
      cmocka_unit_test(a_watchdog_that_is_not_fed_ends_the_program),
      cmocka_unit_test(the_watchdog_is_fed_by_the_register_of_the_offset),
      cmocka_unit_test(command_255_ends_it),
      cmocka_unit_test(a_path_goes_through_all_its_points),
      cmocka_unit_test(a_path_in_the_background_leaves_the_program_ready),
      cmocka_unit_test(a_path_is_broken_off_by_a_stop),
      cmocka_unit_test(a_path_that_leaves_the_joints_range_stops_the_arm),
      cmocka_unit_test(progress_is_a_value_in_older_texts),
      cmocka_unit_test(progress_is_counted_in_newer_texts),
      cmocka_unit_test(counters_have_seven_bits),
      cmocka_unit_test(jogging_is_along_the_axes_that_it_began_with),
      cmocka_unit_test(the_axes_stay_while_the_tool_turns),
      cmocka_unit_test(newer_texts_jog_with_the_acceleration_asked_for),
      cmocka_unit_test(servoc_goes_to_its_pose_and_is_done_until_it_is_taken_back),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
