// Tests scripts/robot-import: the robot that it writes is that of the URDF, as MuJoCo reads the
// URDF itself; and what it refuses.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Writes arm.urdf, an arm whose frames and axes point anywhere.
int write_urdf(void**) {
  setenv("OPTIONS",
         "--name odd --root $S/tree --acceleration 8 --jerk 800 --torque-rate 2500 "
         "--tip-limits 1 5 500 2 8 800 100 20",
         1);
  return shell("mkdir $S/tree && /usr/bin/python3 tests/scripts/odd_arm.py $S");
}

// Proves IMP-1.

void the_example_of_the_page_imports(void**) {
  assert_succeeds(
      "command=$(sed -n '/^```sh/,/^```/{/^scripts/p}' docs/robots/import.md) && "
      "cd $S && eval \"$R/$command --root $S/tree\"");
  assert_has_all(output(), {"capsule of link3, mesh link.stl: at most ",
                            "home, chosen: ", "wrote boards/odd_sim/board.mk"});
}

void the_model_is_what_mujoco_reads_from_the_urdf(void**) {
  assert_succeeds(
      "g++ -std=c++17 -O1 -I$S/tree -I. -isystem /usr/include/eigen3 -DEIGEN_DONT_VECTORIZE "
      "-include kernel/core/build.hpp -DTACTUS_ROBOT=Odd "
      "-DTACTUS_ROBOT_TABLES='\"kernel/robots/odd_capsules.hpp\"' tests/scripts/against_urdf.cpp "
      "-o $S/against_urdf -lmujoco && cd $S && ./against_urdf arm.urdf");
  print_message("%.*s", static_cast<int>(output().size()), output().data());
}

void the_home_pose_is_that_of_the_srdf(void**) {
  write("arm.srdf", {"<robot name=\"odd\"><group_state name=\"home\" group=\"arm\">",
                     "<joint name=\"joint1\" value=\"0.1\"/><joint name=\"joint2\" value=\"0\"/>",
                     "<joint name=\"joint3\" value=\"0.2\"/><joint name=\"joint4\" value=\"0\"/>",
                     "<joint name=\"joint5\" value=\"-0.3\"/><joint name=\"joint6\" value=\"0\"/>",
                     "</group_state></robot>"});
  assert_succeeds("eval scripts/robot-import $S/arm.urdf --srdf $S/arm.srdf $OPTIONS --force");
  assert_true(has(output(), "home, group_state home: 0.1 0 0.2 0 -0.3 0 rad or m"));
  assert_succeeds("grep '{0.1, 0.0, 0.2, 0.0, -0.3, 0.0}' $S/tree/sim_plant/arm/odd_mjcf.cpp");
}

void a_home_pose_need_not_be_clearer_than_the_arm_can_be(void**) {
  assert_succeeds(
      "sed 's/<sphere radius=\"[^\"]*\"/<sphere radius=\"0.09\"/' $S/arm.urdf > $S/thick.urdf && "
      "eval scripts/robot-import $S/thick.urdf $OPTIONS --force");
  assert_true(has(output(), " 14 mm clear\nwarning: [collision] with its margin"));
}

void the_tip_that_a_refusal_proposes_is_imported(void**) {
  assert_succeeds(
      "sed '/\"grip\"/,/origin/s/rpy=\"[^\"]*\"/rpy=\"0.5 0.4 0.3\"/' $S/arm.urdf > $S/askew.urdf; "
      "eval scripts/robot-import $S/askew.urdf $OPTIONS --force 2> $S/refusal; "
      "origin=$(grep -o '<origin.*/>' $S/refusal) && sed \"s|</robot>|<link name='tool0'/>"
      "<joint name='turn' type='fixed'>$origin<parent link='hand'/><child link='tool0'/></joint>"
      "</robot>|\" $S/askew.urdf > $S/turned.urdf && "
      "eval scripts/robot-import $S/turned.urdf $OPTIONS --force");
}

void an_inertia_that_no_body_has_is_warned_of(void**) {
  assert_succeeds(
      "sed '0,/izz=\"[^\"]*\"/s//izz=\"9\"/' $S/arm.urdf > $S/unreal.urdf && "
      "eval scripts/robot-import $S/unreal.urdf $OPTIONS --force");
  assert_true(has(output(), "warning: link link1, inertia: its principal moments "));
}

/// A URDF that is changed by sed, the options, and what the refusal says.
struct Refusal {
  const char *change, *options, *said;
};

// Proves IMP-2.

constexpr const char* kTwoEnds =
    "s|</robot>|<link name=\"end\"/><joint name=\"other\" type=\"fixed\"><parent link=\"base\"/>"
    "<child link=\"end\"/></joint></robot>|";
constexpr const char* kClosed =
    "s|</robot>|<joint name=\"bar\" type=\"fixed\"><parent link=\"base\"/>"
    "<child link=\"link4\"/></joint></robot>|";

constexpr Refusal kRefusals[] = {
    {"s/ velocity=\"2\"//", "",
     "joint joint1: <limit> has no velocity; give it as --limit joint1.velocity=VALUE, rad/s"},
    {"s/ effort=\"120\"//", "--limit joint1.effort=5",
     "joint joint2: <limit> has no effort; give it as --limit joint2.effort=VALUE, N m"},
    {"s/upper=\"2.5\"/upper=\"nan\"/", "", "joint joint1, limit: upper=\"nan\""},
    {"s/upper=\"2.5\"/upper=\"-3\"/", "", "joint joint1: lower -2.6 is not less than upper -3"},
    {"/\"joint2\"/s/revolute/floating/", "", "joint joint2, type floating: "},
    {"/\"joint2\"/s/revolute/planar/", "", "hold it at zero by --fix joint2"},
    {"s/ velocity=\"2\"//", "--limit joint1.velocity=2 --limit joint2.velocity=2",
     "joint joint3: <limit> has no velocity; give it as --limit joint3.velocity=VALUE, m/s"},
    {"/\"joint3\"/s/$/<mimic joint=\"joint2\"\\/>/", "", "joint joint3, mimic: "},
    {"", "--tip link4", "joint joint5, type revolute: it moves, and is not between base and tip"},
    {"", "--fix joint4 --fix joint5 --fix joint6", "3 joints move between base and hand; such"},
    {"", "--tip nowhere", "--tip nowhere: the URDF has no such link; it has base, link1"},
    {kTwoEnds, "", "2 links carry nothing: hand, end; give the end of the chain as --tip"},
    {kClosed, "", "joint bar: link link4 is already the child of joint joint4; a closed chain"},
    {"/\"joint1\"/,/axis/s/rpy=\"[^\"]*\"/rpy=\"0.5 0 0\"/", "", "joint joint1: its axis is at"},
    {"/\"grip\"/,/origin/s/rpy=\"[^\"]*\"/rpy=\"0.5 0.4 0.3\"/", "", "link hand: its x is at"},
    {"s/<mass value=\"1.7\"\\/>/<mass value=\"-1\"\\/>/", "", "mass -1 kg is negative"},
    {"s/iyy=\"[^\"]*\"/iyy=\"-1\"/", "", "link link1, inertia: not positive definite"},
    {"s/link.stl/lost.stl/", "", "link link3, collision 1: "},
    {"s/joint1/a\\&quot;b/", "", "joint 'a\"b': its name is written into sources"},
    {"s/\"joint2\"/\"joint1\"/", "", "joint joint1: there are two of this name"},
    {"s/radius=\"[^\"]*\"/radius=\"-1\"/", "", "radius=\"-1\"; it must be positive"},
    {"s/<sphere radius=\"[^\"]*\"/<sphere radius=\"0.1\"/", "",
     "no home pose is clear of collisions: link5 and tool are at most 3.7 mm apart"},
    {"s/<sphere radius=\"[^\"]*\"/<sphere radius=\"0.1\"/", "--srdf $S/arm.srdf",
     "mm apart, less than 12 mm; give another group_state"},
    {"s/effort=\"[^\"]*\"/effort=\"0.05\"/", "",
     "no home pose can be held: at best the weight takes"},
    {"", "--rotor-inertia -1", "--rotor-inertia -1.0: a finite number"},
    {"", "--root . --name status", "core/status.hpp has a type Status; choose another name"},
    {"s/<robot/<xacro/;s/robot>/xacro>/", "", "expand xacro first"},
    {"", "--jerk 1 2", "--jerk 1.0 2.0: one positive number, or one for each of 6 joints"},
    {"", "--jerk nan", "--jerk nan: one positive number"},
    {"", "--limit joint9.lower=1", "--limit joint9.lower: joint and attribute are needed"},
    {"", "--root . --name agreement", "the build would take tests/model/test_model_agreement.cpp"},
    {"", "", "exists; give --force to replace the robot's files, or another --name"},
};

void what_cannot_be_represented_is_refused_with_its_remedy(void**) {
  for (const Refusal& refusal : kRefusals) {
    setenv("CHANGE", refusal.change, 1);
    setenv("MORE", refusal.options, 1);
    assert_int_equal(shell("sed \"$CHANGE\" $S/arm.urdf > $S/changed.urdf && "
                           "eval scripts/robot-import $S/changed.urdf $OPTIONS $MORE"),
                     2);
    assert_true(has(errors(), refusal.said));
  }
}

void what_a_urdf_never_states_is_asked_for(void**) {
  assert_int_equal(shell("scripts/robot-import $S/arm.urdf --name odd --root $S/tree --force"), 2);
  assert_true(has(errors(), "a URDF states no acceleration; give --acceleration, rad/s^2"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(the_example_of_the_page_imports, write_urdf),
      cmocka_unit_test(the_model_is_what_mujoco_reads_from_the_urdf),
      cmocka_unit_test(the_home_pose_is_that_of_the_srdf),
      cmocka_unit_test(a_home_pose_need_not_be_clearer_than_the_arm_can_be),
      cmocka_unit_test(the_tip_that_a_refusal_proposes_is_imported),
      cmocka_unit_test(an_inertia_that_no_body_has_is_warned_of),
      cmocka_unit_test(what_cannot_be_represented_is_refused_with_its_remedy),
      cmocka_unit_test(what_a_urdf_never_states_is_asked_for),
  };
  return run_program_tests(argv[0], tests);
}
