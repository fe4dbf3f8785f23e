// Tests the commands of the register program: their answers, their motions, and the client's view.
#include "kernel/core/text.hpp"
#include "tests/ur/programs/ur_register_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

// The flange at kStart by the published DH table, confirmed by an independent analytic solver.
const Vector6 kFlange =
    joints({-0.897353027, -0.164014421, 0.591790577, 1.135629, -1.134630, -1.254270});

void assert_six(const Vector6& actual, const Vector6& expected, double tolerance) {
  assert_joints(actual, expected, tolerance);
}

constexpr double kEncoders =
    2e-5;  // m or rad: half a step of each encoder, at the reach of the arm

// Proves URP-20.

void kinematics_are_answered_forwards(void**) {
  for (const bool with_offset : {false, true}) {
    static RegisterBench bench;
    bench.start(with_offset, "  get_tcp_offset()\n");
    bench.command(29, {0.0, 0.0, 0.1, 0.0, 0.0, 0.0});
    bench.command(40);
    assert_six(bench.answered(), joints({0.0, 0.0, 0.1, 0.0, 0.0, 0.0}), 0.0);
    bench.command(58);
    assert_six(bench.answered(), kFlange, kEncoders);
    bench.command(43);  // the tip: 0.1 m along the flange's z, the third column of its R
    assert_six(bench.answered(),
               kFlange + joints({-0.0995003850, -0.0000796327, 0.0099833385, 0.0, 0.0, 0.0}),
               kEncoders);
    bench.write(44, kStart, {0, 0, 0, 0, 0, 0});
    bench.finish();
    assert_six(bench.answered(), kFlange, 1e-6);
  }
}

void joints_are_answered_for_a_pose(void**) {
  static RegisterBench bench;
  bench.start();
  for (const std::int32_t number : {46, 30}) {
    bench.machine().io.output.doubles.fill(0.0);
    bench.write(number, kFlange, {0.05, -1.15, 1.15, -0.05, 1.5, 0.05});
    bench.finish();
    assert_six(bench.answered(), kStart, 1e-5);
  }
}

void frames_are_multiplied(void**) {
  static RegisterBench bench;
  bench.start();
  // A quarter turn about z maps x to y.
  const double quarter = std::acos(-1.0) / 2.0;
  bench.command(39, {0.1, 0.2, 0.3, 0.0, 0.0, quarter, 0.1, 0.0, 0.0, 0.0, 0.0, quarter});
  assert_six(bench.answered(), joints({0.1, 0.3, 0.3, 0.0, 0.0, 2.0 * quarter}), 1e-12);
}

void questions_have_yes_and_no(void**) {
  static RegisterBench bench;
  bench.start(false, "  get_inverse_kin_has_solution(x)\n");
  const Vector6 far = joints({3.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  for (const std::int32_t number : {36, 60, 61})
    for (const bool near : {true, false}) {
      bench.write(number, near ? kFlange : far, {0.05, -1.15, 1.15, -0.05, 1.5, 0.05});
      bench.finish();
      assert_int_equal(bench.answer(1), near ? 1 : 0);
    }
  bench.command(37, {0.0, -1.2, 6.3, 0.0, 0.0, 0.0});
  assert_int_equal(bench.answer(1), 1);
  bench.command(37, {0.0, -1.2, 6.4, 0.0, 0.0, 0.0});
  assert_int_equal(bench.answer(1), 0);
  bench.command(37, {0.0, NAN, 0.0, 0.0, 0.0, 0.0});
  assert_int_equal(bench.answer(1), 0);
}

void rest_is_told(void**) {
  static RegisterBench bench;
  bench.start(false, "  thread move_thread():\n  end\n");
  bench.command(47);
  assert_int_equal(bench.answer(1), 1);
  bench.command(1, {0.5, -1.2, 1.2, -0.1, 1.57, 0.0, 0.5, 1.0}, 1);
  bench.command(47);
  assert_int_equal(bench.answer(1), 0);
}

void torques_are_without_the_arms_own_weight(void**) {
  static RegisterBench bench;
  bench.start();
  bench.run(50);
  bench.write(38);
  bench.run(2);
  assert_true(bench.image().target_moment.cwiseAbs().maxCoeff() > 20.0);
  assert_six(bench.answered(), Vector6::Zero(), 0.5);
  bench.controller.faults().push = joints({0.0, 0.0, 10.0, 0.0, 0.0, 0.0});
  bench.run(250);
  ASSERT_NEAR(std::abs(bench.answered()[2]), 10.0, 0.5);
}

// Proves URP-21.

void what_acts_in_every_cycle_stays_ready(void**) {
  static RegisterBench bench;
  bench.start();
  for (const std::int32_t number : {25, 26, 27, 38, 66, 67, 68, 69, 70, 71}) {
    bench.write(number);
    for (int k = 0; k < 5; ++k) {
      bench.tick();
      assert_int_equal(bench.answer(), 1);
    }
  }
  bench.write(1, {0.1, -1.2, 1.2, -0.1, 1.57, 0.0, 1.05, 1.4});  // without withdrawing it
  bench.finish();
  ASSERT_NEAR(bench.target()[0], 0.1, 1e-9);
}

void the_flanges_pose_is_done_for_a_cycle_and_then_ready(void**) {
  static RegisterBench bench;
  bench.start();
  bench.write(58);
  bench.tick();
  assert_int_equal(bench.answer(), 2);
  bench.tick();
  assert_int_equal(bench.answer(), 1);
}

void a_pose_without_a_posture_is_the_scripts_error(void**) {
  for (const std::int32_t number : {2, 24, 30, 46}) {
    static RegisterBench bench;
    bench.said.size = 0;
    bench.start();
    bench.write(number, {3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.4, 0.008, 0.1, 300.0});
    bench.run(3);
    assert_false(bench.running());
    assert_int_not_equal(bench.answer(), 2);
    assert_true(bench.said.has("no inverse kinematics"));
    assert_true(bench.machine().safety.normal());
    bench.write(0);
  }
}

void a_move_out_of_reach_stops_the_arm_and_is_not_done(void**) {
  struct Case {
    std::int32_t number;
    double first;
    Code code;
  };
  for (const Case& one :
       {Case{1, -123.0, Code::kCloseToJointLimit}, Case{3, 3.0, Code::kSingularity}}) {
    RegisterBench& bench = *new RegisterBench;
    bench.start();
    bench.write(one.number, {one.first, -1.2, 1.2, -0.1, 1.57, 0.0, 1.0, 1.4});
    bench.run(2);
    assert_false(bench.running());
    assert_int_equal(bench.answer(), 1);
    assert_true(bench.machine().safety.protective_stopped());
    assert_int_equal(static_cast<int>(bench.machine().last_stop.code), static_cast<int>(one.code));
    delete &bench;
  }
}

void a_function_that_the_text_does_not_call_does_nothing(void**) {
  static RegisterBench bench;
  bench.start();
  bench.machine().io.output.doubles.fill(0.0);
  bench.machine().io.output.ints[1] = 7;
  bench.command(31);
  assert_true(bench.machine().safety.normal());
  bench.command(29, {0.0, 0.0, 0.1, 0.0, 0.0, 0.0});
  bench.command(40);
  assert_six(bench.answered(), Vector6::Zero(), 0.0);
  bench.command(60);
  assert_int_equal(bench.answer(1), 7);
}

/// The robot would do it, and "done" or "ready" would say that it was done.
void what_is_not_emulated_of_an_e_series_ends_the_program_by_name(void**) {
  Settings settings = ProgramBench::settings();
  settings.version = {5, 11, 1, 108318};
  for (const std::int32_t number : {25, 80}) {
    RegisterBench& bench = *new RegisterBench(settings);
    bench.start(false,
                "  def more(cmd):\n"
                "    if cmd == 25:\n"
                "      textmsg(\"tool_contact\")\n"
                "    elif cmd == 80:\n"
                "      textmsg(\"tool_contact\")\n"
                "    end\n"
                "  end\n");
    bench.command(8);
    bench.command(81);  // of which the text knows nothing
    bench.write(number);
    bench.run(2);
    assert_false(bench.running());
    assert_int_not_equal(bench.answer(), 2);
    Message expected("runtime_error:not emulated:command ");
    expected << number << ":textmsg(\"tool_contact\")";
    assert_true(bench.said.has(expected));
    delete &bench;
  }
}

void a_protective_stop_ends_the_program(void**) {
  static RegisterBench bench;
  bench.start(false, "  protective_stop()\n");
  bench.write(31);
  bench.run(2);
  assert_true(bench.machine().safety.protective_stopped());
  assert_false(bench.running());
  assert_int_equal(bench.answer(), 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(kinematics_are_answered_forwards),
      cmocka_unit_test(joints_are_answered_for_a_pose),
      cmocka_unit_test(frames_are_multiplied),
      cmocka_unit_test(questions_have_yes_and_no),
      cmocka_unit_test(rest_is_told),
      cmocka_unit_test(torques_are_without_the_arms_own_weight),
      cmocka_unit_test(what_acts_in_every_cycle_stays_ready),
      cmocka_unit_test(the_flanges_pose_is_done_for_a_cycle_and_then_ready),
      cmocka_unit_test(a_pose_without_a_posture_is_the_scripts_error),
      cmocka_unit_test(a_move_out_of_reach_stops_the_arm_and_is_not_done),
      cmocka_unit_test(a_function_that_the_text_does_not_call_does_nothing),
      cmocka_unit_test(what_is_not_emulated_of_an_e_series_ends_the_program_by_name),
      cmocka_unit_test(a_protective_stop_ends_the_program),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
