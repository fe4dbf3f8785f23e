// Tests the loader: a good file becomes the pipeline it describes, a bad file is refused at its
// mistake.
#include <cstring>
#include <string>

#include "tests/load/loader_bench.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

LoaderBench bench;

/// The valid file with one change.
std::string_view with(std::string_view from, std::string_view to) {
  const std::string_view text = edit(kValid, from, to);
  assert_false(text.empty());
  return text;
}

// Proves CFG-1.

void settings_arrive_in_their_sections(void**) {
  ASSERT_OK(bench.load(kValid));
  const Pipeline& pipeline = bench.pipeline;
  assert_int_equal(pipeline.robot.period_us, 2000);
  assert_true(pipeline.robot.tool_tip == Vector3(0.1, 0.0, -0.2));
  assert_true(pipeline.guard.limits.dq_max == JointVector::Constant(1.0));
  assert_true(pipeline.guard.limits.tau_max[3] == 50.0 && pipeline.guard.limits.tau_max[6] == 8.0);
  assert_int_equal(pipeline.executive.max_slip, 7);
  assert_int_equal(pipeline.executive.max_overruns, 2);
  assert_int_equal(pipeline.executive.overrun_window, 50);
  assert_int_equal(pipeline.executive.clean_cycles, 300);
  assert_int_equal(pipeline.executive.stop_ms, 700);
  assert_int_equal(pipeline.executive.rest_ms, 50);
  assert_true(pipeline.executive.rest_velocity == 0.02);
  assert_int_equal(bench.board.plant.delay_cycles, 3);
  assert_true(bench.board.plant.friction == 0.0);
  assert_string_equal(bench.board.gateway.trajectory.c_str(), "a b.csv");
  assert_true(bench.board.gateway.interpolation == Interpolation::kQuintic);
  assert_int_equal(pipeline.recorder.divisor, 5);
  assert_int_equal(pipeline.recording.signal_count, 3);
  assert_true(pipeline.recording.signals[1] == pipeline.ports.find("stiff.tau"));
  assert_int_equal(pipeline.recording.tracking_count, 1);
  assert_true(pipeline.recording.tracking[0].measured == pipeline.ports.find("robot.q"));
}

void a_setting_left_out_keeps_its_default(void**) {
  ASSERT_OK(bench.load(kValid));
  const Tool given = bench.pipeline.robot.given_tool();
  assert_true(std::isnan(given.mass_kg) && given.com.hasNaN() && !given.tip.p.hasNaN());
  assert_true(assumed(given).mass_kg == 0.0 && assumed(given).com == Vector3::Zero());
  assert_true(bench.pipeline.guard.limits.ddq_max == JointLimits().ddq_max);
  assert_true(bench.board.plant.initial_q == ready_pose());
  assert_true(bench.board.gateway.settle_s == 2.0);
}

void without_a_list_every_output_that_can_be_recorded_is(void**) {
  ASSERT_OK(bench.load(with("signals = robot.q stiff.tau model.x\n", "")));
  // robot: q dq tau speed_scaling, no sensor; model: x v g; jrg: q_d dq_d ddq_d tau_d x_d v_d; two
  // laws: tau
  assert_int_equal(bench.pipeline.recording.signal_count, 15);
}

void values_arrive_at_the_inputs_they_are_wired_to_in_the_same_cycle(void**) {
  ASSERT_OK(bench.load(kValid));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  const JointVector gravity = bench.joints("model.g");
  assert_true(gravity.norm() > 10.0);
  assert_true(bench.pipeline.robot.command().value == gravity);

  ASSERT_OK(bench.pipeline.step(state_at(0.01, 0.1)));
  for (int i = 0; i < kDof; ++i) {
    const double soft = -10.0 * 0.01 - (i + 1.0) * 0.1 + bench.joints("model.g")[i];
    ASSERT_NEAR(bench.joints("soft.tau")[i], soft, 1e-12);
    ASSERT_NEAR(bench.joints("stiff.tau")[i], soft - 100.0 * 0.01 - 10.0 * 0.1, 1e-12);
  }
  assert_true(bench.pipeline.robot.mode() == CommandMode::kEffort);
  assert_true(bench.pipeline.robot.command().value == bench.joints("stiff.tau"));
}

void an_optional_input_left_out_reads_zero(void**) {
  ASSERT_OK(bench.load(with("g = soft.tau\n", "")));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  assert_true(bench.joints("stiff.tau").isZero(0.0) && !bench.joints("soft.tau").isZero(0.0));
}

/// Bare and upright, a model may do without.
void a_model_knows_the_tool_and_the_mounting_that_the_file_states(void**) {
  const std::string bare(edit(kValid, "tool = robot.tool\n", ""));
  ASSERT_STATUS(bench.load(bare), Status::kMissingKey);
  assert_string_equal(
      bench.error.message().c_str(),
      "17: [model] tool: [robot] gives a tool or a mounting; add tool = robot.tool");
  for (const char* stated : {"mounting = 3.1416 0 0", "tool_mass = 0.1", "mounting = 0 0 1"}) {
    const std::string_view without = edit(bare, "tool_tip = 0.1 0 -0.2", stated);
    const bool matters = std::string_view(stated) != "mounting = 0 0 1";
    assert_int_equal(bench.load(without) == Status::kMissingKey, matters);
  }
  ASSERT_STATUS(bench.load(with("tool_tip = 0.1 0 -0.2", "mounting = 0 4 0")), Status::kBadValue);
}

void the_generator_gets_the_channel_of_the_board(void**) {
  ASSERT_OK(bench.load(kValid));
  assert_true(bench.pipeline.takes_joints);
  ASSERT_OK(bench.load("[robot]\nname = fer\nperiod_us = 1000\ntau_c = robot.tau\n"));
  assert_false(bench.pipeline.takes_joints);
}

void a_robot_is_commanded_in_what_it_takes(void**) {
  ASSERT_OK(bench.load(with("tau_c = stiff.tau", "q_c = jrg.q_d"), {true, false, false, 1, 10000}));
  assert_true(bench.pipeline.robot.mode() == CommandMode::kPosition);
  ASSERT_OK(
      bench.load(with("tau_c = stiff.tau", "dq_c = jrg.dq_d"), {false, true, false, 1, 9999}));
  assert_true(bench.pipeline.robot.mode() == CommandMode::kVelocity);
  ASSERT_STATUS(bench.load(kValid, {true, true, false, 100, 10000}), Status::kNotOffered);
  assert_string_equal(bench.error.message().c_str(),
                      "5: [robot] tau_c: the robot does not take this kind of command");
  for (const char* command : {"q_c = jrg.q_d", "dq_c = jrg.dq_d"})
    ASSERT_STATUS(bench.load(with("tau_c = stiff.tau", command)), Status::kNotOffered);
}

void a_robot_is_fed_what_it_takes(void**) {
  const Capabilities kBoth = {true, true, false, 1, 10000, false, true, true};
  ASSERT_OK(bench.load(with("tau_c = stiff.tau", "q_c = jrg.q_d\ndq_ff = jrg.dq_d"), kBoth));
  assert_true(bench.pipeline.robot.dq_ff.wired() && !bench.pipeline.robot.tau_ff.wired());
  ASSERT_OK(bench.load(with("tau_c = stiff.tau", "dq_c = jrg.dq_d\ntau_ff = stiff.tau"), kBoth));
  assert_true(bench.pipeline.robot.tau_ff.wired());
  for (const char* fed : {"q_c = jrg.q_d\ndq_ff = jrg.dq_d", "q_c = jrg.q_d\ntau_ff = stiff.tau"}) {
    ASSERT_STATUS(bench.load(with("tau_c = stiff.tau", fed), {true, true, true, 1, 10000}),
                  Status::kNotOffered);
    assert_non_null(std::strstr(bench.error.message().c_str(),
                                "_ff: the robot does not take this feed-forward"));
  }
}

void a_sensor_the_robot_does_not_have_is_not_read(void**) {
  Capabilities sensing = kTorqueRobot;
  sensing.wrench = true;
  const std::string_view recorded = with("signals = robot.q", "signals = robot.ft");
  ASSERT_OK(bench.load(recorded, sensing));
  ASSERT_STATUS(bench.load(recorded, kTorqueRobot), Status::kNotOffered);
  assert_string_equal(bench.error.message().c_str(),
                      "54: [recorder] signals: robot.ft: the robot has no such sensor");
  // No block accepts a sensor's wrench as a joint vector, with or without the sensor.
  const std::string_view wired = with("q = robot.q", "q = robot.ft");
  ASSERT_STATUS(bench.load(wired, sensing), Status::kWrongQuantity);
  ASSERT_STATUS(bench.load(wired, kTorqueRobot), Status::kNotOffered);
  assert_string_equal(bench.error.message().c_str(),
                      "19: [model] q: robot.ft: the robot has no such sensor");
}

void line_ends_blanks_marks_and_comments_make_no_difference(void**) {
  const std::string_view plain = "[robot]\nname = fer\nperiod_us = 1000\ntau_c = robot.tau\n";
  for (const std::string_view text :
       {plain, plain.substr(0, plain.size() - 1),
        std::string_view("[robot]\r\nname = fer\r\nperiod_us = 1000\r\ntau_c = robot.tau\r\n"),
        std::string_view("\t[ robot ]\n\tname\t=\tfer\t\n  period_us=1000\n tau_c =robot.tau"),
        std::string_view("\xef\xbb\xbf[robot]\nname = fer\nperiod_us = +1000\ntau_c = robot.tau\n"),
        std::string_view("# Größe: µm\n\n[robot] # Roboter, 机器人\nname = fer#\n#x = y\n \t \n"
                         "period_us = 1000 # µs\ntau_c = robot.tau # [pd]")}) {
    ASSERT_OK(bench.load(text));
    assert_int_equal(bench.pipeline.robot.period_us, 1000);
    assert_true(bench.pipeline.robot.tau_c.wired());
  }
}

// Proves CFG-5.

void tightened_limits_are_those_references_are_judged_by(void**) {
  ASSERT_OK(bench.load(kValid));
  const AdmissionSettings<JointSpace>& settings = bench.channel.settings;
  assert_true(settings.limits.dq_max == JointVector::Constant(1.0));
  ASSERT_NEAR(settings.limits.q_max[0], 2.8973 - 0.1, 1e-15);
  ASSERT_NEAR(settings.limits.q_min[3], -3.0718 + 0.1, 1e-15);
  ASSERT_NEAR(settings.period_s, 0.002, 1e-18);
}

// Proves SCH-2.

void the_schedule_has_the_control_chain_and_the_recorder(void**) {
  ASSERT_OK(bench.load(kValid));
  const Schedule& schedule = bench.pipeline.schedule;
  assert_int_equal(schedule.count(), 2);
  assert_string_equal(schedule[0].name, "control");
  assert_true(schedule[0].divisor == 1 && schedule[0].offset == 0 && !schedule[0].optional);
  assert_int_equal(schedule[0].budget_us, 1500);
  assert_string_equal(schedule[1].name, "recorder");
  assert_true(schedule[1].divisor == 5 && schedule[1].offset == 3 && schedule[1].optional);
  assert_int_equal(schedule[1].budget_us, 400);
  ASSERT_OK(bench.load(with("budget_us = 1500\n", "")));
  assert_int_equal(bench.pipeline.schedule[0].budget_us, 1000);  // half the period
}

void a_schedule_that_cannot_be_met_is_refused_with_its_frame(void**) {
  ASSERT_STATUS(bench.load(with("budget_us = 400", "budget_us = 501")), Status::kOverBudget);
  assert_string_equal(
      bench.error.reason.c_str(),
      "frame 3 of 5: control 1500 + recorder 501 = 2001 us, more than the period of 2000 us");
}

// Proves CFG-2, CFG-5, SCH-2.

void every_case_with_a_mistake_is_refused_with_its_message(void**) {
  const int count = judge_cases("tests/refused/pipelines", [](const FileCase& file) {
    return bench.load(file.text) == bench.error.status && bench.error.status != Status::kOk &&
           file.expects(bench.error.message());
  });
  assert_true(count >= 212);
}

void a_file_of_no_bytes_is_refused(void**) {
  for (const char* text : {"", "\n", "\xef\xbb\xbf", "\r\n\r\n", "# only a comment"}) {
    ASSERT_STATUS(bench.load(text), Status::kBadSyntax);
    assert_string_equal(bench.error.message().c_str(), "the file is empty: it has no section");
  }
}

void the_first_mistake_is_the_one_reported(void**) {
  ASSERT_STATUS(bench.load(with("kp = 10\nkd = 1 2 3", "kp = x\nkd = y 2 3")), Status::kBadValue);
  assert_string_equal(bench.error.message().c_str(), "31: [soft] kp: 'x' is not a finite number");
}

void the_longest_value_is_quoted_whole(void**) {
  static char line[256] = "kp = ";
  std::memset(line + 5, 'x', kMaxValueLength);
  ASSERT_STATUS(bench.load(with("kp = 10", line)), Status::kBadValue);
  const Message& reason = bench.error.reason;
  assert_non_null(std::strstr(reason.c_str(), line + 5));
  assert_non_null(std::strstr(bench.error.message().c_str(), "x' is not a finite number"));
}

// Proves CFG-3.

void a_refused_file_leaves_the_channel_as_it_was(void**) {
  ASSERT_STATUS(bench.load(with("tracking = jrg.q_d robot.q", "tracking = jrg.q_d")),
                Status::kBadValue);
  assert_true(bench.channel.settings.period_s == 0.0);
  assert_true(bench.channel.settings.limits.dq_max == JointLimits().dq_max);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(settings_arrive_in_their_sections),
      cmocka_unit_test(a_setting_left_out_keeps_its_default),
      cmocka_unit_test(without_a_list_every_output_that_can_be_recorded_is),
      cmocka_unit_test(values_arrive_at_the_inputs_they_are_wired_to_in_the_same_cycle),
      cmocka_unit_test(an_optional_input_left_out_reads_zero),
      cmocka_unit_test(a_model_knows_the_tool_and_the_mounting_that_the_file_states),
      cmocka_unit_test(the_generator_gets_the_channel_of_the_board),
      cmocka_unit_test(a_robot_is_commanded_in_what_it_takes),
      cmocka_unit_test(a_robot_is_fed_what_it_takes),
      cmocka_unit_test(a_sensor_the_robot_does_not_have_is_not_read),
      cmocka_unit_test(line_ends_blanks_marks_and_comments_make_no_difference),
      cmocka_unit_test(tightened_limits_are_those_references_are_judged_by),
      cmocka_unit_test(the_schedule_has_the_control_chain_and_the_recorder),
      cmocka_unit_test(a_schedule_that_cannot_be_met_is_refused_with_its_frame),
      cmocka_unit_test(every_case_with_a_mistake_is_refused_with_its_message),
      cmocka_unit_test(a_file_of_no_bytes_is_refused),
      cmocka_unit_test(the_first_mistake_is_the_one_reported),
      cmocka_unit_test(the_longest_value_is_quoted_whole),
      cmocka_unit_test(a_refused_file_leaves_the_channel_as_it_was),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
