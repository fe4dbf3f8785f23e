// Tests the boxes and allowed pairs of a pipeline file. Its mistakes are in tests/refused.
#include <cstdio>

#include "tests/load/loader_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves COL-5.

/// Boxes of the file, the second in a rotated frame.
void the_file_says_boxes_and_pairs(void**) {
  static LoaderBench bench;
  static std::array<char, 1024> text;
  std::snprintf(text.data(), text.size(),
                "[robot]\nname = %s\nperiod_us = 1000\ntau_c = robot.tau\n"
                "[cell]\ntype = frame\nposition = 1 2 3\nrotation = 0 0 1.5707963267948966\n"
                "[floor]\ntype = box\ncentre = 0 0 -0.1\nsize = 2 3 0.2\n"
                "[post]\ntype = box\nframe = cell.x\ncentre = 0.5 0 0\nsize = 0.1 0.2 1\n"
                "[collision]\nmargin = 0.02\ncycles = 2\nlateness = 0\n"
                "allow = floor %s,  tool post\n",
                Robot::kName, RobotCapsules::kLinkNames[1]);
  ASSERT_OK(bench.load(text.data()));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  const CollisionSection& section = bench.pipeline.collision;
  assert_true(section.margin == 0.02);
  assert_int_equal(section.cycles, 2);
  const CollisionScene& scene = section.scene;
  assert_int_equal(scene.box_count(), 2);
  assert_string_equal(scene.names[kFirstBoxBody], "floor");
  assert_string_equal(scene.names[kFirstBoxBody + 1], "post");
  assert_true(scene.boxes[0]->size == Vector3(2.0, 3.0, 0.2));
  ASSERT_NEAR((scene.boxes[1]->pose.p - Vector3(1.0, 2.5, 3.0)).norm(), 0.0, 1e-15);
  ASSERT_NEAR((scene.boxes[1]->pose.r * Vector3::UnitX() - Vector3::UnitY()).norm(), 0.0, 1e-15);
  int allowed = 0;
  for (const auto& row : scene.allowed)
    for (const bool pair : row) allowed += pair;
  assert_int_equal(allowed, 4);
  assert_true(scene.allowed[1][kFirstBoxBody] && scene.allowed[kFirstBoxBody + 1][kToolBody]);
}

/// The guard's limit, or less if a law that brakes by itself uses less.
void without_a_braking_in_the_file_every_joint_brakes_as_the_arm_does(void**) {
  constexpr struct {
    const char* lines;  // of the law, and of [collision] after it
    double braking;     // rad/s^2
  } kFiles[] = {{"[collision]\n", 3.0},
                {"max_acceleration = 2\n[collision]\n", 2.0},
                {"max_acceleration = 4\n[collision]\n", 3.0},
                {"[collision]\nbraking = 1\n", 1.0}};
  for (const auto& file : kFiles) {
    static LoaderBench bench;
    static std::array<char, 1024> text;
    std::snprintf(text.data(), text.size(),
                  "[robot]\nname = %s\nperiod_us = 1000\nq_c = cpc.q_c\n"
                  "[guard]\nmax_acceleration = 3\n"
                  "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
                  "[cpc]\ntype = cartesian_pose\nx_d = model.x\nx = model.x\nJ = model.J\n"
                  "q = robot.q\nposition_gain = 9 9 9\nrotation_gain = 9 9 9\n%s",
                  Robot::kName, file.lines);
    Capabilities positions = kTorqueRobot;
    positions.position = true;
    const Status status = bench.load(text.data(), positions);
    if (status != Status::kOk) print_error("%s\n", bench.error.message().c_str());
    ASSERT_OK(status);
    const JointVector& braking = bench.pipeline.collision.braking;
    assert_true(braking == JointVector::Constant(file.braking));
  }
}

void without_the_section_nothing_is_checked(void**) {
  static LoaderBench bench;
  static std::array<char, 256> text;
  std::snprintf(text.data(), text.size(),
                "[robot]\nname = %s\nperiod_us = 1000\ntau_c = robot.tau\n"
                "[floor]\ntype = box\ncentre = 0 0 -0.1\nsize = 2 3 0.2\n",
                Robot::kName);
  ASSERT_OK(bench.load(text.data()));
  assert_int_equal(bench.pipeline.schedule.count(), 2);  // control and recorder
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_file_says_boxes_and_pairs),
      cmocka_unit_test(without_a_braking_in_the_file_every_joint_brakes_as_the_arm_does),
      cmocka_unit_test(without_the_section_nothing_is_checked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
