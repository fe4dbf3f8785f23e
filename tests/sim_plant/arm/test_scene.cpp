// Tests where a ball meets a box, and that the boxes of the scenes are where the paper's tools
// touch them; the expected depths are computed by hand.
#include "sim_plant/arm/scene.hpp"

#include <algorithm>
#include <random>

#include "kernel/core/describe.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const Vector3 kHere = Vector3::Zero();

/// Depth of a point in the scene, m.
double depth(const Scene& scene, const Vector3& point) {
  double deepest = -kInfinity;
  for (std::size_t i = 0; i < static_cast<std::size_t>(scene.count); ++i)
    deepest = std::max(deepest, find_touch(scene.boxes[i], point, 0.0).depth);
  return deepest;
}

/// A box of 2 x 4 x 6 m, pitched by 0.21 rad and translated.
Box pitched_box() {
  Box box;
  box.pose.p = Vector3(0.5, -1.0, 2.0);
  box.pose.r = Eigen::Quaterniond(std::cos(0.105), 0.0, std::sin(0.105), 0.0);
  box.half_extents = Vector3(1.0, 2.0, 3.0);
  return box;
}

void assert_same(const Vector3& actual, const Vector3& expected, double tolerance) {
  ASSERT_NEAR((actual - expected).norm(), 0.0, tolerance);
}

// Proves SIM-5.

void a_ball_is_pushed_away_from_the_face_edge_or_corner_it_meets(void**) {
  const Box box = pitched_box();
  const double s = std::sin(0.21), c = std::cos(0.21);
  Matrix3 axes;  // in the box's axes, by hand
  axes << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector3 side(x, y, z);
        if (side.isZero()) continue;  // 6 faces, 12 edges, 8 corners
        const Vector3 surface = side.cwiseProduct(box.half_extents);
        const Vector3 centre = box.pose.p + axes * (surface + 0.008 * side.normalized());
        const Touch touch = find_touch(box, centre, 0.01);
        assert_same(touch.normal, axes * side.normalized(), 1e-12);
        ASSERT_NEAR(touch.depth, 0.002, 1e-12);
        assert_true(find_touch(box, centre, 0.007).depth < 0.0);
      }
    }
  }
}

void a_centre_inside_is_pushed_out_by_the_nearest_face(void**) {
  const Box box = pitched_box();
  const Touch touch = find_touch(box, box.pose.p + box.pose.r * Vector3(0.2, -1.9, 2.5), 0.01);
  assert_same(touch.normal, -Vector3::UnitY(), 1e-15);
  ASSERT_NEAR(touch.depth, 0.1 + 0.01, 1e-12);
}

void the_depth_changes_by_no_more_than_the_way_of_the_ball(void**) {
  const Box box = pitched_box();
  std::mt19937_64 random(1);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const auto random_vector = [&](double size) {
    const double x = uniform(-size, size), y = uniform(-size, size);
    return Vector3(x, y, uniform(-size, size));
  };
  for (int n = 0; n < 20000; ++n) {
    const Vector3 centre =
        box.pose.p + box.pose.r * (1.2 * random_vector(1.0)).cwiseProduct(box.half_extents);
    const Vector3 way = random_vector(std::pow(10.0, uniform(-9.0, -1.0)));
    const double change =
        find_touch(box, centre + way, 0.01).depth - find_touch(box, centre, 0.01).depth;
    assert_true(std::abs(change) <= way.norm() + 1e-14);
  }
}

void an_empty_scene_has_no_boxes(void**) {
  assert_int_equal(make_scene(SceneKind::kNone, kHere, 0.01).count, 0);
}

void the_wall_is_met_at_y_080(void**) {
  const Scene wall = make_scene(SceneKind::kWall, kHere, 0.01);
  ASSERT_NEAR(depth(wall, {-0.16354, 0.764, 0.73844}), -0.036, 1e-12);  // start of the paper's path
  ASSERT_NEAR(depth(wall, {-0.16354, 0.830, 0.73844}), 0.03, 1e-12);    // pressed
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
  assert_true(depth(ramp, {0.5, 0.79, -0.133}) < -0.08);  // start of the paper's path, in the air
  assert_true(depth(ramp, {-1.0, 0.79, -0.133}) > 0.05);  // end of the path, pressed
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
      cmocka_unit_test(a_ball_is_pushed_away_from_the_face_edge_or_corner_it_meets),
      cmocka_unit_test(a_centre_inside_is_pushed_out_by_the_nearest_face),
      cmocka_unit_test(the_depth_changes_by_no_more_than_the_way_of_the_ball),
      cmocka_unit_test(an_empty_scene_has_no_boxes),
      cmocka_unit_test(the_wall_is_met_at_y_080),
      cmocka_unit_test(the_ball_meets_the_blackboard_with_the_tip_at_x_0731),
      cmocka_unit_test(the_ramp_rises_to_the_plateau),
      cmocka_unit_test(an_offset_moves_every_box),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
