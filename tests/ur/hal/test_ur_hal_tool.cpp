// Tests what a UR's HAL compares before it moves an arm: payload and TCP of the controller with
// those of the file, and the tip with the model. The other side is the emulated controller, which
// has kinematics of its own, from the manufacturer's DH tables.
#include "hal/ur/reported_tool.hpp"
#include "tests/ur/hal/ur_emulated_bench.hpp"

namespace tactus::ur {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

/// The tool that a file without keys for it gives.
Tool nothing() {
  Tool tool;
  tool.mass_kg = kRequired;
  tool.com = tool.tip.p = Vector3::Constant(kRequired);
  return tool;
}
/// That of fresh_arm().
Tool short_handle() {
  return {0.749, {0.0, 0.0, 0.0291}, Pose{{0.0, 0.0, 0.0905}, {1.0, 0.0, 0.0, 0.0}}};
}

/// A controller whose pendant says 5 kg, and a TCP 0.12 m before the flange, turned by `turn` rad.
Settings gripper(double turn = 0.0) {
  Settings settings;
  settings.payload_kg = 5.0;
  settings.payload_cog = {0.0, 0.0, 0.1};
  settings.tcp_offset << 0.0, 0.0, 0.12, 0.0, 0.0, turn;
  return settings;
}

UrArmBench& arm_with(const Tool& given, const Settings& settings) {
  UrArmBench& bench = fresh_arm(settings);
  bench.hal.configure(bench.settings, given, 8000);
  return bench;
}

/// The arm stands where it stood, and no program of ours runs.
void assert_untouched(UrArmBench& bench, const Vector6& q) {
  for (int i = 0; i < 200; ++i) static_cast<void>(bench.run_cycle());
  assert_true((bench.hal.state().q - q).cwiseAbs().maxCoeff() < 1e-4);
  assert_true(!bench.hal.state().playing());
}

// Proves URH-32.
void what_the_file_does_not_give_stays_as_the_pendant_has_it(void**) {
  Settings settings;
  settings.payload_kg = 0.008;  // counts as none
  settings.tcp_offset[2] = 0.0008;
  UrArmBench& bench = arm_with(nothing(), settings);
  ASSERT_OK(start(bench));
  for (int i = 0; i < 20; ++i) ASSERT_OK(bench.run_cycle());
  ASSERT_NEAR(bench.hal.state().payload_kg, 0.008, 0.0);
  ASSERT_NEAR(bench.hal.state().tcp_offset[2], 0.0008, 0.0);
}

void what_the_file_gives_is_set(void**) {
  UrArmBench& bench = arm_with(short_handle(), gripper(0.7));
  ASSERT_OK(start(bench));
  const UrState& state = bench.hal.state();
  ASSERT_NEAR(state.payload_kg, 0.749, 1e-9);
  ASSERT_NEAR(state.payload_com[2], 0.0291, 1e-9);
  ASSERT_NEAR(state.tcp_offset[2], 0.0905, 1e-9);
  ASSERT_NEAR(state.tcp_offset[5], 0.0, 0.0);
}

void a_mass_without_a_centre_is_set_at_the_flange(void**) {
  Tool given = nothing();
  given.mass_kg = 1.5;
  UrArmBench& bench = arm_with(given, Settings());
  ASSERT_OK(start(bench));
  ASSERT_NEAR(bench.hal.state().payload_kg, 1.5, 1e-9);
  assert_true(bench.hal.state().payload_com == Vector3::Zero());
}

// Proves URH-33.
void a_tool_that_only_the_pendant_knows_is_refused_with_its_lines(void**) {
  UrArmBench& bench = arm_with(nothing(), gripper());
  ASSERT_STATUS(bench.executive.start(), Status::kMissingKey);
  assert_true(bench.says("the controller's payload is 5 kg at (0, 0, 0.1) m, the model's tool"));
  assert_true(bench.says("the controller's TCP is at (0, 0, 0.12) m, the model's at the flange"));
  assert_true(bench.says("add to [robot]: tool_mass = 5, tool_com = 0 0 0.1, tool_tip = 0 0 0.12"));
  assert_false(bench.says("turned"));
}

void only_what_is_missing_is_asked_for(void**) {
  Tool given = short_handle();
  given.tip.p.setConstant(kRequired);
  ASSERT_STATUS(start(arm_with(given, gripper())), Status::kMissingKey);
  assert_true(g_arm->says("; add to [robot]: tool_tip = 0 0 0.12"));
  given = short_handle();
  given.com.setConstant(kRequired);
  ASSERT_STATUS(start(arm_with(given, gripper())), Status::kMissingKey);
  assert_true(g_arm->says("; add to [robot]: tool_com = 0 0 0.1"));
  given = short_handle();
  given.mass_kg = kRequired;
  ASSERT_STATUS(start(arm_with(given, gripper())), Status::kMissingKey);
  assert_true(g_arm->says("; add to [robot]: tool_mass = 5, tool_com = 0 0 0.1"));
  assert_false(g_arm->says("tool_tip"));
}

void a_turned_tcp_is_said_to_be_one(void**) {
  Settings settings;
  settings.tcp_offset[4] = 0.5;
  ASSERT_STATUS(start(arm_with(nothing(), settings)), Status::kMissingKey);
  assert_true(g_arm->says("turned by 0.5 rad, which tool_tip cannot state"));
  settings.tcp_offset[4] = 6.283185307;  // once around
  ASSERT_OK(start(arm_with(nothing(), settings)));
  settings.payload_kg = -0.5;
  ASSERT_STATUS(start(arm_with(nothing(), settings)), Status::kMissingKey);
  assert_true(g_arm->says("[robot] cannot state that, correct it on the pendant"));
  assert_false(g_arm->says("tool_mass"));
}

void a_payload_set_after_connecting_is_found_at_arming(void**) {
  UrArmBench& bench = arm_with(nothing(), Settings());
  ASSERT_OK(bench.executive.start());
  upload("sec set():\n  set_payload(5.0, [0.0, 0.0, 0.1])\nend\n");
  const Vector6 q = bench.hal.state().q;
  ASSERT_STATUS(arm(bench), Status::kMissingKey);
  assert_true(bench.says("tool_mass = 5, tool_com = 0 0 0.1"));
  assert_int_equal(bench.hal.set_points(), 0);
  assert_untouched(bench, q);
}

void old_software_tells_no_tool_and_is_armed(void**) {
  Settings settings;
  settings.version = {3, 11, 0, 82155};
  settings.payload_kg = 5.0;
  UrArmBench& bench = arm_with(nothing(), settings);
  ASSERT_OK(start(bench));
  assert_true(std::isnan(bench.hal.state().payload_kg));
  assert_true(bench.hal.state().tcp_offset.hasNaN());
  settings.version = {3, 13, 1, 10297};  // with a TCP, without a payload
  ASSERT_OK(start(arm_with(nothing(), settings)));
  assert_true(std::isnan(g_arm->hal.state().payload_kg));
  ASSERT_NEAR(g_arm->hal.state().tcp_offset[2], 0.0, 0.0);
}

/// Numbers with five decimals, in all that can differ.
void the_longest_texts_are_whole(void**) {
  UrState state;
  state.tcp_pose << -1.23456, -1.23456, -1.23456, 0.0, 0.0, 1.23456;
  const auto ends = [&](const char* end) {
    Message why;
    assert_true(check_before_program(nothing(), state, 0.01234, why) == Status::kMissingKey);
    assert_true(std::string_view(why).size() < Message::capacity());
    assert_non_null(std::strstr(why.c_str(), end));
  };
  ends("; else the arm is no UR10 of a CB3");
  state.payload_kg = 12.34567;
  state.payload_com.setConstant(-1.23456);
  state.tcp_offset << -1.23456, -1.23456, -1.23456, 0.0, 0.0, 1.23456;
  ends("tool_com = -1.23456 -1.23456 -1.23456, tool_tip = -1.23456 -1.23456 -1.23456");
}

// Proves URH-34.

/// Positions of the flange as the manufacturer's DH table gives them, confirmed by the analytic
/// inverse kinematics of ROS-Industrial; rotation vectors of the same matrices.
void published_poses_are_where_the_model_has_them(void**) {
  struct Row {
    double q[6], pose[6];
  };
  constexpr Row kRows[] = {
      {{0, 0, 0, 0, 0, 0}, {-1.1843, -0.256141, 0.0116, 1.570796, 0, 0}},
      {{0, -1.2, 1.2, -0.1, 1.57, 0},
       {-0.897353027, -0.164014421, 0.591790577, 1.135629, -1.134630, -1.254270}},
      {{0.3, -1.1, 1.4, -0.7, 0.9, -0.4},
       {-0.828730943, -0.487953914, 0.425150793, 1.330753, 0.064841, -1.043399}},
      {{-1.6, -1.727, -2.203, -0.808, 1.595, -0.031},
       {-0.179509850, -0.606984887, 0.230850132, -0.002316, 3.116389, 0.038756}}};
  for (const Row& row : kRows) {
    UrState state;
    Message why;
    state.q = Vector6(row.q);
    state.tcp_pose = Vector6(row.pose);
    ASSERT_OK(check_before_program(nothing(), state, 1e-6, why));
    for (int i = 0; i < 3; ++i) {
      UrState moved = state, turned = state, bad = state;
      moved.tcp_pose[i] += 0.0101;
      turned.tcp_pose[3 + i] += 0.05;
      bad.q[i] = kRequired;
      assert_true(check_before_program(nothing(), moved, 0.01, why) != Status::kOk);
      assert_true(check_before_program(nothing(), turned, 0.01, why) != Status::kOk);
      assert_true(check_before_program(nothing(), bad, 0.01, why) != Status::kOk);
    }
  }
}

/// By hand, with the base at 0, the upper arm upright, the forearm level, the flange downwards:
/// x = a3 - d5, y = -d4, z = d1 - a2 - d6. The two arms differ by (-3.4, -10.209, 29.75) mm.
void a_ur10e_is_refused_by_the_distance_of_its_tip(void**) {
  Settings settings;
  settings.dh = kDhOfUr10e;
  settings.initial_q << 0.0, -kHalfPi, kHalfPi, -kHalfPi, -kHalfPi, 0.0;
  ASSERT_STATUS(arm_with(nothing(), settings).executive.start(), Status::kMismatch);
  assert_true(g_arm->says("the controller has the tip at (-0.6914, -0.17415, 0.67685) m"));
  assert_true(g_arm->says("the model of a ur10 at (-0.688, -0.16394, 0.6471) m, 0.03164 m and 0 "));
  assert_true(g_arm->says("limits 0.01 m ([ur] tip_tolerance)"));
}

void a_ur10e_is_refused_in_any_posture_with_any_tool(void**) {
  Settings settings = gripper();
  settings.dh = kDhOfUr10e;
  for (const auto& q : {std::array<double, 6>{0.0, -kHalfPi, 0.0, -kHalfPi, 0.0, 0.0},
                        std::array<double, 6>{0.3, -1.1, 1.4, -0.7, 0.9, -0.4},
                        std::array<double, 6>{0.0, -0.1, 0.1, 0.0, 0.3, 0.0}}) {
    settings.initial_q = Joints(q.data());
    ASSERT_STATUS(start(arm_with(short_handle(), settings)), Status::kMismatch);
    assert_true(g_arm->says("is the arm a UR10 of a CB3"));
  }
}

/// Connecting does not compare an arm without power.
void an_arm_is_compared_when_it_has_power(void**) {
  Settings settings;
  settings.switched_on = false;
  settings.dh = kDhOfUr10e;
  UrArmBench& bench = arm_with(nothing(), settings);
  bench.settings.on_power_off = OnPowerOff::kPowerOn;
  bench.settings.calibration = Calibration::kAny;
  ASSERT_OK(bench.executive.start());
  const Vector6 q = bench.hal.state().q;
  ASSERT_STATUS(arm(bench), Status::kMismatch);
  assert_int_equal(bench.hal.set_points(), 0);
  assert_untouched(bench, q);
}

/// Old software: the TCP is known when the program has set it.
void with_the_tcp_of_the_program_the_tip_is_compared_before_motion(void**) {
  Settings settings = gripper();
  settings.version = {3, 11, 0, 82155};
  ASSERT_OK(start(arm_with(short_handle(), settings)));
  settings.dh = kDhOfUr10e;
  UrArmBench& bench = arm_with(short_handle(), settings);
  bench.settings.calibration = Calibration::kAny;
  ASSERT_OK(bench.executive.start());
  const Vector6 q = bench.hal.state().q;
  ASSERT_STATUS(arm(bench), Status::kMismatch);
  assert_true(bench.drives_are(DriveState::kFault));
  assert_untouched(bench, q);
}

void a_tcp_that_is_not_told_is_suggested(void**) {
  Settings settings = gripper();
  settings.version = {3, 11, 0, 82155};
  ASSERT_STATUS(start(arm_with(nothing(), settings)), Status::kMissingKey);
  assert_true(g_arm->says("this software tells no TCP; if the pendant has this one, add to"));
  assert_true(g_arm->says(" [robot]: tool_tip = 0 0 0.12; else the arm is no UR10 of a CB3"));
  assert_false(g_arm->says("turned"));
  settings.tcp_offset[5] = 0.5;
  ASSERT_STATUS(start(arm_with(nothing(), settings)), Status::kMissingKey);
  assert_true(g_arm->says("turned as tool_tip cannot state"));
}

/// A longer upper arm, which is upright, lifts the tip.
void the_tolerance_is_that_of_the_file(void**) {
  Settings settings;
  settings.initial_q << 0.0, -kHalfPi, kHalfPi, -kHalfPi, -kHalfPi, 0.0;
  settings.dh.a[1] -= 0.009;
  arm_with(nothing(), settings).settings.calibration = Calibration::kAny;
  ASSERT_OK(start(*g_arm));
  settings.dh.a[1] -= 0.002;
  UrArmBench& bench = arm_with(nothing(), settings);
  bench.settings.calibration = Calibration::kAny;
  ASSERT_STATUS(start(bench), Status::kMismatch);
  bench.settings.tip_tolerance = 0.012;
  ASSERT_OK(start(bench));
}

/// The last axis leans by 0.03 rad; the flange is moved by 0.0922 times that.
void an_arm_turned_at_the_wrist_is_refused(void**) {
  Settings settings;
  settings.dh.alpha[4] += 0.03;
  ASSERT_STATUS(start(arm_with(nothing(), settings)), Status::kMismatch);
  assert_true(g_arm->says("0.00277 m and 0.03 rad apart"));
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_the_file_does_not_give_stays_as_the_pendant_has_it),
      cmocka_unit_test(what_the_file_gives_is_set),
      cmocka_unit_test(a_mass_without_a_centre_is_set_at_the_flange),
      cmocka_unit_test(a_tool_that_only_the_pendant_knows_is_refused_with_its_lines),
      cmocka_unit_test(only_what_is_missing_is_asked_for),
      cmocka_unit_test(a_turned_tcp_is_said_to_be_one),
      cmocka_unit_test(a_payload_set_after_connecting_is_found_at_arming),
      cmocka_unit_test(old_software_tells_no_tool_and_is_armed),
      cmocka_unit_test(the_longest_texts_are_whole),
      cmocka_unit_test(published_poses_are_where_the_model_has_them),
      cmocka_unit_test(a_ur10e_is_refused_by_the_distance_of_its_tip),
      cmocka_unit_test(a_ur10e_is_refused_in_any_posture_with_any_tool),
      cmocka_unit_test(an_arm_is_compared_when_it_has_power),
      cmocka_unit_test(with_the_tcp_of_the_program_the_tip_is_compared_before_motion),
      cmocka_unit_test(a_tcp_that_is_not_told_is_suggested),
      cmocka_unit_test(the_tolerance_is_that_of_the_file),
      cmocka_unit_test(an_arm_turned_at_the_wrist_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, end_arm);
}
