// Tests the simulated force/torque sensor through the Hal: bias, noise and rate, by estimates with
// known standard errors.
#include <cmath>

#include "tests/sim_plant/arm/driven_hal.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A FER that carries 2 kg, with its tool 0.2 mm deep in a wall next to it.
PlantParams pressing() {
  PlantParams params;
  params.payload_kg = 2.0;
  params.payload_com = Vector3(0.05, -0.02, 0.1);
  params.payload_tip = Vector3(0.0, 0.0, 0.1);
  params.scene = SceneKind::kWall;  // its side x = 0.25 m; the tip is at x = 0.307 m
  params.scene_offset = Vector3(0.307 - 0.25 - 0.01 + 2e-4, -0.85, 0.0);
  return params;
}

/// A robot held by the torque measured at its start, read cycle by cycle.
struct Reader {
  SimHal hal;
  RobotState state;
  JointVector hold;

  void start(const PlantParams& params, std::uint64_t seed) {
    ASSERT_OK(hal.load(params, seed));
    hal.set_period(1e-3);
    ASSERT_OK(arm_drives(hal, CommandMode::kEffort, state));
    hold = state.tau;
  }
  void cycle() {
    ASSERT_OK(follow(hal, CommandMode::kEffort, hold));
    ASSERT_OK(measure(hal, state));
  }
};

Reader g_reader, g_twin;

// Proves SIM-7.

void the_hal_offers_the_sensor_and_reads_it(void**) {
  assert_true(g_reader.hal.capabilities().wrench);
  g_reader.start(pressing(), 1);
  assert_true(g_reader.hal.arm().contact_force().x() > 10.0);
  for (int k = 0; k < 10; ++k) {
    assert_memory_equal(g_reader.state.ft.data(), g_reader.hal.arm().ft().data(), sizeof(Vector6));
    g_reader.cycle();
  }
}

void the_bias_is_added_to_what_it_feels(void**) {
  PlantParams params = pressing();
  params.ft_bias_force_N = Vector3(1.0, -2.0, 3.0);
  params.ft_bias_moment_Nm = Vector3(-0.1, 0.2, -0.3);
  g_reader.start(params, 1);
  const double bias[6] = {1.0, -2.0, 3.0, -0.1, 0.2, -0.3};
  for (int i = 0; i < 6; ++i)
    ASSERT_NEAR(g_reader.state.ft[i] - g_reader.hal.arm().ft()[i], bias[i], 1e-12);
}

void its_noise_has_no_mean_and_the_deviations_stated(void**) {
  PlantParams params = pressing();
  params.ft_noise_force_N = 0.5;
  params.ft_noise_moment_Nm = 0.02;
  g_reader.start(params, 1);
  constexpr int kCycles = 3000;
  const double n = 3.0 * kCycles;
  double sum[2] = {}, squares[2] = {};
  for (int k = 0; k < kCycles; ++k) {
    g_reader.cycle();
    const Vector6 noise = g_reader.state.ft - g_reader.hal.arm().ft();
    const Vector3 parts[2] = {noise.head<3>() / 0.5, noise.tail<3>() / 0.02};
    for (int i = 0; i < 2; ++i) {
      sum[i] += parts[i].sum();
      squares[i] += parts[i].squaredNorm();
    }
  }
  for (int i = 0; i < 2; ++i) {  // four standard errors of the estimates from n numbers
    ASSERT_NEAR(sum[i] / n, 0.0, 4.0 / std::sqrt(n));
    ASSERT_NEAR(std::sqrt(squares[i] / n), 1.0, 4.0 / std::sqrt(2.0 * n));
  }
}

void at_a_rate_of_its_own_it_shows_each_value_for_its_period(void**) {
  PlantParams params = pressing();
  params.ft_noise_force_N = 0.5;
  params.ft_rate_hz = 100.0;
  g_reader.start(params, 1);
  Vector6 shown = g_reader.state.ft;
  for (int k = 1; k <= 200; ++k) {
    g_reader.cycle();
    assert_true((g_reader.state.ft == shown) == (g_reader.hal.time_ns() % 10000000 != 0));
    shown = g_reader.state.ft;
  }
}

// Proves SIM-3, SIM-7.

void the_same_seed_gives_the_same_bytes_in_contact_too(void**) {
  PlantParams params = pressing();
  params.ft_noise_force_N = 0.5;
  params.position_noise_rad = 1e-4;
  g_reader.start(params, 7);
  g_twin.start(params, 7);
  for (int k = 0; k < 200; ++k) {
    g_reader.cycle();
    g_twin.cycle();
    assert_memory_equal(g_reader.state.q.data(), g_twin.state.q.data(), sizeof(JointVector));
    assert_memory_equal(g_reader.state.ft.data(), g_twin.state.ft.data(), sizeof(Vector6));
  }
}

void the_noise_of_the_sensor_is_nobody_elses(void**) {
  PlantParams params = pressing();
  params.position_noise_rad = 1e-4;
  g_reader.start(params, 7);
  params.ft_noise_force_N = 0.5;
  g_twin.start(params, 7);
  for (int k = 0; k < 200; ++k) {
    g_reader.cycle();
    g_twin.cycle();
    assert_memory_equal(g_reader.state.q.data(), g_twin.state.q.data(), sizeof(JointVector));
    assert_true(g_reader.state.ft != g_twin.state.ft);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_hal_offers_the_sensor_and_reads_it),
      cmocka_unit_test(the_bias_is_added_to_what_it_feels),
      cmocka_unit_test(its_noise_has_no_mean_and_the_deviations_stated),
      cmocka_unit_test(at_a_rate_of_its_own_it_shows_each_value_for_its_period),
      cmocka_unit_test(the_same_seed_gives_the_same_bytes_in_contact_too),
      cmocka_unit_test(the_noise_of_the_sensor_is_nobody_elses),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
