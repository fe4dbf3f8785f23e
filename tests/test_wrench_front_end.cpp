// The wrench front end on synthetic signals: a sensor that obeys statics written out here by
// components, with the flange's pose from MuJoCo; and once with a tool's weight as Orocos KDL feels
// it in the joints.
#include "kernel/control/wrench_front_end.hpp"

#include <algorithm>
#include <array>

#include "tests/oracles/kdl.hpp"
#include "tests/oracles/mujoco.hpp"
#include "tests/rotation_cases.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
const Vector6 kNone = Vector6::Zero();

Vector6 wrench(const Vector3& f, const Vector3& m) {
  Vector6 both;
  both << f, m;
  return both;
}

void assert_same(const Vector6& actual, const Vector6& expected, double tolerance) {
  ASSERT_NEAR((actual - expected).cwiseAbs().maxCoeff(), 0.0, tolerance);
}

/// Position and axes of the flange, at joint angles of the FER.
struct Flange {
  double q[7], p[3], r[3][3];
  explicit Flange(Random& random) {
    constexpr double kMiddle[7] = {0.0, 0.0, 0.0, -1.6, 0.0, 1.8, 0.0};
    for (int i = 0; i < 7; ++i) q[i] = kMiddle[i] + random.unit();
    mujoco_flange(q, p, r);
  }
};

/// A front end and the sensor it reads.
struct Bench {
  Random random;
  Flange flange{random};
  Tool tool;
  Pose x;
  Vector6 ft = kNone, bias = kNone;
  WrenchFrontEnd front;
  Bench() {
    tool = {1.7, {0.02, -0.03, 0.08}, {{0.01, 0.05, 0.21}, exp_so3({0.3, -0.8, 1.1})}};
    WrenchFrontEnd::Params& p = front.params;
    p.max_force = 300.0, p.max_moment = 30.0;
    p.tare_s = 0.1, p.tare_timeout_s = 1.0, p.time_constant_s = 0.0;
    bias = wrench({3.0, -7.0, 11.0}, {0.4, 0.5, -0.6});
    front.ft.source = &ft, front.x.source = &x, front.tool.source = &tool;
    feel(kNone);
  }
  /// To another pose.
  void turn() { flange = Flange(random); }
  /// The sensor's reading while the environment exerts `h` on the tip, base axes: force and moment
  /// balance of the tool, by components.
  void feel(const Vector6& h) {
    const auto& r = flange.r;
    const double W[3] = {0.0, 0.0, -9.81 * tool.mass_kg};
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

// Proves WF-1.

void after_the_tare_a_free_tool_feels_nothing_however_it_is_turned(void**) {
  Bench bench;
  bench.tare();
  assert_same(bench.front.bias.value, bench.bias, 1e-12);
  for (int i = 0; i < 100; ++i) {
    bench.turn(), bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 1e-12);
  }
}

void what_the_environment_exerts_on_the_tip_comes_out_in_base_axes(void**) {
  Bench bench;
  bench.tare();
  for (int i = 0; i < 100; ++i) {
    const Vector6 h = wrench(50.0 * bench.random.vector(), 5.0 * bench.random.vector());
    bench.turn(), bench.feel(h);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, h, 1e-12);
  }
}

/// By hand: flange axes as the base's, tip 0.2 m along x, 10 N upwards on the tip.
void a_force_on_the_tip_makes_no_moment_about_the_tip(void**) {
  Bench bench;
  bench.front.params.tare_s = 0.0;
  bench.tool = {0.0, Vector3::Zero(), {{0.2, 0.0, 0.0}, kIdentity}};
  bench.x = {};
  bench.ft = wrench({0.0, 0.0, 10.0}, {0.0, -2.0, 0.0});  // x cross f
  ASSERT_OK(bench.front.start());
  ASSERT_OK(bench.front.step(kPeriod_s));
  assert_same(bench.front.h.value, wrench({0.0, 0.0, 10.0}, Vector3::Zero()), 1e-15);
}

/// The joint torques that KDL needs to hold a tool are -J^T of its weight at the flange.
void the_weight_taken_out_is_the_one_kdl_feels_in_the_joints(void**) {
  for (int trial = 0; trial < 20; ++trial) {
    Bench bench;
    bench.random.bits.seed(kSeed + static_cast<unsigned>(trial));
    bench.turn(), bench.feel(kNone);
    KdlTool tool{bench.tool.mass_kg, {}};
    std::copy(bench.tool.com.data(), bench.tool.com.data() + 3, tool.com);
    Eigen::Matrix<double, 7, 1> with, without;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> J;
    double rows[6][7];
    kdl_gravity(bench.flange.q, tool, with.data());
    kdl_gravity(bench.flange.q, {}, without.data());
    kdl_jacobian(bench.flange.q, rows);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 7; ++j) J(i, j) = rows[i][j];
    const Eigen::Matrix<double, 6, 6> JJt = J * J.transpose();
    const Vector6 load = -JJt.ldlt().solve(Vector6(J * (with - without)));
    Matrix3 axes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) axes(i, j) = bench.flange.r[i][j];
    bench.ft = wrench(axes.transpose() * load.head<3>(), axes.transpose() * load.tail<3>());
    bench.front.params.tare_s = 0.0;
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 1e-8);
  }
}

void the_dead_band_shortens_and_does_not_jump(void**) {
  Bench bench;
  bench.front.params.dead_force = 5.0, bench.front.params.dead_moment = 1.0;
  bench.tare();
  const auto felt = [&](const Vector6& h) {
    bench.feel(h);
    ASSERT_OK(bench.front.step(kPeriod_s));
    return bench.front.h.value;
  };
  assert_same(felt(wrench({3.0, 3.9, 0.0}, {0.0, 0.9, 0.0})), kNone, 0.0);
  assert_same(felt(wrench({9.0, 12.0, 0.0}, {0.0, 0.0, -3.0})),
              wrench({6.0, 8.0, 0.0}, {0.0, 0.0, -2.0}), 1e-12);
  assert_same(felt(wrench({3.0, 4.000001, 0.0}, Vector3::Zero())), kNone, 1e-6);
}

// Proves WF-2.

void until_the_tare_is_done_the_wrench_is_zero_and_the_flag_says_so(void**) {
  Bench bench;
  ASSERT_OK(bench.front.start());
  for (int i = 1; i <= 100; ++i) {
    assert_true(bench.front.taring.value);
    bench.bias[0] = i % 2 ? 3.4 : 2.6;  // noise within the tolerance
    bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 0.0);
  }
  assert_false(bench.front.taring.value);
  ASSERT_NEAR(bench.front.bias.value[0], 3.0, 1e-12);
}

void the_tare_takes_the_same_time_at_every_period(void**) {
  for (const int period_ms : {1, 2, 8}) {
    Bench bench;
    bench.front.params.tare_s = 0.4;
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(400 / period_ms - 1, 1e-3 * period_ms));
    assert_true(bench.front.taring.value);
    ASSERT_OK(bench.run(1, 1e-3 * period_ms));
    assert_false(bench.front.taring.value);
  }
}

void a_bump_begins_the_tare_anew_and_is_not_in_the_bias(void**) {
  for (const int component : {0, 5}) {
    Bench bench;
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(80));
    bench.ft[component] += component < 3 ? 2.1 : 0.21;
    ASSERT_OK(bench.run(1));
    bench.feel(kNone);
    ASSERT_OK(bench.run(99));
    assert_true(bench.front.taring.value);
    ASSERT_OK(bench.run(1));
    assert_false(bench.front.taring.value);
    assert_same(bench.front.bias.value, bench.bias, 1e-12);
  }
}

/// Each step is far below the tolerance; their sum over the interval is not.
void a_signal_that_drifts_or_never_rests_stops_the_robot(void**) {
  Bench bench;
  ASSERT_OK(bench.front.start());
  for (int i = 1; i < 1000; ++i) {
    bench.ft[1] = 0.05 * i;  // 5 N in a tare's time
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 0.0);
  }
  ASSERT_STATUS(bench.front.step(kPeriod_s), Status::kSensorNotSteady);
}

void a_restart_tares_anew(void**) {
  Bench bench;
  bench.tare();
  bench.bias = wrench({-1.0, 2.0, 4.0}, {0.1, 0.2, 0.3});
  bench.turn(), bench.feel(kNone);
  ASSERT_OK(bench.front.start());
  assert_same(bench.front.h.value, kNone, 0.0);
  assert_same(bench.front.bias.value, kNone, 0.0);
  ASSERT_OK(bench.run(100));
  assert_same(bench.front.bias.value, bench.bias, 1e-12);
}

// Proves WF-3.

void the_filter_is_the_exact_first_order_lag_at_every_period(void**) {
  for (const int period_ms : {1, 2, 8}) {
    Bench bench;
    bench.front.params.time_constant_s = 0.02;
    bench.tare();
    const Vector6 h = wrench({10.0, -20.0, 30.0}, {1.0, 2.0, -3.0});
    bench.feel(h);
    for (int i = 1; i * period_ms <= 160; ++i) {
      ASSERT_OK(bench.front.step(1e-3 * period_ms));
      const double share = -std::expm1(-1e-3 * period_ms * i / 0.02);
      assert_same(bench.front.h.value, share * h, 1e-12);
    }
  }
}

/// What is filtered is free of the tool's weight: turning quickly leaves nothing of it behind.
void turning_the_tool_quickly_leaves_no_weight_in_the_filter(void**) {
  Bench bench;
  bench.front.params.time_constant_s = 0.1;
  bench.tare();
  for (int i = 0; i < 100; ++i) {
    bench.turn(), bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 1e-12);
  }
}

// Proves WF-4.

void a_reading_or_pose_that_is_not_finite_stops_the_robot(void**) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (int i = 0; i < 10; ++i) {
      Bench bench, begun;
      begun.tare();
      for (Bench* b : {&bench, &begun}) {
        (i < 6 ? b->ft[i] : b->x.r.coeffs()[i - 6]) = bad;
        if (i < 6) ASSERT_STATUS(b->front.start(), Status::kSensorNotFinite);
      }
      ASSERT_STATUS(begun.front.step(kPeriod_s), Status::kSensorNotFinite);
    }
}

void a_reading_at_the_end_of_the_range_stops_the_robot(void**) {
  for (int i = 0; i < 6; ++i) {
    Bench bench;
    bench.tare();
    bench.ft = kNone;
    bench.ft[i] = i < 3 ? -299.0 : 29.9;
    ASSERT_OK(bench.front.step(kPeriod_s));
    bench.ft[i] = i < 3 ? -300.0 : 30.0;  // a clipped sensor reads this
    ASSERT_STATUS(bench.front.step(kPeriod_s), Status::kSensorRange);
    ASSERT_STATUS(bench.front.start(), Status::kSensorRange);
  }
}

/// A sensor of 100 Hz read at 1 kHz says everything ten times; that is not stuck.
void a_reading_that_stays_the_same_to_the_last_bit_is_stuck(void**) {
  Bench bench;
  bench.front.params.stuck_s = 0.05;
  ASSERT_OK(bench.front.start());
  for (int i = 0; i < 500; ++i) {
    bench.ft[2] = 11.0 + 1e-9 * (i / 10);
    ASSERT_OK(bench.front.step(kPeriod_s));
  }
  ASSERT_OK(bench.run(40));
  ASSERT_STATUS(bench.run(20), Status::kSensorStuck);

  Bench unwatched;  // a simulated sensor without noise
  unwatched.tare();
  ASSERT_OK(unwatched.run(20000));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(after_the_tare_a_free_tool_feels_nothing_however_it_is_turned),
      cmocka_unit_test(what_the_environment_exerts_on_the_tip_comes_out_in_base_axes),
      cmocka_unit_test(a_force_on_the_tip_makes_no_moment_about_the_tip),
      cmocka_unit_test(the_weight_taken_out_is_the_one_kdl_feels_in_the_joints),
      cmocka_unit_test(the_dead_band_shortens_and_does_not_jump),
      cmocka_unit_test(until_the_tare_is_done_the_wrench_is_zero_and_the_flag_says_so),
      cmocka_unit_test(the_tare_takes_the_same_time_at_every_period),
      cmocka_unit_test(a_bump_begins_the_tare_anew_and_is_not_in_the_bias),
      cmocka_unit_test(a_signal_that_drifts_or_never_rests_stops_the_robot),
      cmocka_unit_test(a_restart_tares_anew),
      cmocka_unit_test(the_filter_is_the_exact_first_order_lag_at_every_period),
      cmocka_unit_test(turning_the_tool_quickly_leaves_no_weight_in_the_filter),
      cmocka_unit_test(a_reading_or_pose_that_is_not_finite_stops_the_robot),
      cmocka_unit_test(a_reading_at_the_end_of_the_range_stops_the_robot),
      cmocka_unit_test(a_reading_that_stays_the_same_to_the_last_bit_is_stuck),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
