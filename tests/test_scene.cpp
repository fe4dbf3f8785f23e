// Where the things stand that the paper's tools touch.
#include "sim_plant/scene.hpp"

#include <algorithm>

#include "kernel/describe.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

const Vector3 kHere = Vector3::Zero();

/// How deep a point is in the scene, m.
double depth(const Scene& scene, const Vector3& point) {
  double deepest = -kInfinity;
  for (std::size_t i = 0; i < static_cast<std::size_t>(scene.count); ++i)
    deepest = std::max(deepest, find_touch(scene.boxes[i], point, 0.0).depth);
  return deepest;
}

// Proves SIM-5.

void an_empty_scene_has_no_boxes(void**) {
  assert_int_equal(make_scene(SceneKind::kNone, kHere, 0.01).count, 0);
}

void the_wall_is_met_at_y_080(void**) {
  const Scene wall = make_scene(SceneKind::kWall, kHere, 0.01);
  ASSERT_NEAR(depth(wall, {-0.16354, 0.764, 0.73844}), -0.036, 1e-12);  // where the paper begins
  ASSERT_NEAR(depth(wall, {-0.16354, 0.830, 0.73844}), 0.03, 1e-12);    // and presses
  ASSERT_NEAR(depth(wall, {0.3354, 0.83, 0.73844}), -0.0854, 1e-12);    // past the edge at the end
  ASSERT_NEAR(depth(wall, {0.0, 0.84, 0.0}), 0.0, 1e-12);
  ASSERT_NEAR(depth(wall, {0.0, 0.84, 1.0}), 0.0, 1e-12);
}

void the_ball_meets_the_blackboard_with_the_tip_at_x_0731(void**) {
  for (const double radius : {0.0, 0.01, 0.03}) {
    const Scene board = make_scene(SceneKind::kBlackboard, kHere, radius);
    ASSERT_NEAR(depth(board, {0.730, 0.385, 0.798}) + radius, -0.001, 1e-12);
    for (const double z : {0.798, 0.598})
      ASSERT_NEAR(find_touch(board.boxes[0], {0.734, 0.385, z}, radius).depth, 0.003, 1e-12);
  }
}

// The surface rises by tan 0.21 against x and ends 3 mm below the plateau.
void the_ramp_rises_to_the_plateau(void**) {
  const Scene ramp = make_scene(SceneKind::kRamp, kHere, 0.01);
  assert_int_equal(ramp.count, 2);
  for (const double x : {0.5, 0.18, -0.2}) {
    const double surface = -0.16 + 0.005 / std::cos(0.21) + std::tan(0.21) * (0.18 - x);
    ASSERT_NEAR(depth(ramp, {x, 0.79, surface}), 0.0, 1e-12);
    assert_true(depth(ramp, {x, 0.79, surface + 1e-4}) < 0.0);
  }
  ASSERT_NEAR(depth(ramp, {-0.8, 0.79, -0.05}), 0.0, 1e-12);
  assert_true(depth(ramp, {0.5, 0.79, -0.133}) < -0.08);  // where the paper begins, in the air
  assert_true(depth(ramp, {-1.0, 0.79, -0.133}) > 0.08);  // and ends, pressing
}

void an_offset_moves_every_box(void**) {
  const Vector3 offset(0.1, -0.2, 0.3), point(-0.3, 0.6, -0.2);
  for (const SceneKind kind : {SceneKind::kWall, SceneKind::kBlackboard, SceneKind::kRamp})
    ASSERT_NEAR(depth(make_scene(kind, offset, 0.01), point + offset),
                depth(make_scene(kind, kHere, 0.01), point), 1e-12);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_empty_scene_has_no_boxes),
      cmocka_unit_test(the_wall_is_met_at_y_080),
      cmocka_unit_test(the_ball_meets_the_blackboard_with_the_tip_at_x_0731),
      cmocka_unit_test(the_ramp_rises_to_the_plateau),
      cmocka_unit_test(an_offset_moves_every_box),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
