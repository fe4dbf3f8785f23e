// Tests that `check` names the places at which the arm cannot follow a path of its tip, that a
// run then stays behind by as much, and that what `check` accepts a run carries out.
#include <algorithm>
#include <random>
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kPoses = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n";
constexpr const char* kPosition =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = cpc.q_c\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[trg]\ntype = task_reference_generator\nx = model.x\n"
    "[cpc]\ntype = cartesian_pose\nx_d = trg.x_d\nv_d = trg.v_d\nx = model.x\nJ = model.J\n"
    "q = robot.q\n"
    "[recorder]\nsignals = model.x\ntracking = trg.x_d model.x\n";

/// A row of a trajectory with the flange as in the ready pose.
Line row(double time_s, double x_m, double y_m = 0.0) {
  char text[128];
  std::snprintf(text, sizeof text, "%g,%g,%g,0.5,0,0.923879532511,-0.382683432365,0\n", time_s, x_m,
                y_m);
  return Line(text);
}

int check(const Line& trajectory) {
  const Line pipeline = write("cpc.ini", {kPosition});
  return tactus_run({"check", pipeline.c_str(), "--trajectory", trajectory.c_str()});
}

int run(const char* pipeline, const Line& trajectory) {
  const Line file = in_folder(pipeline), out = in_folder("far");
  return tactus_run({"run", file.c_str(), "--trajectory", trajectory.c_str(), "--no-figure",
                     "--out", out.c_str()});
}

// Proves RUN-26.

void a_pose_out_of_reach_is_refused_with_time_place_and_distance(void**) {
  const Line far =
      write("far.csv", {kPoses, row(5, 0.5).c_str(), row(15, 1.1).c_str(), row(25, 0.5).c_str()});
  assert_int_equal(check(far), 2);
  assert_true(output().empty());
  assert_true(has(errors(), "/far.csv: refused: t = 9."));
  assert_true(has(errors(), " s: out of reach: at t = 15 s, (1.1, 0, 0.5) m, it stays 0.3"));
  assert_true(has(errors(), "; move the path or the base of the arm\n"));
  const double short_m = number_after(errors(), "it stays ");
  assert_int_equal(run("cpc.ini", far), 1);
  assert_true(has(errors(), "aborted: path not followed: translation: path error 0.05"));
  shell("sed '/reference_generator/a path_position_tolerance = 0' $S/cpc.ini >$S/loose.ini");
  run("loose.ini", far);
  assert_succeeds(
      "python3 -c \"import json, math; t = json.load(open('$S/far/summary.json'))['tracking'];"
      " print('largest', math.hypot(*t[0]['max'][:3]))\"");
  ASSERT_NEAR(number_after(output(), "largest "), short_m, 0.02);
}

void an_arm_that_is_singular_and_a_joint_that_is_too_fast_are_named(void**) {
  const Line far = write("far.csv", {kPoses, row(5, 0.5).c_str(), row(15, 1.1).c_str()});
  assert_int_equal(check(far), 2);
  assert_true(has(errors(), " s: near a singularity: at t = 9."));
  assert_true(has(errors(), " m, sigma is 0.0"));
  assert_true(has(errors(), ", and below 0.05 the tip may leave the path; "));
  assert_true(has(errors(), " s: too fast for the arm: at t = 9."));
  assert_true(has(errors(), " m, joint 4 (fer_joint4) turns at "));
}

void a_joint_at_its_limit_is_named_with_value_and_limit(void**) {
  const Line turn =
      write("turn.csv", {kPoses, row(5, 0.4).c_str(), "25,0.4,0,0.5,0,0.38268343,0.9238795,0\n",
                         "45,0.4,0,0.5,0,-0.38268343,0.9238795,0\n"});
  assert_int_equal(check(turn), 0);
  assert_true(has(errors(), " s: near a joint limit: at t = "));
  assert_true(has(errors(), " joint 7 (fer_joint7) is at -2.89"));
  assert_true(has(errors(), " rad, its limit is -2.8973; "));
  assert_int_equal(std::count(errors().begin(), errors().end(), '\n'), 1);
}

void a_path_in_reach_and_a_path_of_joints_have_no_warning(void**) {
  for (const char* pipeline : {"pipelines/fer_trg_cpc.ini", "pipelines/fer_trg_ac_cpc_pid.ini",
                               "pipelines/fer_jrg_pdgc.ini"}) {
    assert_int_equal(tactus_run({"check", pipeline}), 0);
    assert_true(errors().find("warning") == std::string_view::npos);
  }
}

void a_path_that_is_in_and_out_of_reach_very_often_has_few_lines(void**) {
  std::string text(kPoses);
  for (int i = 0; i < 300; ++i) text += row(5 + 3 * i, i % 2 == 0 ? 0.5 : 0.9, 0.1).c_str();
  assert_int_equal(check(write("often.csv", {text.c_str()})), 2);
  assert_int_equal(std::count(errors().begin(), errors().end(), '\n'), 13);
  assert_true(has(errors(), "/often.csv: refused: and "));
}

// Proves RUN-29.

void what_is_accepted_is_followed_and_what_is_refused_is_given_up(void**) {
  std::minstd_rand random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  int followed = 0, given_up = 0;
  for (int trial = 0; trial < 16; ++trial) {
    std::string text(
        "time_s,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s\n");
    const double end_s = 2.3 + 0.4 * any(random);
    for (const double time_s : {2.0, end_s}) {
      const double x_m = 0.35 + 0.32 * any(random), y_m = 0.9 * any(random) - 0.45;
      text += row(time_s, x_m, y_m).c_str();
      text.replace(text.size() - 1, 1, ",0,0,0,0,0,0\n");
    }
    const Line csv = write("any.csv", {text.c_str()});
    const bool accepted = check(csv) == 0;
    if (!accepted && errors().find("s: path not followed: ") == std::string_view::npos) continue;
    assert_int_equal(run("cpc.ini", csv), accepted ? 0 : 1);
    if (!accepted) assert_true(has(errors(), "aborted: path not followed: "));
    ++(accepted ? followed : given_up);
  }
  print_message("followed %d, given up %d\n", followed, given_up);
  assert_in_range(followed, 4, 12);
  assert_in_range(given_up, 2, 12);
}

void what_is_judged_when_it_begins_is_refused_too(void**) {
  const Line fast = write("fast.csv", {kPoses, row(0.2, 0.5).c_str()});
  write("cpc.ini", {kPosition, "[gateway]\nstart_s = 1\n"});
  assert_int_equal(
      tactus_run({"check", in_folder("cpc.ini").c_str(), "--trajectory", fast.c_str()}), 2);
  const std::string refused(errors());
  assert_int_equal(run("cpc.ini", fast), 1);
  assert_true(has(errors(), refused.c_str()));
}

/// With torques too, which are not rehearsed.
void a_trajectory_that_begins_elsewhere_is_refused_however_long_it_waits(void**) {
  const Line away = write("away.csv", {kHeader, "0,0.2,-0.785398,0,-2.356194,0,1.570796,0.785398\n",
                                       "5,0,-0.785398,0,-2.356194,0,1.570796,0.785398\n"});
  for (const char* start : {"0", "0.5", "3600"}) {
    const Line file = write("torque.ini", {kPipeline, "[gateway]\nstart_s = ", start, "\n"});
    assert_int_equal(tactus_run({"check", file.c_str(), "--trajectory", away.c_str()}), 2);
    assert_true(has(errors(), "/away.csv: refused: "));
    assert_true(has(errors(), " rad exceeds 0.01 rad (40); begin there"));
  }
}

void a_box_in_the_way_is_named_with_its_time_before_anything_moves(void**) {
  const char* const file =
      "(cat pipelines/fer_trg_cpc.ini; echo '[shelf]\ntype = box\ncentre = 0.45 0 0.3\n"
      "size = 0.3 0.3 0.2\n[collision]') >$S/shelf.ini && $P check $S/shelf.ini "
      "--trajectory pipelines/trajectories/fer_square.csv";
  assert_int_equal(shell(file), 2);
  assert_true(has(errors(), "fer_square.csv: refused: the run would stop at t = 7."));
  assert_true(has(errors(), " s: collision (77)\n  shelf with "));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pose_out_of_reach_is_refused_with_time_place_and_distance),
      cmocka_unit_test(an_arm_that_is_singular_and_a_joint_that_is_too_fast_are_named),
      cmocka_unit_test(a_joint_at_its_limit_is_named_with_value_and_limit),
      cmocka_unit_test(a_path_in_reach_and_a_path_of_joints_have_no_warning),
      cmocka_unit_test(a_path_that_is_in_and_out_of_reach_very_often_has_few_lines),
      cmocka_unit_test(what_is_accepted_is_followed_and_what_is_refused_is_given_up),
      cmocka_unit_test(what_is_judged_when_it_begins_is_refused_too),
      cmocka_unit_test(a_trajectory_that_begins_elsewhere_is_refused_however_long_it_waits),
      cmocka_unit_test(a_box_in_the_way_is_named_with_its_time_before_anything_moves),
  };
  return run_program_tests(argv[0], tests);
}
