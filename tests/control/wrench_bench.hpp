// The wrench front end and a synthetic sensor for it: statics by components, with the flange's pose
// from MuJoCo.
#pragma once

#include "kernel/control/wrench_front_end.hpp"
#include "tests/control/force_and_moment.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kPeriod_s = 1e-3;
inline const Vector6 kNone = Vector6::Zero();

inline void assert_same(const Vector6& actual, const Vector6& expected, double tolerance) {
  ASSERT_NEAR((actual - expected).cwiseAbs().maxCoeff(), 0.0, tolerance);
}

/// Position and axes of the flange at random joint angles of the FER.
struct Flange {
  double q[7], p[3], r[3][3];
  explicit Flange(RandomVectors& random) {
    constexpr double kMiddle[7] = {0.0, 0.0, 0.0, -1.6, 0.0, 1.8, 0.0};
    for (int i = 0; i < 7; ++i) q[i] = kMiddle[i] + random.unit();
    mujoco_flange(q, p, r);
  }
};

/// A front end and the sensor it reads.
struct WrenchBench {
  RandomVectors random;
  Flange flange{random};
  Tool tool;
  Pose x;
  Vector6 ft = kNone, bias = kNone;
  WrenchFrontEnd front;
  WrenchBench() {
    tool = {1.7, {0.02, -0.03, 0.08}, {{0.01, 0.05, 0.21}, exp_so3({0.3, -0.8, 1.1})}};
    tool.gravity = {2.0, -4.0, 8.7};  // of an arm that hangs aslant
    WrenchFrontEnd::Params& p = front.params;
    p.max_force = 300.0;
    p.max_moment = 30.0;
    p.tare_s = 0.1;
    p.tare_timeout_s = 1.0;
    p.time_constant_s = 0.0;
    bias = wrench({3.0, -7.0, 11.0}, {0.4, 0.5, -0.6});
    front.ft.source = &ft;
    front.x.source = &x;
    front.tool.source = &tool;
    feel(kNone);
  }
  /// Moves to another random pose.
  void turn() { flange = Flange(random); }
  /// Sets the sensor's reading while the environment exerts `h` on the tip, in base axes: force and
  /// moment balance of the tool, by components.
  void feel(const Vector6& h) {
    const auto& r = flange.r;
    const Vector3 W = tool.mass_kg * tool.gravity;
    double tip[3], com[3];
    for (int i = 0; i < 3; ++i) {
      tip[i] = r[i][0] * tool.tip.p[0] + r[i][1] * tool.tip.p[1] + r[i][2] * tool.tip.p[2];
      com[i] = r[i][0] * tool.com[0] + r[i][1] * tool.com[1] + r[i][2] * tool.com[2];
      x.p[i] = flange.p[i] + tip[i];
    }
    double f[3], m[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      f[i] = h[i] + W[i];
      m[i] = h[3 + i] + tip[j] * h[k] - tip[k] * h[j] + com[j] * W[k] - com[k] * W[j];
    }
    for (int i = 0; i < 3; ++i) {
      ft[i] = bias[i] + r[0][i] * f[0] + r[1][i] * f[1] + r[2][i] * f[2];
      ft[3 + i] = bias[3 + i] + r[0][i] * m[0] + r[1][i] * m[1] + r[2][i] * m[2];
    }
    Matrix3 axes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) axes(i, j) = r[i][j];
    x.r = Eigen::Quaterniond(axes) * tool.tip.r;
  }
  Status run(int cycles, double dt_s = kPeriod_s) {
    for (int i = 0; i < cycles; ++i) TRY(front.step(dt_s));
    return Status::kOk;
  }
  /// Starts and tares at the present pose.
  void tare() {
    ASSERT_OK(front.start());
    ASSERT_OK(run(100));
    assert_false(front.taring.value);
  }
};

}  // namespace tactus
