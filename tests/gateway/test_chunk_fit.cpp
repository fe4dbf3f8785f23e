// The curve of a chunk against a spline computed in another way: the minimizer of
//   sum (y - f)^2 + L integral f''^2
// over all piecewise cubics in the basis of values and velocities at the knots, by a dense solver;
// through the last target, if the chunk ends there.
#include "gateway/chunk_fit.hpp"

#include <Eigen/Dense>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/motion/motion_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

/// Values and velocities at the knots that minimize; the bending energy of a Hermite cubic is a
/// quadratic form in them. With L = 0 the values are the targets and the velocities minimize.
struct DenseSpline {
  static constexpr int kKnots = 64, kMost = 2 * kKnots;  // matrices on the stack: no heap here
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
  Vector f, df;

  DenseSpline(const Vector& t, const Vector& y, double L, bool fixed) {
    const Eigen::Index n = t.size();
    Matrix K = Matrix::Zero(2 * n, 2 * n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const double h = t[i + 1] - t[i];
      Eigen::Matrix4d k;  // of a beam: values and slopes of both ends
      k << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h,
          6 * h, 2 * h * h, -6 * h, 4 * h * h;
      const Eigen::Index at[4] = {i, n + i, i + 1, n + i + 1};
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) K(at[a], at[b]) += k(a, b) / (h * h * h);
      }
    }
    if (L == 0.0) {
      f = y;
      const Matrix slopes = K.bottomRightCorner(n, n);
      df = slopes.fullPivLu().solve(-K.bottomLeftCorner(n, n) * y);
      return;
    }
    Matrix A = L * K;
    A.topLeftCorner(n, n) += Matrix::Identity(n, n);
    Vector b = Vector::Zero(2 * n);
    b.head(n) = y;
    if (fixed) A.row(n - 1) = Matrix::Identity(2 * n, 2 * n).row(n - 1);
    const Vector x = A.fullPivLu().solve(b);
    f = x.head(n);
    df = x.tail(n);
  }
};

Chunk<JointSpace> chunk;
ChunkCurve<JointSpace> curve;
Chunk<TaskSpace> poses;
ChunkCurve<TaskSpace> path;
AdmissionSettings<JointSpace> joint_settings;
AdmissionSettings<TaskSpace> task_settings;

// Proves RG-29.

void the_curve_is_the_smoothing_spline(void**) {
  Dice dice{3};
  for (const double smoothing_s : {0.0, 0.03, 0.2}) {
    for (const int n : {2, 3, 4, 5, 30, DenseSpline::kKnots}) {
      chunk = {};
      chunk.smoothing_s = smoothing_s;
      chunk.ends = dice.chance(0.5);
      DenseSpline::Vector t(n), y(n);
      double time_s = 100.0;
      for (int i = 0; i < n; ++i) {
        time_s += dice.uniform(0.01, 0.05);
        JointSpace::Point point = home_point<JointSpace>();
        t[i] = time_s;
        y[i] = 0.2 * std::sin(5.0 * time_s) + dice.uniform(-1e-3, 1e-3);
        point.q[2] += y[i];
        assert_true(chunk.add(time_s, point));
      }
      ASSERT_OK(judge_chunk(chunk, joint_settings).status);
      fit_chunk(chunk, joint_settings, curve);
      const double L = std::pow(smoothing_s, 4) * (n - 1) / (t[n - 1] - t[0]);
      const DenseSpline dense(t, y, L, chunk.ends);
      const double home = home_point<JointSpace>().q[2];
      for (int i = 0; i < n; ++i) {
        const JointSpace::Point& knot = curve.knots[static_cast<std::size_t>(i)].point;
        ASSERT_NEAR(knot.q[2] - home, dense.f[i], 1e-9);
        ASSERT_NEAR(knot.dq[2], chunk.ends && i == n - 1 ? 0.0 : dense.df[i], 1e-7);
      }
    }
  }
}

/// The knots' accelerations are the derivatives of the curve on both sides of them.
void the_curve_of_poses_passes_through_them_with_continuous_accelerations(void**) {
  Dice dice{5};
  poses = {};
  poses.smoothing_s = 0.0;
  TaskSpace::Point pose = home_point<TaskSpace>();
  for (int i = 0; i < 40; ++i) {
    pose.x.p += 0.02 * dice.vector();
    pose.x.r = (pose.x.r * exp_so3(Vector3(0.25, 0.0, 0.0) + 0.1 * dice.vector())).normalized();
    if (dice.chance(0.5)) pose.x.r.coeffs() *= -1.0;
    assert_true(poses.add(0.05 * i, pose));
  }
  ASSERT_OK(judge_chunk(poses, task_settings).status);
  fit_chunk(poses, task_settings, path);
  for (std::size_t i = 1; i + 1 < 40; ++i) {
    const auto& knots = path.knots;
    ASSERT_NEAR((knots[i].point.x.p - poses.targets[i].x.p).norm(), 0.0, 1e-12);
    ASSERT_NEAR(knots[i].point.x.r.angularDistance(poses.targets[i].x.r), 0.0, 1e-7);
    const double h = 0.05, e = 1e-6;
    const TaskSpace::Segment before(knots[i - 1].point, knots[i].point, h, Interpolation::kQuintic,
                                    kVelocityField);
    const TaskSpace::Segment after(knots[i].point, knots[i + 1].point, h, Interpolation::kQuintic,
                                   kVelocityField);
    const Vector6 left = (before.at(h).v - before.at(h - e).v) / e;
    const Vector6 right = (after.at(e).v - after.at(0.0).v) / e;
    ASSERT_NEAR((left - right).norm(), 0.0, 1e-2);
    ASSERT_NEAR((right - knots[i].point.a).norm(), 0.0, 1e-2);
  }
}

void the_curve_has_the_velocities_that_are_given(void**) {
  chunk = {};
  chunk.velocities = true;
  for (int i = 0; i < 10; ++i) {
    JointSpace::Point point = home_point<JointSpace>();
    point.q[1] += 0.1 * std::sin(0.3 * i);
    point.dq[1] = 0.5 * std::cos(0.3 * i);
    assert_true(chunk.add(0.06 * i, point));
  }
  fit_chunk(chunk, joint_settings, curve);
  for (std::size_t i = 0; i < 10; ++i)
    ASSERT_NEAR(curve.knots[i].point.dq[1], chunk.targets[i].dq[1], 1e-12);
}

/// A target at the end of a range stays inside it, however much is smoothed.
void no_knot_leaves_the_limits(void**) {
  chunk = {};
  chunk.smoothing_s = 0.1;
  const JointLimits limits;
  for (int i = 0; i < 40; ++i) {
    JointSpace::Point point = home_point<JointSpace>();
    point.q[0] = std::min(limits.q_max[0], limits.q_max[0] - 0.3 + 0.02 * i);
    assert_true(chunk.add(0.03 * i, point));
  }
  fit_chunk(chunk, joint_settings, curve);
  for (std::size_t i = 0; i < 40; ++i)
    assert_true(curve.knots[i].point.q[0] <= limits.q_max[0] * (1.0 + 1e-9));
}

}  // namespace

int main() {
  joint_settings.period_s = task_settings.period_s = 1e-3;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_curve_is_the_smoothing_spline),
      cmocka_unit_test(the_curve_of_poses_passes_through_them_with_continuous_accelerations),
      cmocka_unit_test(the_curve_has_the_velocities_that_are_given),
      cmocka_unit_test(no_knot_leaves_the_limits),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
