// The wrench front end on synthetic signals: weight, lever arm, axes, filter; and a tool's weight
// compared with its joint torques by Orocos KDL.
#include <algorithm>

#include "tests/control/wrench_bench.hpp"
#include "tests/oracles/kdl.hpp"

namespace tactus {
namespace {

// Proves WF-1.

void after_the_tare_a_free_tool_feels_nothing_however_it_is_turned(void**) {
  WrenchBench bench;
  bench.tare();
  assert_same(bench.front.bias.value, bench.bias, 1e-12);
  for (int i = 0; i < 100; ++i) {
    bench.turn();
    bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 1e-12);
  }
}

void what_the_environment_exerts_on_the_tip_comes_out_in_base_axes(void**) {
  WrenchBench bench;
  bench.tare();
  for (int i = 0; i < 100; ++i) {
    const Vector6 h = wrench(50.0 * bench.random.vector(), 5.0 * bench.random.vector());
    bench.turn();
    bench.feel(h);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, h, 1e-12);
  }
}

/// Computed by hand: flange axes equal to the base's, tip 0.2 m along x, 10 N upwards on the tip.
void a_force_on_the_tip_makes_no_moment_about_the_tip(void**) {
  WrenchBench bench;
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
    WrenchBench bench;
    bench.random.bits.seed(kSeed + static_cast<unsigned>(trial));
    bench.turn();
    bench.feel(kNone);
    KdlTool tool{bench.tool.mass_kg, {}, {0.4, -2.0, 1.0}}, nothing = tool;
    nothing.mass_kg = 0.0;
    kdl_base_gravity(tool, bench.tool.gravity.data());
    std::copy(bench.tool.com.data(), bench.tool.com.data() + 3, tool.com);
    Eigen::Matrix<double, 7, 1> with, without;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> J;
    double rows[6][7];
    kdl_gravity(bench.flange.q, tool, with.data());
    kdl_gravity(bench.flange.q, nothing, without.data());
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
  WrenchBench bench;
  bench.front.params.dead_force = 5.0;
  bench.front.params.dead_moment = 1.0;
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

// Proves WF-3.

void the_filter_is_the_exact_first_order_lag_at_every_period(void**) {
  for (const int period_ms : {1, 2, 8}) {
    WrenchBench bench;
    bench.front.params.time_constant_s = 0.02;
    bench.tare();
    const Vector6 h = wrench({10.0, -20.0, 30.0}, {1.0, 2.0, -3.0});
    bench.feel(h);
    for (int i = 1; i * period_ms <= 160; ++i) {
      ASSERT_OK(bench.front.step(1e-3 * period_ms));
      const double share = -std::expm1(-1e-3 * period_ms * i / 0.02);
      assert_same(bench.front.h.value, share * h, 1e-12);
    }
    ASSERT_OK(bench.front.step(4e-3));  // a period may change
    assert_same(bench.front.h.value, -std::expm1(-0.164 / 0.02) * h, 1e-12);
  }
}

/// The tool's weight is removed before the filter, so that no part of it remains after a fast turn.
void turning_the_tool_quickly_leaves_no_weight_in_the_filter(void**) {
  WrenchBench bench;
  bench.front.params.time_constant_s = 0.1;
  bench.tare();
  for (int i = 0; i < 100; ++i) {
    bench.turn();
    bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 1e-12);
  }
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
      cmocka_unit_test(the_filter_is_the_exact_first_order_lag_at_every_period),
      cmocka_unit_test(turning_the_tool_quickly_leaves_no_weight_in_the_filter),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
