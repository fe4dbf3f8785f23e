// The simulated force/torque sensor: weight, inertia, contact, and what a real sensor adds.
#include <cmath>
#include <cstring>

#include "sim_plant/sim_hal.hpp"
#include "tests/fer_tip.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr double kG = 9.81;  // m/s^2
const Vector3 kCom(0.05, -0.02, 0.1);

const double kPoses[][kDof] = {
    {0, -0.785, 0, -2.356, 0, 1.571, 0.785},
    {1.2, -0.4, 0.9, -2.2, -0.7, 1.9, 0.4},
    {0, 0, 0, 0, 0, 0, 0},
    {-0.5, 0.3, -1.1, -2.8, 1.3, 0.6, -1},
    {0.4, 1.0, 0.2, -1.0, 0.5, 3.0, -2.0},
};

/// An ideal FER that carries 2 kg.
PlantParams loaded() {
  PlantParams params;
  params.friction = 0.0;
  params.rotor_inertia.setZero();
  params.payload_kg = 2.0;
  params.payload_com = kCom;
  return params;
}

/// The same FER 0.2 mm deep in a wall in front of it, tool in the air.
PlantParams pressing() {
  PlantParams params = loaded();
  params.initial_q[0] = 1.57079632679489662;
  params.payload_tip = Vector3(0.03, 0.0, 0.1);
  params.scene = SceneKind::kWall;
  const double y = FerTip(params.initial_q, params.payload_tip).p.y();
  params.scene_offset.y() = y + 0.01 - 2e-4 - 0.80;
  return params;
}

/// Force and moment at the flange, in its axes, of a force at a point of the flange frame.
Vector6 wrench_of(const Vector3& force, const Vector3& at) {
  Vector6 wrench;
  wrench << force, at.cross(force);
  return wrench;
}

Arm g_arm;

// Proves SIM-7.

void at_rest_it_shows_the_weight_of_the_tool_downwards(void**) {
  for (const auto& pose : kPoses) {
    PlantParams params = loaded();
    params.initial_q = Eigen::Map<const JointVector>(pose);
    ASSERT_OK(g_arm.load(params));
    const FerTip flange(params.initial_q, Vector3::Zero());
    const Vector3 weight = flange.axes.transpose() * Vector3(0.0, 0.0, -2.0 * kG);
    ASSERT_NEAR((g_arm.ft() - wrench_of(weight, kCom)).norm(), 0.0, 1e-11);
    const JointVector hold = g_arm.stand();
    for (int k = 0; k < 100; ++k) g_arm.step(hold, 1e-3);  // the motors hold what the brakes held
    ASSERT_NEAR((g_arm.ft() - wrench_of(weight, kCom)).norm(), 0.0, 1e-9);
  }
}

void a_tool_that_points_down_pulls_along_the_axis_of_the_flange(void**) {
  PlantParams params = loaded();
  params.initial_q << 0, -0.785398163397448, 0, -2.356194490192345, 0, 1.570796326794897, 0.5;
  ASSERT_OK(g_arm.load(params));  // z of the flange is down
  const double expected[6] = {0.0, 0.0, 2.0 * kG, -0.02 * 2.0 * kG, -0.05 * 2.0 * kG, 0.0};
  for (int i = 0; i < 6; ++i) ASSERT_NEAR(g_arm.ft()[i], expected[i], 1e-9);
}

void without_a_tool_it_shows_nothing(void**) {
  PlantParams params = loaded();
  params.payload_kg = 0.0;
  ASSERT_OK(g_arm.load(params));
  for (int k = 0; k < 100; ++k) g_arm.step(JointVector::Zero(), 1e-3);
  assert_true(g_arm.ft().isZero(0.0));
}

// Newton's second law for the point mass; its acceleration from three positions by KDL.
void in_motion_it_shows_the_inertia_of_the_tool(void**) {
  PlantParams params = loaded();
  params.initial_q = Eigen::Map<const JointVector>(kPoses[1]);
  ASSERT_OK(g_arm.load(params));
  constexpr double h_s = 1e-4;
  Vector3 before = FerTip(g_arm.q(), kCom).p, now = before;
  Vector6 shown = g_arm.ft();
  double hardest = 0.0;
  Matrix3 axes = Matrix3::Identity();
  for (int k = 0; k < 3000; ++k) {
    g_arm.step(JointVector::Zero(), h_s);
    const FerTip after(g_arm.q(), kCom);
    if (k > 0) {
      const Vector3 a = (after.p - 2.0 * now + before) / (h_s * h_s);
      const Vector3 force = 2.0 * (axes.transpose() * (Vector3(0.0, 0.0, -kG) - a));
      ASSERT_NEAR((shown - wrench_of(force, kCom)).norm(), 0.0, 1e-3);
      hardest = std::max(hardest, 2.0 * a.norm());
    }
    before = now, now = after.p, axes = after.axes, shown = g_arm.ft();
  }
  assert_true(hardest > 20.0);
}

// Action and reaction: what the wall feels, the sensor feels, less the weight.
void a_wall_that_is_pressed_pushes_the_sensor_back(void**) {
  const PlantParams params = pressing();
  ASSERT_OK(g_arm.load(params));
  const FerTip tip(params.initial_q, params.payload_tip);
  const Vector3 wall(0.0, -1e5 * 2e-4, 0.0), weight(0.0, 0.0, -2.0 * kG);  // base frame, N
  const Vector3 touching = params.payload_tip + tip.axes.transpose() * Vector3(0.0, 0.01, 0.0);
  ASSERT_NEAR((g_arm.contact_force() - wall).norm(), 0.0, 1e-6);
  const Vector6 expected = wrench_of(tip.axes.transpose() * wall, touching) +
                           wrench_of(tip.axes.transpose() * weight, kCom);
  ASSERT_NEAR((g_arm.ft() - expected).norm(), 0.0, 1e-6);
  const JointVector hold = g_arm.stand();
  for (int k = 0; k < 100; ++k) g_arm.step(hold, 1e-3);
  ASSERT_NEAR((g_arm.ft() - expected).norm(), 0.0, 1e-5);
}

/// A robot that stands on its brakes, read cycle by cycle.
struct Reader {
  SimHal hal;
  RobotState state;
  JointVector hold;

  void start(const PlantParams& params, std::uint64_t seed) {
    ASSERT_OK(hal.load(params, seed));
    hal.set_period(1e-3);
    ASSERT_OK(hal.start(CommandMode::kEffort, state));
    hold = state.tau;
  }
  void cycle() {
    ASSERT_OK(hal.write({CommandMode::kEffort, hold}));
    ASSERT_OK(hal.read(state));
  }
};

Reader g_reader, g_twin;

void the_hal_offers_the_sensor_and_reads_it(void**) {
  assert_true(g_reader.hal.capabilities().wrench);
  g_reader.start(loaded(), 1);
  for (int k = 0; k < 10; ++k) {
    assert_memory_equal(g_reader.state.ft.data(), g_reader.hal.arm().ft().data(), sizeof(Vector6));
    g_reader.cycle();
  }
}

void the_bias_is_added_to_what_it_feels(void**) {
  PlantParams params = loaded();
  params.ft_bias_force_N = Vector3(1.0, -2.0, 3.0);
  params.ft_bias_moment_Nm = Vector3(-0.1, 0.2, -0.3);
  g_reader.start(params, 1);
  const double bias[6] = {1.0, -2.0, 3.0, -0.1, 0.2, -0.3};
  for (int i = 0; i < 6; ++i)
    ASSERT_NEAR(g_reader.state.ft[i] - g_reader.hal.arm().ft()[i], bias[i], 1e-12);
}

void its_noise_has_no_mean_and_the_deviations_stated(void**) {
  PlantParams params = loaded();
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
    for (int i = 0; i < 2; ++i) sum[i] += parts[i].sum(), squares[i] += parts[i].squaredNorm();
  }
  for (int i = 0; i < 2; ++i) {  // four standard errors of the estimates from n numbers
    ASSERT_NEAR(sum[i] / n, 0.0, 4.0 / std::sqrt(n));
    ASSERT_NEAR(std::sqrt(squares[i] / n), 1.0, 4.0 / std::sqrt(2.0 * n));
  }
}

void at_a_rate_of_its_own_it_shows_each_value_for_its_period(void**) {
  PlantParams params = loaded();
  params.ft_noise_force_N = 0.5;
  params.ft_rate_hz = 100.0;
  g_reader.start(params, 1);
  Vector6 shown = g_reader.state.ft;
  for (int k = 1; k <= 200; ++k) {
    g_reader.cycle();
    assert_true((g_reader.state.ft == shown) == (k % 10 != 0));
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
    g_reader.cycle(), g_twin.cycle();
    assert_memory_equal(g_reader.state.q.data(), g_twin.state.q.data(), sizeof(JointVector));
    assert_memory_equal(g_reader.state.ft.data(), g_twin.state.ft.data(), sizeof(Vector6));
  }
}

void the_noise_of_the_sensor_is_nobody_elses(void**) {
  PlantParams params = loaded();
  params.position_noise_rad = 1e-4;
  g_reader.start(params, 7);
  params.ft_noise_force_N = 0.5;
  g_twin.start(params, 7);
  for (int k = 0; k < 200; ++k) {
    g_reader.cycle(), g_twin.cycle();
    assert_memory_equal(g_reader.state.q.data(), g_twin.state.q.data(), sizeof(JointVector));
    assert_true(g_reader.state.ft != g_twin.state.ft);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(at_rest_it_shows_the_weight_of_the_tool_downwards),
      cmocka_unit_test(a_tool_that_points_down_pulls_along_the_axis_of_the_flange),
      cmocka_unit_test(without_a_tool_it_shows_nothing),
      cmocka_unit_test(in_motion_it_shows_the_inertia_of_the_tool),
      cmocka_unit_test(a_wall_that_is_pressed_pushes_the_sensor_back),
      cmocka_unit_test(the_hal_offers_the_sensor_and_reads_it),
      cmocka_unit_test(the_bias_is_added_to_what_it_feels),
      cmocka_unit_test(its_noise_has_no_mean_and_the_deviations_stated),
      cmocka_unit_test(at_a_rate_of_its_own_it_shows_each_value_for_its_period),
      cmocka_unit_test(the_same_seed_gives_the_same_bytes_in_contact_too),
      cmocka_unit_test(the_noise_of_the_sensor_is_nobody_elses),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
