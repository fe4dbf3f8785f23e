// Tests blends between the moves of the emulated controller against the parabola in closed form.
#include "tests/ur/controller/ur_path_bench.hpp"

namespace tactus::ur {
namespace {

using Kind = Move::Kind;

// Proves URE-14.

void two_lines_are_joined_by_a_parabola_within_the_radius(void**) {
  constexpr double kRadius = 0.03;
  Motion motion;
  motion.rest(kPathHome);
  const Vector3 from = forward(kPathHome).p;
  const Frame corner = beside(0.12, 0.0, 0.0), to = beside(0.12, 0.1, 0.04);
  const auto points =
      run_moves(motion, {move_to(Kind::kL, corner, kRadius), move_to(Kind::kL, to, 0.0)});
  const Vector3 u = (corner.p - from).normalized(), w = (to.p - corner.p).normalized();
  const double cosine = u.dot(w);
  int inside = 0;
  double nearest = 1.0;
  for (const PathPoint& point : points) {
    const Vector3 d = forward(point.q).p - corner.p;
    nearest = std::min(nearest, d.norm());
    // d = -alpha r u + beta r w; on the parabola sqrt(alpha) + sqrt(beta) = 1.
    const double du = -d.dot(u), dw = d.dot(w), det = 1.0 - cosine * cosine;
    const double alpha = (du + cosine * dw) / (det * kRadius);
    const double beta = (dw + cosine * du) / (det * kRadius);
    assert_true((d + alpha * kRadius * u - beta * kRadius * w).norm() < 1e-6);
    if (alpha > 1.0 || beta > 1.0) {
      assert_true(std::min(std::abs(alpha), std::abs(beta)) * kRadius < 1e-6);
      continue;
    }
    ++inside;
    ASSERT_NEAR(std::sqrt(std::max(0.0, alpha)) + std::sqrt(std::max(0.0, beta)), 1.0, 2e-3);
    assert_true(d.norm() < kRadius + 1e-6);
    assert_true((jacobian(point.q, {}) * point.dq).head<3>().norm() > 0.05);
  }
  assert_true(inside > 20 && nearest > 0.005);
  assert_true((forward(points.back().q).p - to.p).norm() < 1e-7);
  check_smooth(points);
}

/// The tool's acceleration in the blend must not exceed that of the moves.
void a_blend_keeps_the_acceleration_of_its_moves(void**) {
  for (const double turn : {0.2, 1.0, 2.0, 3.0}) {
    Motion motion;
    motion.rest(kPathHome);
    const Frame corner = beside(0.1, 0.0, 0.0);
    const Frame to = beside(0.1 + 0.1 * std::cos(turn), 0.1 * std::sin(turn), 0.0);
    const auto points = run_moves(
        motion, {move_to(Kind::kL, corner, 0.02, 0.4, 1.0), move_to(Kind::kL, to, 0.0, 0.4, 1.0)});
    Vector3 before = Vector3::Zero();
    for (const PathPoint& point : points) {
      const Vector3 v = (jacobian(point.q, {}) * point.dq).head<3>();
      assert_true((v - before).norm() <= 1.01 * kPathCycle_s * 1.0 + 1e-6);
      before = v;
    }
  }
}

void joints_blend_within_the_radius_and_their_acceleration(void**) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  for (int trial = 0; trial < 40; ++trial) {
    Motion motion;
    motion.rest(kPathHome);
    Joints corner = kPathHome, to = kPathHome;
    for (int i = 0; i < 6; ++i) {
      corner[i] += uniform(random);
      to[i] += 2.0 * uniform(random);
    }
    const double r = 0.04;
    const auto points = run_moves(motion, {move_joints(corner, r), move_joints(to, 0.0)});
    double nearest = 1.0;
    for (const PathPoint& point : points) {
      const double away = (forward(point.q).p - forward(corner).p).norm();
      nearest = std::min(nearest, away);
      if (away < r + 1e-9) continue;
      // Outside the radius the joints stay on one of the two moves.
      const auto off = [&](const Joints& a, const Joints& b) {
        const Joints u = (b - a).normalized();
        return ((point.q - a) - u.dot(point.q - a) * u).norm();
      };
      assert_true(std::min(off(kPathHome, corner), off(corner, to)) < 1e-9);
    }
    assert_true(nearest < r);
    assert_true(check_smooth(points) <= 1.4 * 1.001);
    assert_true(points.back().q == to);
  }
}

void without_a_next_move_the_arm_stops_at_the_point(void**) {
  Motion motion, plain;
  motion.rest(kPathHome);
  plain.rest(kPathHome);
  const Frame target = beside(0.1, 0.05, 0.0);
  const auto blended = run_moves(motion, {move_to(Kind::kL, target, 0.03)});
  const auto stopped = run_moves(plain, {move_to(Kind::kL, target, 0.0)});
  assert_int_equal(blended.size(), stopped.size());
  for (std::size_t k = 0; k < blended.size(); ++k)
    assert_true((blended[k].q - stopped[k].q).cwiseAbs().maxCoeff() < 1e-9);
}

/// A move that arrives when the arm is within the radius waits until the arm has stopped at the
/// point.
void a_move_that_comes_too_late_begins_at_the_point(void**) {
  Motion motion;
  motion.rest(kPathHome);
  const Frame corner = beside(0.1, 0.0, 0.0), to = beside(0.1, 0.1, 0.0);
  assert_true(motion.move(move_to(Kind::kL, corner, 0.03)));
  while (motion.busy()) motion.advance(kPathCycle_s);
  while ((forward(motion.q()).p - corner.p).norm() > 0.025) motion.idle(kPathCycle_s, true);
  assert_true(motion.arriving() && !motion.resting());
  assert_true(motion.move(move_to(Kind::kL, to, 0.0)));
  double nearest = 1.0;
  while (motion.busy()) {
    motion.advance(kPathCycle_s);
    nearest = std::min(nearest, (forward(motion.q()).p - corner.p).norm());
  }
  assert_true(nearest < 1e-7);
  assert_true((forward(motion.q()).p - to.p).norm() < 1e-7);
}

void radii_that_overlap_are_left_out_and_said(void**) {
  const Frame a = beside(0.1, 0.0, 0.0), b = beside(0.1, 0.05, 0.0), c = beside(0.2, 0.05, 0.0);
  const auto nearest_to = [](const std::vector<PathPoint>& points, const Frame& frame) {
    double nearest = 1.0;
    for (const PathPoint& point : points)
      nearest = std::min(nearest, (forward(point.q).p - frame.p).norm());
    return nearest;
  };
  Motion motion;
  motion.rest(kPathHome);
  auto points = run_moves(
      motion, {move_to(Kind::kL, a, 0.03), move_to(Kind::kL, b, 0.03), move_to(Kind::kL, c, 0.0)});
  assert_true(motion.take_overlap());
  assert_false(motion.take_overlap());
  assert_true(nearest_to(points, a) > 0.005 && nearest_to(points, b) < 1e-7);
  motion.rest(kPathHome);
  points = run_moves(motion, {move_to(Kind::kL, a, 0.06), move_to(Kind::kL, b, 0.0)});
  assert_true(motion.take_overlap() && nearest_to(points, a) < 1e-7);
  motion.rest(kPathHome);
  points = run_moves(motion, {move_to(Kind::kL, a, 0.025), move_to(Kind::kL, b, 0.025),
                              move_to(Kind::kL, c, 0.0)});
  assert_false(motion.take_overlap());
  assert_true(nearest_to(points, a) > 0.005 && nearest_to(points, b) > 0.005);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(two_lines_are_joined_by_a_parabola_within_the_radius),
      cmocka_unit_test(a_blend_keeps_the_acceleration_of_its_moves),
      cmocka_unit_test(joints_blend_within_the_radius_and_their_acceleration),
      cmocka_unit_test(without_a_next_move_the_arm_stops_at_the_point),
      cmocka_unit_test(a_move_that_comes_too_late_begins_at_the_point),
      cmocka_unit_test(radii_that_overlap_are_left_out_and_said),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
