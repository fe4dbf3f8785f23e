// Tests [expect]: a run that has not seen what its file states does not succeed. The force is the
// known bias of the simulated sensor, which is not tared; the error is that of an arm that sags
// under a load of which its law knows nothing.
#include "program/results/tracking_error.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kSensor =
    "[plant]\nft_bias_force_N = 0 0 30\n"
    "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\ntool = robot.tool\n"
    "max_force = 300\nmax_moment = 30\ntare_s = 0\ntime_constant_s = 0\n";
constexpr const char* kRobotText =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";

int run_with(const char* expect) {
  const Line path = write("expect.ini", {kRobotText, kSensor, expect});
  return run_into("expect", path.c_str());
}

// Proves RUN-27.

void a_run_that_has_seen_the_force_succeeds(void**) {
  assert_int_equal(run_with("[expect]\nh = sensor.h\naverage_s = 0\ncontact_force_min = 29.9\n"
                            "contact_force_max = 30.1\n"),
                   0);
  assert_true(has(output(), "expect on fer_sim, 1000 Hz: succeeded\n"));
  assert_true(has(output(),
                  "\n  largest contact force 30 N, expected at least 29.9: as expected\n"
                  "  largest contact force 30 N, expected at most 30.1: as expected\n"));
  assert_true(
      has(file_of("expect/summary.json"), "\"expect\": {\"contact_force_min\": {\"seen\": 30"));
  assert_true(has(file_of("expect/summary.json"), ", \"stated\": 30.1}, \"met\": true}"));
}

void a_run_that_has_not_seen_it_fails_and_says_so_everywhere(void**) {
  assert_int_equal(run_with("[expect]\nh = sensor.h\naverage_s = 0\ncontact_force_min = 31\n"), 1);
  assert_true(has(output(), "expect on fer_sim, 1000 Hz: not as stated\n"));
  assert_true(has(errors(),
                  "expect.ini: [expect] contact_force_min: the largest contact force was 30 N, "
                  "expected at least 31 N: did the tool touch anything?\n"));
  assert_true(has(file_of("expect/summary.json"),
                  "\"result\": {\"code\": 1, \"name\": \"not as stated\"}"));
  assert_true(has(file_of("expect/summary.json"), "\"met\": false}"));
  assert_int_equal(run_with("[expect]\nh = sensor.h\naverage_s = 0\ncontact_force_max = 20\n"), 1);
  assert_true(has(errors(),
                  "contact_force_max: the largest contact force was 30 N, expected at "
                  "most 20 N: "));
}

void an_error_that_is_larger_than_stated_is_no_success(void**) {
  const auto run_loaded = [](const char* bound) {
    const Line path = write(
        "expect.ini",
        {kRobotText, "[plant]\npayload_kg = 2\n[recorder]\ntracking = jrg.q_d robot.q\n[expect]\n",
         bound});
    return run_into("expect", path.c_str());
  };
  assert_int_equal(run_loaded("tracking_rad = 0.5\n"), 0);
  assert_true(has(output(), "rad, expected at most 0.5: as expected\n"));
  assert_int_equal(run_loaded("tracking_rad = 1e-5\n"), 1);
  assert_true(
      has(errors(), "expect.ini: [expect] tracking_rad: the largest error of a joint was "));
  assert_true(has(errors(), " rad, expected at most 1e-05 rad\n"));
  assert_true(has(file_of("expect/summary.json"), "\"stated\": 1e-05}, \"met\": false}"));
  assert_true(std::isnan(larger_error(larger_error(0.1, NAN), 0.2)));
}

/// After 50 ms a low-pass of 0.5 s has reached 1 - exp(-0.1), a tenth.
void a_short_force_does_not_count(void**) {
  assert_int_equal(run_with("[expect]\nh = sensor.h\ncontact_force_min = 3\n"), 1);
  assert_true(has(errors(), "the largest contact force was 2.8"));
}

void a_section_that_cannot_be_judged_is_refused(void**) {
  for (const char* verb : {"run", "check"}) {
    const Line path =
        write("expect.ini", {kRobotText, kSensor, "[expect]\ncontact_force_min = 3\n"});
    assert_int_equal(tactus_run({verb, path.c_str()}), 2);
    assert_true(has(errors(), "expect.ini: [expect] h: the input is not connected"));
  }
  assert_int_equal(
      run_with("[expect]\nh = sensor.h\ncontact_force_min = 5\ncontact_force_max = 4\n"), 2);
  assert_true(has(errors(), "[expect] contact_force_max: 4 N is below contact_force_min, 5 N"));
  assert_int_equal(run_with("[recorder]\ntracking = jrg.q_d robot.q\n[expect]\ntracking_m = 0.1\n"),
                   2);
  assert_true(has(errors(), "[expect] tracking_m: no error of a pose is measured; name the two "));
}

void every_pipeline_that_yields_to_contact_states_it(void**) {
  assert_succeeds(
      "all=$(grep -lE '^type += admittance' pipelines/*.ini) && "
      "stated=$(grep -l '^contact_force_min' $all) && [ \"$all\" = \"$stated\" ]");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_run_that_has_seen_the_force_succeeds),
      cmocka_unit_test(a_run_that_has_not_seen_it_fails_and_says_so_everywhere),
      cmocka_unit_test(an_error_that_is_larger_than_stated_is_no_success),
      cmocka_unit_test(a_short_force_does_not_count),
      cmocka_unit_test(a_section_that_cannot_be_judged_is_refused),
      cmocka_unit_test(every_pipeline_that_yields_to_contact_states_it),
  };
  return run_program_tests(argv[0], tests);
}
