// Tests the simulated force/torque sensor: the wrench of weight, inertia and contact, against KDL's
// kinematics and dynamics.
#include <algorithm>
#include <cmath>

#include "sim_plant/arm/arm.hpp"
#include "tests/sim_plant/arm/fer_tip.hpp"
#include "tests/support/testing.hpp"

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

/// The same FER with its tip 0.2 mm deep in a wall.
PlantParams pressing() {
  PlantParams params = loaded();
  params.initial_q[0] = 1.57079632679489662;
  params.payload_tip = Vector3(0.03, 0.0, 0.1);
  params.scene = SceneKind::kWall;
  const double y = FerTip(params.initial_q, params.payload_tip).p.y();
  params.scene_offset.y() = y + 0.01 - 2e-4 - 0.80;
  return params;
}

/// Wrench at the flange, in flange axes, of a force that acts at a point of the flange frame.
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
    for (int k = 0; k < 100; ++k) g_arm.step(hold, 1e-3);  // the motors take over from the brakes
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

// Applies Newton's second law to the point mass; its acceleration comes from three positions by
// KDL.
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
    before = now;
    now = after.p;
    axes = after.axes;
    shown = g_arm.ft();
  }
  assert_true(hardest > 20.0);
}

// The sensor carries the reaction of the wall's force and the weight of the tool.
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

/// The sensor's reading at this instant by KDL's dynamics: the point mass accelerates as it does
/// without motor torque while `contact`, N, acts on the tip's ball from below.
Vector6 by_dynamics(const Arm& arm, const PlantParams& params, const Vector3& contact) {
  const KdlTool tool = {2.0, {kCom.x(), kCom.y(), kCom.z()}};
  const JointVector q = arm.q(), dq = arm.dq(), at_rest = JointVector::Zero();
  JointVector bias;
  Eigen::Matrix<double, kDof, kDof, Eigen::RowMajor> M;
  double inertia[kDof][kDof];
  kdl_inverse_dynamics(q.data(), dq.data(), at_rest.data(), tool, bias.data());
  kdl_mass_matrix(q.data(), tool, inertia);
  M = Eigen::Map<const decltype(M)>(inertia[0]);

  const FerTip com(q, kCom);
  const Vector3 below = com.axes.transpose() * Vector3(0.0, 0.0, -params.tip_radius);
  const Vector3 touching = params.payload_tip + below;
  const JointVector ddq = M.llt().solve(FerTip(q, touching).J.transpose() * contact - bias);
  constexpr double h_s = 1e-5;
  const Eigen::Matrix<double, 3, kDof> ahead = FerTip(q + h_s * dq, kCom).J;
  const Eigen::Matrix<double, 3, kDof> behind = FerTip(q - h_s * dq, kCom).J;
  const Vector3 a = com.J * ddq + (ahead - behind) / (2.0 * h_s) * dq;
  const Vector3 load = 2.0 * (Vector3(0.0, 0.0, -kG) - a);
  return wrench_of(com.axes.transpose() * load, kCom) +
         wrench_of(com.axes.transpose() * contact, touching);
}

void in_an_impact_inertia_and_contact_are_of_one_instant(void**) {
  PlantParams params = loaded();
  params.payload_tip = Vector3(0.03, 0.0, 0.1);
  params.scene = SceneKind::kRamp;
  const double below = FerTip(params.initial_q, params.payload_tip).p.z() - params.tip_radius;
  params.scene_offset = Vector3(1.1, 0.0, below - 0.03 + 0.05);  // the plateau 30 mm below the ball
  ASSERT_OK(g_arm.load(params));
  double hardest = 0.0;
  for (int k = 0; k < 150; ++k) {
    g_arm.step(JointVector::Zero(), 1e-3);
    const Vector3 contact = g_arm.contact_force();
    const Vector6 expected = by_dynamics(g_arm, params, contact);
    ASSERT_NEAR((g_arm.ft() - expected).norm(), 0.0, 1e-6 * (contact.norm() + 100.0));
    hardest = std::max(hardest, contact.norm());
  }
  assert_true(hardest > 300.0);
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
      cmocka_unit_test(in_an_impact_inertia_and_contact_are_of_one_instant),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
