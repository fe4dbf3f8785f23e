// Tests a run that goes wrong: the arm comes to rest first, then the program ends and gives the
// reason.
#include <csignal>
#include <cstdlib>
#include <ctime>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Positions, for drives that follow them slowly.
constexpr const char* kPositions =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n"
    "[plant]\nservo_time_constant_s = 0.02\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[recorder]\nsignals = robot.dq jrg.q_d\n";
constexpr const char* kTorques =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n";
constexpr const char* kPd =
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";
constexpr const char* kTip =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = cpc.q_c\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[trg]\ntype = task_reference_generator\nx = model.x\n"
    "[cpc]\ntype = cartesian_pose\nx_d = trg.x_d\nx = model.x\nJ = model.J\nq = robot.q\n"
    "position_gain = 400 400 400\nrotation_gain = 400 400 400\nhold_tolerance = 0.001\n";
/// Half a radian of joint 1 in the given number of seconds.
constexpr const char* kFast = "1.5,0.5,-0.785398,0,-2.356194,0,1.570796,0.785398\n";
constexpr const char* kSlow = "40,0.5,-0.785398,0,-2.356194,0,1.570796,0.785398\n";

/// The largest joint velocity in the last row of a log, rad/s.
double last_velocity(const char* name) {
  std::string_view log = file_of(name);
  log.remove_suffix(1);
  const char* at = log.data() + log.rfind('\n') + 1;
  double largest = 0.0;
  for (int i = 0; i < 7; ++i) {
    at = std::strchr(at, ',') + 1;
    largest = std::max(largest, std::abs(std::strtod(at, nullptr)));
  }
  return largest;
}

// Proves LAD-11.

void a_run_whose_arm_does_not_follow_ends_with_the_cause_once_the_arm_is_at_rest(void**) {
  const Line pipeline =
      write("lag.ini", {kPositions, "[guard]\nfollowing_error = 0.005\nfollowing_time = 0\n"});
  const Line trajectory = write("fast.csv", {kHeader, kFast});
  assert_int_equal(run_into("lag", pipeline.c_str(), "1", trajectory.c_str(), "1"), 1);
  assert_true(has(errors(), "lag.ini: stopped: joint 1 (fer_joint1): following error 0.00"));
  assert_true(has(errors(), " rad exceeds 0.005 rad (76)\n"));
  const std::string_view summary = file_of("lag/summary.json");
  assert_true(
      has(summary,
          "\"name\": \"kFollowingError\", \"why\": \"joint 1 (fer_joint1): following error 0.00"));
  assert_true(has(summary, "\"rung\": \"disabled\""));
  assert_true(has(summary,
                  "\"cause\": \"state\", \"status\": \"kFollowingError\", "
                  "\"from\": \"nominal\", \"to\": \"stop\", \"value\": 0.005"));
  assert_true(has(summary,
                  "\"cause\": \"at_rest\", \"status\": \"kFollowingError\", "
                  "\"from\": \"stop\", \"to\": \"disabled\""));
  assert_true(
      has(output(), "nominal -> stop: state: following error beyond its limit (76), joint "));
  assert_true(last_velocity("lag/log.csv") <= 0.01);
}

/// A wrench sensor reads more than its block allows.
void a_block_that_ends_the_chain_is_named(void**) {
  const auto run_with = [](const char* plant) {
    const Line pipeline = write(
        "block.ini", {"[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n[plant]\n", plant,
                      "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
                      "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\n"
                      "tool = robot.tool\nmax_force = 10\nmax_moment = 30\n"
                      "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"});
    return run_into("block", pipeline.c_str(), "1", nullptr, "2");
  };
  assert_int_equal(run_with("ft_bias_force_N = 0 0 30\n"), 2);
  assert_true(has(errors(), "refused: sensor value out of range (73): block [sensor]\n"));
  assert_true(has(file_of("block/summary.json"),
                  "\"result\": {\"code\": 73, \"name\": \"kSensorRange\", "
                  "\"why\": \"sensor value out of range (73): block [sensor]\"}"));
  assert_int_equal(run_with("ft_noise_force_N = 2.5\n"), 1);
  assert_true(has(errors(), "(73): block [sensor]\n"));
}

/// A tool that the file does not state; gains that are too high for a servo that lags.
void a_reference_that_is_not_held_is_told_with_joint_or_axis_value_and_limit(void**) {
  const Line sags = write("sags.ini", {kTorques, "path_tolerance = 0.05\ngoal_time_s = 0.5\n", kPd,
                                       "[plant]\npayload_kg = 3\n"});
  assert_int_equal(run_into("held", sags.c_str(), "1", nullptr, "2"), 1);
  assert_true(has(errors(), "sags.ini: stopped: joint 6 (fer_joint6): path error 0.1"));
  assert_true(has(file_of("held/summary.json"), "\"why\": \"joint 6 (fer_joint6): path error 0.1"));
  assert_true(has(errors(),
                  " rad exceeds 0.05 rad (49): block [jrg]: its reference rests, and the arm does "
                  "not stay there; look at gains, tool and mounting; path_tolerance = 0 lets it be "
                  "pushed away\n"));
  const Line swings = write("swings.ini", {kTip,
                                           "[plant]\nservo_time_constant_s = 0.05\n"
                                           "delay_cycles = 4\nposition_noise_rad = 3e-4\n"});
  assert_int_equal(run_into("held", swings.c_str(), "1", nullptr, "14"), 1);
  assert_true(has(errors(), "swings.ini: stopped: rotation: path error 0.00"));
  assert_true(has(errors(), " rad exceeds 0.001 rad (49): block [cpc]: its reference rests, "));
  assert_true(has(errors(), "; hold_tolerance = 0 lets it be pushed away\n"));
}

/// In the middle of its motion.
void a_run_whose_time_has_passed_brakes_the_arm_before_it_ends(void**) {
  const Line pipeline = write("cut.ini", {kPositions});
  const Line trajectory = write("fast.csv", {kHeader, kFast});
  assert_int_equal(run_into("cut", pipeline.c_str(), "1", trajectory.c_str(), "0.75"), 1);
  assert_true(
      has(errors(), "/fast.csv: unfinished: the run ended at 0.75 s, the trajectory ends "));
  const std::string_view summary = file_of("cut/summary.json");
  assert_true(has(summary, "\"name\": \"unfinished\"") && has(summary, "\"cause\": \"at_rest\""));
  assert_true(last_velocity("cut/log.csv") <= 0.01);
}

void an_interrupt_brakes_the_arm_before_the_run_ends(void**) {
  const Line pipeline = write("slow.ini", {kPositions, kBusyHost}), out = in_folder("i");
  const Line trajectory = write("slow.csv", {kHeader, kSlow});
  const pid_t child = spawn({"run", pipeline.c_str(), "--trajectory", trajectory.c_str(),
                             "--realtime", "--no-figure", "--out", out.c_str()});
  for (int i = 0; i < 60'000 && file_of("i/log.csv").size() < 100'000; ++i) {
    const timespec millisecond = {0, 1'000'000};
    nanosleep(&millisecond, nullptr);
  }
  assert_int_equal(kill(child, SIGINT), 0);
  assert_int_equal(exit_code(child), 1);
  const std::string_view summary = file_of("i/summary.json");
  assert_true(has(summary, "\"rung\": \"disabled\""));
  assert_true(has(summary, "\"to\": \"stop\"") && has(summary, "\"cause\": \"at_rest\""));
  assert_true(last_velocity("i/log.csv") <= 0.01);
}

// Proves LAD-9, RUN-1.

void the_summary_tells_the_times_of_every_block_and_row(void**) {
  const Line pipeline = write("p.ini", {kPipeline});
  assert_int_equal(run_into("t", pipeline.c_str()), 0);
  assert_has_all(
      file_of("t/summary.json"),
      {"\"step.model\": {\"p50_ns\": ", "\"step.jrg\": {", "\"step.pd\": {", "\"row.control\": {",
       "\"row.recorder\": {", "\"p999_ns\": ", "\"p9999_ns\": ", "\"min_ns\": ", "\"mean_ns\": ",
       "\"count\": 50", "\"saturated\": ", "\"rung\": \"nominal\"", "\"events_lost\": 0"});
  assert_has_all(output(), {"p99.99", "step.model", "row.recorder", "rung nominal"});
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_run_whose_arm_does_not_follow_ends_with_the_cause_once_the_arm_is_at_rest),
      cmocka_unit_test(a_block_that_ends_the_chain_is_named),
      cmocka_unit_test(a_reference_that_is_not_held_is_told_with_joint_or_axis_value_and_limit),
      cmocka_unit_test(a_run_whose_time_has_passed_brakes_the_arm_before_it_ends),
      cmocka_unit_test(an_interrupt_brakes_the_arm_before_the_run_ends),
      cmocka_unit_test(the_summary_tells_the_times_of_every_block_and_row),
  };
  return run_program_tests(argv[0], tests);
}
