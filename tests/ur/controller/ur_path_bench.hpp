// Runs a sequence of moves as a program gives them, cycle by cycle, with a speed slider.
#pragma once

#include <random>
#include <vector>

#include "sim_plant/ur/motion/motion.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ur {

inline constexpr double kPathCycle_s = 0.008;

inline Joints joints(double a, double b, double c, double d, double e, double f) {
  Joints q;
  q << a, b, c, d, e, f;
  return q;
}

inline const Joints kPathHome = joints(0.3, -1.3, 1.6, -1.2, -1.3, 0.4);

inline Move move_to(Move::Kind kind, const Frame& target, double r, double v = 0.25,
                    double a = 1.2) {
  Move move;
  move.kind = kind;
  move.target = target;
  move.r = r;
  move.v = v;
  move.a = a;
  return move;
}

inline Move move_joints(const Joints& q, double r, double v = 1.05, double a = 1.4) {
  Move move;
  move.q = q;
  move.r = r;
  move.v = v;
  move.a = a;
  return move;
}

struct PathPoint {
  double time_s;  // of the stretched time base
  Joints q, dq;
};

/// Gives the moves as fast as the motion accepts them. `slider(k)` is the slider in cycle k.
template <class Slider>
std::vector<PathPoint> run_moves(Motion& motion, const std::vector<Move>& moves, Slider slider) {
  std::vector<PathPoint> points{{0.0, motion.q(), motion.dq()}};
  std::size_t next = 0;
  double time_s = 0.0;
  for (int k = 0; k < 100000; ++k) {
    double left_s = kPathCycle_s * slider(k);
    time_s += left_s;
    for (int n = 0; n < 32 && left_s > 1e-9; ++n) {
      if (!motion.busy() && next < moves.size()) assert_true(motion.move(moves[next++]));
      if (!motion.busy()) {
        motion.idle(left_s, true);
        break;
      }
      left_s -= motion.advance(left_s);
    }
    assert_false(static_cast<bool>(motion.take_fault()));
    points.push_back({time_s, motion.q(), motion.dq()});
    if (next == moves.size() && motion.resting()) return points;
  }
  assert_true(false);
  return points;
}

inline std::vector<PathPoint> run_moves(Motion& motion, const std::vector<Move>& moves) {
  return run_moves(motion, moves, [](int) { return 1.0; });
}

/// Distance of a point from the line through two others.
inline double off_line(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 u = (b - a).normalized();
  return ((p - a) - u.dot(p - a) * u).norm();
}

inline Frame beside(double x, double y, double z) {
  Frame frame = forward(kPathHome);
  frame.p += Vector3(x, y, z);
  return frame;
}

/// Returns the largest acceleration of a joint, and asserts that position and speed agree.
inline double check_smooth(const std::vector<PathPoint>& points) {
  const MotionLimits limits;
  double most = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const PathPoint &a = points[k - 1], &b = points[k];
    const double h = b.time_s - a.time_s;
    if (h < 1e-9) continue;
    assert_true((b.dq.cwiseAbs().array() <= limits.speed.array() * 1.001 + 1e-9).all());
    const double ddq = (b.dq - a.dq).cwiseAbs().maxCoeff() / h;
    most = std::max(most, ddq);
    // The mean of the speeds deviates by at most a quarter of the change of the acceleration.
    const double off = (b.q - a.q - 0.5 * h * (a.dq + b.dq)).cwiseAbs().maxCoeff();
    assert_true(off <= 0.5 * limits.acceleration * h * h + 1e-7);
  }
  return most;
}

inline Vector3 random_vector(std::mt19937_64& random, double most) {
  std::uniform_real_distribution<double> uniform(-most, most);
  return {uniform(random), uniform(random), uniform(random)};
}

}  // namespace tactus::ur
