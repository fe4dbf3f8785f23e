// Tests that `check` finds what holds an arm of torques at the places of its path: a weight that a
// joint cannot carry, and a box in the way. A run finds the same, when it is there.
#include <cmath>
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Stretches the arm forwards, slowly: then weight alone decides.
constexpr const char* kStretched = "20,0,1.3,0,-0.3,0,1.570796,0.785398\n";

/// A pipeline of torques whose tool is that of the plant, and more sections.
Line pipeline(const char* kg, const char* more = "") {
  const std::string text(kPipeline);
  const std::size_t plant = text.find("[plant]\n");
  const std::string tool = std::string("tool_mass = ") + kg + "\ntool_com = 0 0 0.1\n";
  const std::string payload =
      std::string("[plant]\npayload_kg = ") + kg + "\npayload_com = 0 0 0.1\n";
  const std::size_t model = text.find("[model]\ntype = robot_model\n");
  return write("torque.ini", {text.substr(0, plant).c_str(), tool.c_str(), payload.c_str(),
                              text.substr(plant + 8, model - plant - 8).c_str(),
                              "[model]\ntype = robot_model\ntool = robot.tool\n",
                              text.substr(model + 27).c_str(), more});
}

int check(const Line& file, const Line& trajectory) {
  return tactus_run({"check", file.c_str(), "--trajectory", trajectory.c_str()});
}

/// Runs it until it stops; returns the time of the event that begins with `cause`, s.
double stop_s(const Line& file, const Line& trajectory, const char* cause) {
  const Line out = in_folder("torque");
  assert_int_equal(tactus_run({"run", file.c_str(), "--trajectory", trajectory.c_str(),
                               "--no-figure", "--out", out.c_str()}),
                   1);
  const std::string told(output());
  const std::size_t at = told.find(cause);
  assert_true(at != std::string::npos);
  return std::atof(told.c_str() + told.rfind('\n', at));
}

// Proves RUN-26.

void a_weight_that_a_joint_cannot_carry_is_named_where_a_run_stops(void**) {
  const Line path = write("stretch.csv", {kHeader, kStretched});
  int refused = 0, accepted = 0;
  for (const char* kg : {"0.5", "1", "2", "3", "6", "7", "8", "10"}) {
    const Line file = pipeline(kg);
    const bool goes = check(file, path) == 0;
    ++(goes ? accepted : refused);
    if (goes) {
      const Line out = in_folder("torque");
      assert_int_equal(tactus_run({"run", file.c_str(), "--trajectory", path.c_str(), "--no-figure",
                                   "--out", out.c_str()}),
                       0);
      continue;
    }
    const double at_s = number_after(errors(), "the run would stop at t = ");
    const double torque = number_after(errors(), "(fer_joint2) takes ");
    assert_true(std::abs(torque) > 87.0);
    assert_true(has(errors(), "its limit is 87: look at the tool's mass"));
    const double stopped_s = stop_s(file, path, "limiting: ");
    print_message("%s kg: refused at %g s, stopped at %g s\n", kg, at_s, stopped_s);
    ASSERT_NEAR(stopped_s, at_s, 0.3);
  }
  assert_in_range(accepted, 3, 5);
  assert_in_range(refused, 3, 5);
}

/// Its guard has nothing to limit, and a run stays behind.
void a_law_that_ends_its_torque_by_itself_hides_no_weight(void**) {
  const Line path = write("stretch.csv", {kHeader, kStretched});
  for (const char* kg : {"1", "8", "10"}) {
    const Line file = pipeline(kg);
    assert_succeeds("sed -i 's/^type = pd_gravity/type = pid\\nki = 0/' $S/torque.ini");
    const bool goes = check(file, path) == 0;
    assert_true(goes == (std::atof(kg) < 2.0));
    assert_true(goes || has(errors(), "joint 2 (fer_joint2) takes at least 87 N m to be held"));
    const Line out = in_folder("pid");
    const int code = tactus_run(
        {"run", file.c_str(), "--trajectory", path.c_str(), "--no-figure", "--out", out.c_str()});
    assert_int_equal(code, goes ? 0 : 1);
  }
}

void a_box_in_the_way_of_an_arm_of_torques_is_named_before_anything_moves(void**) {
  const Line path = write("stretch.csv", {kHeader, kStretched});
  const Line file = pipeline(
      "0.5", "[shelf]\ntype = box\ncentre = 0.75 0 0.3\nsize = 0.1 0.3 0.1\n[collision]\n");
  assert_int_equal(check(file, path), 2);
  const double at_s = number_after(errors(), "the run would stop at t = ");
  assert_true(has(errors(), " s: collision (77)\n  shelf with "));
  const double stopped_s = stop_s(file, path, "row: ");
  print_message("refused at %g s, stopped at %g s\n", at_s, stopped_s);
  ASSERT_NEAR(stopped_s, at_s, 0.3);
}

void what_wrenches_do_is_not_rehearsed_and_that_is_said(void**) {
  assert_int_equal(tactus_run({"check", "pipelines/fer_trg_ac_cpc_pid.ini"}), 0);
  assert_true(has(errors(), "fer_table.csv: note: not rehearsed: what its wrenches do depends"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_weight_that_a_joint_cannot_carry_is_named_where_a_run_stops),
      cmocka_unit_test(a_law_that_ends_its_torque_by_itself_hides_no_weight),
      cmocka_unit_test(a_box_in_the_way_of_an_arm_of_torques_is_named_before_anything_moves),
      cmocka_unit_test(what_wrenches_do_is_not_rehearsed_and_that_is_said),
  };
  return run_program_tests(argv[0], tests);
}
