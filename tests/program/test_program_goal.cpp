// Tests that a run says why its goal was not reached, and that it does not end before the goal
// could be.
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kHead =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n";
/// Gravity compensation and a weak spring: friction holds the arm off its goal.
constexpr const char* kLaw =
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"
    "[recorder]\ndivisor = 10\ntracking = jrg.q_d robot.q\n";
/// Joint 4 goes 0.2 rad down in half a second.
constexpr const char* kDown = "0.5,0,-0.785398,0,-2.156194,0,1.570796,0.785398\n";

Line pipeline(const char* settings) {
  return write("g.ini", {kHead, settings, kLaw});
}
Line trajectory() {
  return write("down.csv", {kHeader, kDown});
}

/// A run that decides itself when it ends; returns its exit code.
int whole_run(const Line& file) {
  const Line out = in_folder("g"), csv = trajectory();
  return tactus_run(
      {"run", file.c_str(), "--no-figure", "--trajectory", csv.c_str(), "--out", out.c_str()});
}

/// Seconds of the last recorded row.
double length_s() {
  const std::string_view log = file_of("g/log.csv");
  return std::atof(std::string(log.substr(log.rfind('\n', log.size() - 2) + 1)).c_str());
}

// Proves RUN-24.

void a_goal_given_up_names_joint_value_limit_and_what_to_do(void**) {
  assert_int_equal(whole_run(pipeline("goal_tolerance = 1 1 1 1e-6 1 1 1\ngoal_time_s = 0.5\n")),
                   1);
  assert_true(has(errors(),
                  "/down.csv: aborted: goal not reached: joint 4 (fer_joint4): position "
                  "error "));
  assert_true(has(errors(),
                  " rad exceeds 1e-06 rad (50); raise the gains of the law, "
                  "goal_tolerance or goal_time_s; an arm that sags has another tool or mounting "
                  "than [robot] says\n"));
  assert_true(has(file_of("g/summary.json"),
                  "\"name\": \"aborted\", \"why\": \"goal not reached: joint 4 "));
  assert_int_equal(shell("$R/scripts/report $S g"), 1);
  assert_true(has(file_of("report.html"), "<b>aborted</b>: goal not reached: joint 4 "));
}

void a_goal_that_is_not_held_long_enough_names_the_settings(void**) {
  assert_int_equal(
      whole_run(pipeline(
          "goal_tolerance = 1\nstopped_velocity = 0\ndwell_ms = 500\ngoal_time_s = 0.4\n")),
      1);
  assert_true(has(errors(), "aborted: goal reached, but not for dwell_ms within goal_time_s"));
  assert_true(has(file_of("g/summary.json"), "\"why\": \"goal reached, but not for dwell_ms"));
}

void a_run_covers_the_last_part_of_a_cycle(void**) {
  const Line file = pipeline(
      "goal_time_s = 0\ngoal_tolerance = 1\nstopped_velocity = 0\n[gateway]\nsettle_s = 0\n");
  const Line csv =
      write("odd.csv", {kHeader, "0.50018,0,-0.785398,0,-2.256194,0,1.570796,0.785398\n"});
  const Line out = in_folder("g");
  assert_int_equal(tactus_run({"run", file.c_str(), "--no-figure", "--trajectory", csv.c_str(),
                               "--out", out.c_str()}),
                   0);
}

void a_path_that_was_not_followed_names_joint_value_limit_and_what_to_do(void**) {
  assert_int_equal(whole_run(pipeline("path_tolerance = 0 0 0 0.001 0 0 0\n")), 1);
  assert_true(has(errors(), "aborted: path not followed: joint 4 (fer_joint4): path error 0.001"));
  assert_true(has(errors(),
                  "(49); give the trajectory more time, raise the gains of the law, or "
                  "path_tolerance\n"));
}

void an_arm_far_behind_its_path_has_not_succeeded_although_it_would_arrive(void**) {
  write("down.csv", {kHeader, "2.2,1.1,-0.785398,0,-2.356194,0,1.570796,0.785\n"});
  write("g.ini", {kHead, kLaw});
  const int code = shell(
      "sed -i 's/= 500/= 100/; s/= 50 40/= 500 40/' $S/g.ini && $P run $S/g.ini --trajectory "
      "$S/down.csv --no-figure --out $S/g");
  assert_int_equal(code, 1);
  assert_true(has(errors(), "aborted: path not followed: joint 1 (fer_joint1): path error 0.5"));
}

void an_arm_that_does_not_stop_at_its_goal_is_told_from_one_that_is_not_there(void**) {
  const Line noisy = write("g.ini", {kHead, "stopped_velocity = 1e-9\ngoal_time_s = 0.3\n",
                                     "[plant]\nvelocity_noise_rad_s = 1e-3\n", kLaw});
  assert_int_equal(whole_run(noisy), 1);
  assert_true(has(errors(), "goal not reached: joint 1 (fer_joint1): velocity "));
  assert_true(has(errors(),
                  " rad/s exceeds 1e-09 rad/s (58); raise the damping of the law, "
                  "stopped_velocity or goal_time_s\n"));
}

void the_tip_is_named_by_its_translation_or_rotation(void**) {
  assert_int_equal(shell("sed 's/^v    = model.v/goal_position_tolerance = 1e-9\\ngoal_time_s = "
                         "0.1/' pipelines/fer_trg_cpc.ini >$S/tip.ini && $P run $S/tip.ini "
                         "--trajectory pipelines/trajectories/fer_square.csv --no-figure "
                         "--out $S/g"),
                   1);
  assert_true(has(errors(), "aborted: goal not reached: translation: position error "));
  assert_true(has(errors(),
                  " m exceeds 1e-09 m (50); raise the gains of the law, "
                  "goal_position_tolerance and goal_angle_tolerance, or goal_time_s; an arm that "
                  "sags has another tool or mounting than [robot] says\n"));
}

void a_run_that_is_too_short_says_by_how_much_and_how_far_the_goal_was(void**) {
  const Line file = pipeline(""), csv = trajectory();
  assert_int_equal(run_into("g", file.c_str(), "1", csv.c_str(), "0.3"), 1);
  assert_true(has(errors(),
                  "/down.csv: unfinished: the run ended at 0.3 s, the trajectory ends at "
                  "0.5 s; give a longer --duration\n"));
  assert_int_equal(run_into("g", file.c_str(), "1", csv.c_str(), "0.51"), 1);
  assert_true(has(errors(), "unfinished: goal not reached: joint 4 (fer_joint4): "));
  assert_true(has(errors(), " or give a longer --duration\n"));
}

// Proves RUN-25.

void a_run_waits_for_its_goal_as_long_as_the_generator_does(void**) {
  assert_int_equal(whole_run(pipeline("dwell_ms = 3000\n")), 0);
  ASSERT_NEAR(length_s(), 4.0, 0.4);  // not 2 s after the trajectory, [gateway] settle_s
  assert_int_equal(
      whole_run(
          pipeline("goal_tolerance = 1e-9\ngoal_time_s = 4\n[plant]\nposition_noise_rad = 1e-4\n")),
      1);
  ASSERT_NEAR(length_s(), 4.5, 0.05);
  assert_true(has(file_of("g/summary.json"), "\"name\": \"aborted\""));
}

void a_goal_that_is_reached_ends_the_run_after_settle_s_and_not_later(void**) {
  assert_int_equal(whole_run(pipeline("goal_time_s = 8\n")), 0);
  ASSERT_NEAR(length_s(), 2.5, 0.02);
  const Line brief = write("g.ini", {kHead, "[gateway]\nsettle_s = 0\n", kLaw});
  assert_int_equal(whole_run(brief), 0);
  assert_true(length_s() < 2.0);
}

void a_generator_that_waits_without_an_end_is_given_settle_s(void**) {
  assert_int_equal(
      whole_run(
          pipeline("goal_tolerance = 1e-9\ngoal_time_s = 0\n[plant]\nposition_noise_rad = 1e-4\n")),
      1);
  ASSERT_NEAR(length_s(), 2.5, 0.05);
  assert_true(has(errors(), "unfinished: goal not reached: joint "));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_goal_given_up_names_joint_value_limit_and_what_to_do),
      cmocka_unit_test(a_goal_that_is_not_held_long_enough_names_the_settings),
      cmocka_unit_test(a_run_covers_the_last_part_of_a_cycle),
      cmocka_unit_test(a_path_that_was_not_followed_names_joint_value_limit_and_what_to_do),
      cmocka_unit_test(an_arm_far_behind_its_path_has_not_succeeded_although_it_would_arrive),
      cmocka_unit_test(an_arm_that_does_not_stop_at_its_goal_is_told_from_one_that_is_not_there),
      cmocka_unit_test(the_tip_is_named_by_its_translation_or_rotation),
      cmocka_unit_test(a_run_that_is_too_short_says_by_how_much_and_how_far_the_goal_was),
      cmocka_unit_test(a_run_waits_for_its_goal_as_long_as_the_generator_does),
      cmocka_unit_test(a_goal_that_is_reached_ends_the_run_after_settle_s_and_not_later),
      cmocka_unit_test(a_generator_that_waits_without_an_end_is_given_settle_s),
  };
  return run_program_tests(argv[0], tests);
}
