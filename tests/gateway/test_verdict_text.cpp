// The words in which an operator reads verdicts and statuses.
#include "gateway/verdict_text.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

void assert_tip(const Verdict& verdict, const char* expected) {
  assert_string_equal(describe(verdict, VerdictAxes::kTip).c_str(), expected);
}
void assert_joints(const Verdict& verdict, const char* expected) {
  assert_string_equal(describe(verdict, VerdictAxes::kJoints).c_str(), expected);
}

// Proves RG-6.

void every_status_has_words_of_its_own_and_its_code(void**) {
  int found = 0;
  for (int code = 0; code < 256; ++code) {
    const auto status = static_cast<Status>(code);
    if (std::string_view(name(status)) == "unknown") continue;
    const std::string_view words = meaning(status);
    assert_true(words != "unknown status" && words.substr(0, 1) != "k");
    assert_string_equal(describe(status).c_str(), (Message(words) << " (" << code << ")").c_str());
    for (int other = 0; other < code; ++other)
      assert_true(words != meaning(static_cast<Status>(other)));
    ++found;
  }
  assert_true(found > 60);
}

void a_verdict_on_a_length_names_the_translation_or_the_rotation_and_its_unit(void**) {
  assert_tip({Status::kVelocityLimit, 1, 0, 1.5, 1.0},
             "waypoint 2, translation: velocity 1.5 m/s exceeds 1 m/s (36)");
  assert_tip({Status::kJerkLimit, 1, 3, 1500.0, 1000.0},
             "waypoint 2, rotation: jerk 1500 rad/s^3 exceeds 1000 rad/s^3 (45)");
  assert_tip({Status::kEffortLimit, -1, 0, 120.0, 100.0},
             "translation: effort 120 N exceeds 100 N (38)");
  assert_tip({Status::kQuaternion, 0, 3, 0.9, 0.999},
             "waypoint 1, rotation: length of the quaternion 0.9 is below 0.999 (47)");
}

void a_goal_that_was_missed_is_an_error_of_position_or_a_velocity_and_has_a_remedy(void**) {
  assert_joints({Status::kGoalTolerance, -1, 3, 0.021, 0.01},
                "joint 4 (fer_joint4): position error 0.021 rad exceeds 0.01 rad (50)");
  assert_joints({Status::kGoalVelocity, -1, 3, 0.02, 0.01},
                "joint 4 (fer_joint4): velocity 0.02 rad/s exceeds 0.01 rad/s (58)");
  assert_tip({Status::kGoalTolerance, -1, 3, 0.03, 0.02},
             "rotation: position error 0.03 rad exceeds 0.02 rad (50)");
  for (const Status status :
       {Status::kPathTolerance, Status::kGoalTolerance, Status::kGoalVelocity})
    for (const bool law : {false, true}) {
      const Message said = goal_remedy(status, VerdictAxes::kTip, law);
      assert_int_equal(std::string_view(said).find("of the law") != std::string_view::npos, law);
      assert_false(said.empty());
    }
  assert_true(goal_remedy(Status::kHalted, VerdictAxes::kJoints, true).empty());
}

void a_verdict_on_one_direction_names_it(void**) {
  assert_tip({Status::kWorkspace, 2, 2, -0.1, 0.05},
             "waypoint 3, z: position -0.1 m is below 0.05 m (48)");
  assert_tip({Status::kNotAtRest, 2, 4, 0.2, 0.0},
             "waypoint 3, rotation y: velocity 0.2 rad/s is not zero (39)");
  assert_tip({Status::kReferenceNotFinite, 0, 1, -kInfinity, 0.0},
             "waypoint 1, y: value -inf is not finite (33)");
  assert_tip({Status::kReferenceNotFinite, 0, 3, kRequired, 0.0},
             "waypoint 1, rotation: value nan is not finite (33)");
}

void a_verdict_without_joint_or_value_says_what_it_knows(void**) {
  assert_joints({Status::kReferenceTime, 1, -1, 2.0, 2.000062},
                "waypoint 2: time 2 s is earlier than 2.000062 s (35)");
  assert_joints({Status::kReferenceTime, -1, -1, 90000.0, 86400.0},
                "time 90000 s is later than 86400 s (35)");
  assert_joints({Status::kBadOverride, -1, -1, 1.5, 1.0}, "override 1.5 is not from 0 to 1 (52)");
  assert_joints({Status::kNothingToCancel}, "no reference to cancel (42)");
  assert_joints({Status::kReferenceSize}, "number of waypoints not allowed (32)");
  assert_joints({Status::kNotStreamable, 4},
                "waypoint 5: an open trajectory cannot be monotone (55)");
}

void a_value_that_hardly_exceeds_its_limit_is_told_apart_from_it(void**) {
  assert_joints({Status::kMeasuredVelocityLimit, -1, 3, -2.18, 2.175},
                "joint 4 (fer_joint4): measured velocity -2.18 rad/s exceeds 2.175 rad/s (68)");
  assert_joints({Status::kVelocityLimit, -1, 0, 2.175000002, 2.175},
                "joint 1 (fer_joint1): velocity 2.175000002 rad/s exceeds 2.175 rad/s (36)");
}

void the_time_of_a_waypoint_is_added_if_it_is_known(void**) {
  const Verdict verdict = {Status::kPositionLimit, 1, 3, -3.125, -3.0718};
  assert_string_equal(describe(verdict, VerdictAxes::kJoints, 1.5).c_str(),
                      "waypoint 2 (t = 1.5 s), joint 4 (fer_joint4): position -3.125 rad is below "
                      "-3.0718 rad (34)");
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_status_has_words_of_its_own_and_its_code),
      cmocka_unit_test(a_verdict_on_a_length_names_the_translation_or_the_rotation_and_its_unit),
      cmocka_unit_test(
          a_goal_that_was_missed_is_an_error_of_position_or_a_velocity_and_has_a_remedy),
      cmocka_unit_test(a_verdict_on_one_direction_names_it),
      cmocka_unit_test(a_verdict_without_joint_or_value_says_what_it_knows),
      cmocka_unit_test(a_value_that_hardly_exceeds_its_limit_is_told_apart_from_it),
      cmocka_unit_test(the_time_of_a_waypoint_is_added_if_it_is_known),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
