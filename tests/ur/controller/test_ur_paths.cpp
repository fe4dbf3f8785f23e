// Tests the paths of the emulated controller: blends against the parabola in closed form, movep and
// movec against circles, and random paths of all moves by their properties.
#include <Eigen/LU>

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

// Proves URE-15.

void movep_keeps_its_speed_round_the_corner_on_a_circle(void**) {
  constexpr double kRadius = 0.04, kSpeed = 0.15;
  Motion motion;
  motion.rest(kPathHome);
  const Frame corner = beside(0.12, 0.0, 0.0), to = beside(0.12, 0.12, 0.0);
  Frame end = to;
  end.r = end.r * rotation_matrix(Vector3(0.2, 0.0, 0.3));
  const auto points = run_moves(
      motion, {move_to(Kind::kP, corner, kRadius, kSpeed), move_to(Kind::kP, end, 0.0, kSpeed)});
  // At a right angle the circle's radius is the blend radius.
  const Vector3 center = beside(0.12 - kRadius, kRadius, 0.0).p;
  int inside = 0;
  for (const PathPoint& point : points) {
    const Vector3 d = forward(point.q).p - center;
    if (d.x() < 0.0 || d.y() > 0.0) continue;
    ++inside;
    ASSERT_NEAR(d.norm(), kRadius, 1e-6);
    ASSERT_NEAR((jacobian(point.q, {}) * point.dq).head<3>().norm(), kSpeed, 1e-4);
  }
  assert_true(inside > 40);
  check_smooth(points);
}

void movec_stays_on_its_circle(void**) {
  const double radius = 0.1;
  const Vector3 center = forward(kPathHome).p - Vector3(radius, 0.0, 0.0);
  const Vector3 normal = Vector3(0.0, -0.6, 0.8);
  for (const double angle : {0.8, 3.0, 5.0})
    for (const bool fixed : {false, true}) {
      if (fixed && angle > 1.0) continue;  // the wrist would turn through a singularity
      Motion motion;
      motion.rest(kPathHome);
      Move move = move_to(Kind::kC, forward(kPathHome), 0.0);
      const Vector3 spoke(radius, 0.0, 0.0);
      move.via.p = center + rotation_matrix(0.4 * angle * normal) * spoke;
      move.target.p = center + rotation_matrix(angle * normal) * spoke;
      if (!fixed) move.target.r = move.target.r * rotation_matrix(Vector3(0.1, 0.2, 0.0));
      move.fixed = fixed;
      const auto points = run_moves(motion, {move});
      double from_via = 1.0;
      for (const PathPoint& point : points) {
        const Frame tip = forward(point.q);
        from_via = std::min(from_via, (tip.p - move.via.p).norm());
        ASSERT_NEAR((tip.p - center).norm(), radius, 1e-6);
        ASSERT_NEAR(normal.dot(tip.p - center), 0.0, 1e-6);
        if (!fixed) continue;
        // The spoke does not move relative to the tool.
        const Vector3 seen = tip.r.transpose() * (tip.p - center);
        assert_true((seen - forward(kPathHome).r.transpose() * spoke).norm() < 1e-6);
      }
      assert_true(from_via < 0.002);
      const Frame end = forward(points.back().q);
      assert_true((end.p - move.target.p).norm() < 1e-7);
      if (!fixed) assert_true((end.r - move.target.r).norm() < 1e-7);
      // Where no joint is slower, the time is that of the arc at 0.25 m/s with its ramps.
      if (fixed)
        ASSERT_NEAR(points.back().time_s, radius * angle / 0.25 + 0.25 / 1.2 + 0.064, 0.02);
      check_smooth(points);
    }
}

// Proves URE-12.

void a_tool_is_not_faster_than_the_joints(void**) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Move> moves;
    for (const Kind kind : {Kind::kL, Kind::kP, Kind::kP, Kind::kL}) {
      Frame target = forward(kPathHome);
      target.p += random_vector(random, 0.2);
      target.r = target.r * rotation_matrix(random_vector(random, 0.4));
      moves.push_back(move_to(kind, target, kind == Kind::kP ? 0.02 : 0.0, 5.0, 100.0));
    }
    Motion motion;
    motion.rest(kPathHome);
    const MotionLimits limits;
    const double most = check_smooth(run_moves(motion, moves, [](int) { return 0.25; }));
    assert_true(most <= 1.05 * limits.acceleration && most > 0.3 * limits.acceleration);
  }
}

// Proves URE-15.

void three_points_on_a_line_are_gone_straight(void**) {
  Motion motion;
  motion.rest(kPathHome);
  Move move = move_to(Kind::kC, beside(0.1, 0.1, 0.0), 0.0);
  move.via = beside(0.05, 0.05, 0.0);
  for (const PathPoint& point : run_moves(motion, {move}))
    assert_true(off_line(forward(point.q).p, forward(kPathHome).p, move.target.p) < 1e-6);
}

// Proves URE-14.

/// The centre of the circle through three points: in their plane, and equally far from each.
Vector3 center_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  Matrix3 rows;
  rows << (b - a).transpose(), (c - a).transpose(), (b - a).cross(c - a).transpose();
  const Vector3 right(0.5 * (b.squaredNorm() - a.squaredNorm()),
                      0.5 * (c.squaredNorm() - a.squaredNorm()), (b - a).cross(c - a).dot(a));
  return rows.fullPivLu().solve(right);
}

/// Whether, outside the radii, the tip is on one of the lines and circles, or the joints are on a
/// line.
bool on_path(const Joints& q, const std::vector<Move>& moves, const std::vector<Joints>& ends) {
  const Vector3 p = forward(q).p;
  Vector3 from = forward(kPathHome).p;
  Joints q_from = kPathHome;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Move& move = moves[i];
    const Vector3 to = move.target.p;
    const Joints& q_to = ends[i];
    if ((p - to).norm() <= move.r + 1e-9) return true;
    if (move.kind == Kind::kJ) {
      const Joints u = (q_to - q_from).normalized();
      if (((q - q_from) - u.dot(q - q_from) * u).norm() < 1e-6) return true;
    } else if (move.kind == Kind::kC) {
      const Vector3 center = center_of(from, move.via.p, to);
      const Vector3 n = (move.via.p - from).cross(to - from).normalized();
      if (std::abs((p - center).norm() - (from - center).norm()) < 1e-6 &&
          std::abs(n.dot(p - center)) < 1e-6)
        return true;
    } else if (off_line(p, from, to) < 1e-6) {
      return true;
    }
    from = to;
    q_from = q_to;
  }
  return false;
}

std::vector<Move> random_moves(std::mt19937_64& random) {
  std::uniform_int_distribution<int> kind(0, 3), count(3, 6);
  std::uniform_real_distribution<double> radius(0.0, 0.05), speed(0.05, 0.6);
  std::vector<Move> moves;
  Vector3 from = forward(kPathHome).p;
  for (int i = count(random); i > 0; --i) {
    Frame target = forward(kPathHome);
    target.p += random_vector(random, 0.15);
    target.r = target.r * rotation_matrix(random_vector(random, 0.3));
    Move move = move_to(static_cast<Kind>(kind(random)), target, i > 1 ? radius(random) : 0.0,
                        speed(random), 4.0 * speed(random));
    move.via.p = 0.5 * (from + target.p) + random_vector(random, 0.03);
    from = target.p;
    if (move.kind == Kind::kJ) {
      Joints found;
      assert_true(inverse(target, {}, kPathHome, found));
      move.q = found;
    }
    moves.push_back(move);
  }
  return moves;
}

/// Every kind of move after every other: continuous, and within the limits of the joints. The
/// slider changes only the timing, so a run at an eighth of the speed predicts the path at any
/// speed.
void random_paths_are_smooth_and_do_not_know_the_slider(void**) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<Move> moves = random_moves(random);
    std::vector<Joints> ends(moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i)
      assert_true(inverse(moves[i].target, {}, kPathHome, ends[i]));
    Motion fine, swept;
    fine.rest(kPathHome);
    swept.rest(kPathHome);
    const auto expected = run_moves(fine, moves, [](int) { return 0.125; });
    assert_true(check_smooth(expected) <= 1.05 * MotionLimits().acceleration);
    std::uniform_int_distribution<int> eighths(1, 8);
    const auto found = run_moves(swept, moves, [&](int) { return 0.125 * eighths(random); });
    check_smooth(found);
    for (const PathPoint& point : found) {
      assert_true(on_path(point.q, moves, ends));
      const auto k = static_cast<std::size_t>(std::lround(point.time_s / 0.001));
      if (k < expected.size()) assert_true((point.q - expected[k].q).cwiseAbs().maxCoeff() < 1e-6);
    }
    assert_true((found.back().q - expected.back().q).cwiseAbs().maxCoeff() < 1e-7);
  }
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
      cmocka_unit_test(movep_keeps_its_speed_round_the_corner_on_a_circle),
      cmocka_unit_test(movec_stays_on_its_circle),
      cmocka_unit_test(a_tool_is_not_faster_than_the_joints),
      cmocka_unit_test(three_points_on_a_line_are_gone_straight),
      cmocka_unit_test(random_paths_are_smooth_and_do_not_know_the_slider),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
