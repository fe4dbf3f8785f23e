// What a pipeline file says of boxes and of pairs that may touch. Its mistakes: tests/refused.
#include <cstdio>

#include "tests/loader_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

// Proves COL-5.

/// Boxes in the file, the second in a frame that is turned.
void the_file_says_boxes_and_pairs(void**) {
  static LoaderBench bench;
  static std::array<char, 1024> text;
  std::snprintf(text.data(), text.size(),
                "[robot]\nname = %s\nperiod_us = 1000\ntau_c = robot.tau\n"
                "[cell]\ntype = frame\nposition = 1 2 3\nrotation = 0 0 1.5707963267948966\n"
                "[floor]\ntype = box\ncentre = 0 0 -0.1\nsize = 2 3 0.2\n"
                "[post]\ntype = box\nframe = cell.x\ncentre = 0.5 0 0\nsize = 0.1 0.2 1\n"
                "[collision]\nmargin = 0.02\ndivisor = 3\noffset = 2\n"
                "allow = floor %s,  tool post\n",
                Robot::kName, RobotCapsules::kLinkNames[1]);
  ASSERT_OK(bench.load(text.data()));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  const CollisionSection& section = bench.pipeline.collision;
  assert_true(section.given && section.margin == 0.02);
  assert_int_equal(section.divisor, 3);
  assert_int_equal(section.offset, 2);
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

void without_the_section_nothing_is_checked(void**) {
  static LoaderBench bench;
  static std::array<char, 256> text;
  std::snprintf(text.data(), text.size(),
                "[robot]\nname = %s\nperiod_us = 1000\ntau_c = robot.tau\n"
                "[floor]\ntype = box\ncentre = 0 0 -0.1\nsize = 2 3 0.2\n",
                Robot::kName);
  ASSERT_OK(bench.load(text.data()));
  assert_false(bench.pipeline.collision.given);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_file_says_boxes_and_pairs),
      cmocka_unit_test(without_the_section_nothing_is_checked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
