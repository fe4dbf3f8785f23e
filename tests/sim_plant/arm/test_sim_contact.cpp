// Tests the simulated FER in contact: statics, impact and sliding. Kinematics and gravity come from
// KDL.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/sim_plant/arm/driven_hal.hpp"
#include "tests/sim_plant/arm/fer_tip.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kFace_m = 0.32;  // y of the wall's face in front of the arm below

/// An ideal FER in front of a wall that is moved within its reach: the gap between ball and wall is
/// 3 mm.
PlantParams facing_the_wall() {
  PlantParams params;
  params.initial_q[0] = 1.57079632679489662;
  params.friction = 0.0;
  params.rotor_inertia.setZero();
  params.payload_tip = Vector3(0.0, 0.0, 0.1);
  params.scene = SceneKind::kWall;
  params.scene_offset = Vector3(0.0, kFace_m - 0.80, 0.0);
  return params;
}

/// The arm under joint PD with gravity compensation; the reference follows the desired tip motion.
struct Bench {
  Arm arm;
  PlantParams params;
  JointVector kp, q_d, tau;  // N m/rad, rad, N m
  int pieces = 1;            // steps of the plant in a cycle

  void start(const PlantParams& with) {
    params = with;
    ASSERT_OK(arm.load(params));
    q_d = params.initial_q;
    kp << 600, 600, 600, 600, 120, 120, 60;
    pieces = 1;
  }
  FerTip tip() const { return FerTip(arm.q(), params.payload_tip); }
  /// Runs one cycle in which the reference of the tip moves at `v`, m/s.
  void cycle(const Vector3& v) {
    q_d += FerTip(q_d, params.payload_tip).joints(kPeriod_s * v);
    kdl_gravity(arm.q().data(), {}, tau.data());
    tau += kp.cwiseProduct(q_d - arm.q()) - 0.08 * kp.cwiseProduct(arm.dq());
    for (int i = 0; i < pieces; ++i) arm.step(tau, kPeriod_s / pieces);
  }
  void cycles(int count, const Vector3& v) {
    for (int k = 0; k < count; ++k) cycle(v);
  }
};

Bench g_bench;

// Proves SIM-5.

void a_pressed_wall_pushes_back_with_stiffness_times_depth(void**) {
  Bench& b = g_bench;
  b.start(facing_the_wall());
  b.cycles(500, {0.0, 0.04, 0.0});
  b.cycles(3000, Vector3::Zero());
  const Vector3 f = b.arm.contact_force();
  const double push = 1e5 * (b.tip().p.y() + 0.01 - kFace_m);
  assert_true(push > 10.0);
  ASSERT_NEAR(f.y(), -push, 1e-6);
  assert_true(std::hypot(f.x(), f.z()) <= 0.3 * push);

  // The motor torque beyond gravity balances that push, by the principle of virtual work.
  JointVector g;
  kdl_gravity(b.arm.q().data(), {}, g.data());
  const Vector3 touching = b.params.payload_tip + b.tip().axes.transpose() * Vector3(0, 0.01, 0);
  const JointVector pushed = FerTip(b.arm.q(), touching).J.transpose() * f;
  ASSERT_NEAR((b.tau - g + pushed).norm(), 0.0, 1e-6);
}

void a_tip_that_slides_is_held_back_by_mu_times_the_push(void**) {
  Bench& b = g_bench;
  b.start(facing_the_wall());
  b.cycles(500, {0.0, 0.04, 0.0});
  b.cycles(100, {0.1, 0.0, -0.1});
  for (int k = 0; k < 400; ++k) {
    b.cycle({0.1, 0.0, -0.1});
    const Vector3 f = b.arm.contact_force(), v = b.tip().J * b.arm.dq();
    const Vector3 along = Vector3(v.x(), 0.0, v.z()).normalized();
    ASSERT_NEAR(f.x() / (0.3 * f.y()), along.x(), 0.02);  // f.y < 0; the ball also turns a little
    ASSERT_NEAR(f.z() / (0.3 * f.y()), along.z(), 0.02);
  }
}

// Proves SIM-4, SIM-5.

void an_arm_that_stands_in_contact_is_held_by_the_torque_found(void**) {
  Bench& b = g_bench;
  PlantParams params = facing_the_wall();
  params.scene_offset.y() -= 3.2e-3;  // 0.2 mm deep, roughly
  b.start(params);
  const JointVector hold = b.arm.stand();
  assert_true(b.arm.contact_force().y() < -5.0);
  for (int k = 0; k < 500; ++k) b.arm.step(hold, kPeriod_s);
  ASSERT_NEAR((b.arm.q() - params.initial_q).norm(), 0.0, 1e-9);
}

// Proves SIM-7, SIM-21.

/// At 125 Hz, with 1 kg of tool. A servo that yields within the period accelerates at its end, and
/// a sensor cannot tell that from a force.
void a_servo_does_not_yield_to_the_wall_and_the_sensor_shows_the_push(void**) {
  static SimHal hal;
  PlantParams params = facing_the_wall();
  params.payload_kg = 1.0;
  hal.set_period(8e-3);
  RobotState state;
  ASSERT_OK(hal.load(params, 1));
  ASSERT_OK(arm_drives(hal, CommandMode::kPosition, state));
  JointVector q_c = state.q;
  for (int k = 0; k < 200; ++k) {
    if (k < 100) q_c += FerTip(q_c, params.payload_tip).joints({0.0, 35e-6, 0.0});
    ASSERT_OK(follow(hal, CommandMode::kPosition, q_c));
    ASSERT_NEAR((hal.arm().q() - q_c).norm(), 0.0, 1e-6);
  }
  ASSERT_NEAR((hal.arm().q() - q_c).norm(), 0.0, 1e-9);
  ASSERT_OK(measure(hal, state));
  const Vector3 push = hal.arm().contact_force(), weight(0.0, 0.0, -9.81);
  const Matrix3 axes = FerTip(q_c, params.payload_tip).axes;
  assert_true(push.y() < -10.0);
  ASSERT_NEAR((axes * state.ft.head<3>() - push - weight).norm(), 0.0, 1e-3);
}

// Proves SIM-6.

/// An arm without friction and with 1 kg on its flange falls onto the plateau of the ramp for a
/// second.
struct Fall {
  double lost = 0.0, gained = 0.0;  // J: in all, and the largest gain in one cycle
  double hardest = 0.0;             // N

  explicit Fall(const Material& material) {
    Arm& arm = g_bench.arm;
    PlantParams params = facing_the_wall();
    params.payload_kg = 1.0;
    params.scene = SceneKind::kRamp;
    params.scene_offset = Vector3(0.8, 0.0, 0.43);
    params.material = material;
    ASSERT_OK(arm.load(params));
    const double at_first = arm.energy();
    for (int k = 0; k < 1000; ++k) {
      const double before = arm.energy();
      arm.step(JointVector::Zero(), kPeriod_s);
      gained = std::max(gained, arm.energy() - before);
      hardest = std::max(hardest, arm.contact_force().norm());
    }
    lost = at_first - arm.energy();
  }
};

void an_arm_that_falls_on_a_table_never_gains_energy(void**) {
  for (const Material& material : {Material{1e3, 1.0, 0.3}, Material{1e5, 1.0, 0.3},
                                   Material{1e6, 1.0, 2.0}, Material{1e6, 10.0, 0.3}}) {
    const Fall fall(material);
    print_message("%.0e N/m: up to %.0f N, %.0f J lost, %.0e J gained in a cycle\n",
                  material.stiffness, fall.hardest, fall.lost, fall.gained);
    assert_true(fall.hardest > 100.0 && fall.lost > 10.0);
    assert_true(fall.gained < 1e-4);  // as large as the free swing's error
  }
}

void a_table_without_friction_and_dissipation_keeps_the_energy(void**) {
  const Fall fall({1e5, 0.0, 0.0});
  assert_true(fall.hardest > 1000.0);
  ASSERT_NEAR(fall.lost, 0.0, 0.02);
}

void a_tip_that_slides_under_a_stiff_law_keeps_its_contact(void**) {
  Bench& b = g_bench;
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    for (const double speed : {0.1, 0.2}) {
      PlantParams params = facing_the_wall();
      params.material.stiffness = stiffness;
      params.material.friction = 3.0 * speed;
      params.rotor_inertia = PlantParams().rotor_inertia;
      b.start(params);
      b.kp *= 3.0;
      int k = 0;
      for (; b.arm.contact_force().y() == 0.0; ++k) b.cycle({0.0, 0.02, 0.0});
      double least = kInfinity, most = 0.0;
      for (; k < 1300; ++k) {
        b.cycle(k < 500 ? Vector3(0.0, 0.02, 0.0) : Vector3(0.0, 0.0, -speed));
        const double push = -b.arm.contact_force().y();
        assert_true(push > 0.0);  // from the first touch on
        if (k >= 500) {
          least = std::min(least, push);
          most = std::max(most, push);
        }
      }
      print_message("%.0e N/m, %.1f m/s: %.0f to %.0f N\n", stiffness, speed, least, most);
      assert_true(least > 10.0 && most < 100.0);
    }
  }
}

void shorter_steps_in_contact_give_the_same_motion(void**) {
  Bench& b = g_bench;
  JointVector q[2];
  for (const int n : {0, 1}) {
    PlantParams params = facing_the_wall();
    params.rotor_inertia = PlantParams().rotor_inertia;
    b.start(params);
    b.pieces = n == 0 ? 1 : 16;
    b.cycles(500, {0.0, 0.04, 0.0});
    b.cycles(500, {0.0, 0.0, -0.1});
    q[n] = b.arm.q();
  }
  ASSERT_NEAR((q[0] - q[1]).norm(), 0.0, 1e-6);  // measured 4e-8 rad
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pressed_wall_pushes_back_with_stiffness_times_depth),
      cmocka_unit_test(a_tip_that_slides_is_held_back_by_mu_times_the_push),
      cmocka_unit_test(an_arm_that_stands_in_contact_is_held_by_the_torque_found),
      cmocka_unit_test(a_servo_does_not_yield_to_the_wall_and_the_sensor_shows_the_push),
      cmocka_unit_test(an_arm_that_falls_on_a_table_never_gains_energy),
      cmocka_unit_test(a_table_without_friction_and_dissipation_keeps_the_energy),
      cmocka_unit_test(a_tip_that_slides_under_a_stiff_law_keeps_its_contact),
      cmocka_unit_test(shorter_steps_in_contact_give_the_same_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
