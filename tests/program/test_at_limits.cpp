// Tests that an arm which is held exactly at a limit, and measured with noise, does not trip the
// guard, and that the margins which allow that are settings.
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Noise of velocity twenty times that of the other tests here.
constexpr const char* kNoise =
    "position_noise_rad = 1e-3\nvelocity_noise_rad_s = 0.02\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "stopped_velocity = 0\n";  // the goal is not what is tested
constexpr const char* kRest = "[executive]\nrest_velocity = 0.02\n";  // as much as the noise
constexpr const char* kRecorder = "[recorder]\nsignals = robot.q robot.dq\n";
constexpr double kFastest = 2.175;   // rad/s, joint 1
constexpr double kHighest = 2.8973;  // rad, joint 1

/// Joint 1 reaches its fastest in half a second, keeps it for half a second, goes on to the end of
/// its range and stays there for a second.
Line trajectory() {
  const double ramp = 0.25 * kFastest, cruise = 0.5 * kFastest;
  const double rest_s = 1.5 * (kHighest - ramp - cruise) / kFastest;
  std::string text(
      "time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,q7_rad,"
      "dq1_rad_s,dq2_rad_s,dq3_rad_s,dq4_rad_s,dq5_rad_s,dq6_rad_s,dq7_rad_s\n");
  const auto add = [&text](double t, double q, double dq) {
    char row[256];
    std::snprintf(row, sizeof row,
                  "%.17g,%.17g,-0.785398,0,-2.356194,0,1.570796,0.785398,%.17g,0,0,0,0,0,0\n", t, q,
                  dq);
    text += row;
  };
  add(1.0, 0.0, 0.0);
  add(1.5, ramp, kFastest);
  add(2.0, ramp + cruise, kFastest);
  add(2.0 + 2.0 * rest_s, kHighest, 0.0);
  add(3.0 + 2.0 * rest_s, kHighest, 0.0);
  return write("limits.csv", {text.c_str()});
}

int run_at_limits(const char* guard) {
  const Line pipeline = write("at.ini", {"[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n",
                                         guard, kRest, "[plant]\n", kNoise, kRecorder});
  const Line csv = trajectory(), out = in_folder("at");
  return tactus_run(
      {"run", pipeline.c_str(), "--trajectory", csv.c_str(), "--no-figure", "--out", out.c_str()});
}

/// The largest value of a column of the log.
double largest(const char* column) {
  const Line command =
      Line("python3 -c \"import csv, os; print('largest', max(float(row['")
      << column << "']) for row in csv.DictReader(open(os.environ['S'] + '/at/log.csv'))))\"";
  assert_succeeds(command.c_str());
  return std::atof(std::string(output().substr(8)).c_str());
}

// Proves GRD-1.

void an_arm_at_its_limits_with_noisy_sensors_is_not_stopped(void**) {
  assert_int_equal(run_at_limits(""), 0);
  assert_true(has(file_of("at/summary.json"), "\"guard\": {\"limited\": 0, \"tripped\": 0}"));
  const double speed = largest("robot.dq_1"), position = largest("robot.q_1");
  assert_true(speed > kFastest + 0.03 && position > kHighest + 1e-3);  // it was at them, and beyond
}

void without_its_margins_it_is(void**) {
  assert_int_equal(run_at_limits("[guard]\nvelocity_allowance = 1e-6\n"), 1);
  assert_true(has(errors(), "stopped: joint 1 (fer_joint1): measured velocity 2."));
  assert_true(has(errors(), "(68)\n"));
  assert_int_equal(run_at_limits("[guard]\nposition_allowance = 1e-6\n"), 1);
  assert_true(has(errors(), "stopped: joint 1 (fer_joint1): measured position 2.89"));
  assert_true(has(errors(), "(67)\n"));
}

/// Joint 1 stands 0.05 rad beyond its range, where a fault has left it.
void an_arm_that_stands_outside_its_range_is_led_back_by_torques_and_by_positions(void**) {
  for (const char* chain :
       {"q_c = jrg.q_d\n[jrg]\ntype = joint_reference_generator\nq = robot.q\n",
        "tau_c = pd.tau\n[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
        "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
        "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
        "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"}) {
    const Line pipeline =
        write("at.ini", {"[robot]\nname = fer\nperiod_us = 1000\n", chain,
                         "[plant]\ninitial_q = 2.9473 -0.785398 0 -2.35619 0 1.5708 0.785398\n"});
    const Line csv = write("in.csv", {kHeader, "2,2.5,-0.785398,0,-2.35619,0,1.5708,0.785398\n"});
    const Line out = in_folder("at");
    assert_int_equal(tactus_run({"run", pipeline.c_str(), "--trajectory", csv.c_str(),
                                 "--no-figure", "--out", out.c_str()}),
                     0);
  }
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_arm_at_its_limits_with_noisy_sensors_is_not_stopped),
      cmocka_unit_test(without_its_margins_it_is),
      cmocka_unit_test(
          an_arm_that_stands_outside_its_range_is_led_back_by_torques_and_by_positions),
  };
  return run_program_tests(argv[0], tests);
}
