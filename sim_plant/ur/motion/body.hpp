// The simulated arm of the controller, with its joint controllers and surroundings.
#pragma once

#include "sim_plant/arm/arm.hpp"
#include "sim_plant/arm/plant_params.hpp"
#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

// Surroundings: how the arm of an emulated controller is mounted, what it carries and can touch.
// The controller knows mounting and payload; the boxes it does not know.

/// Stiffness of a surface, N/m. The simulated arm is rigid, the gears of a robot are not: three
/// joints of 2e4 to 4e4 N m/rad (an order of magnitude, from catalogues of harmonic drives) at 0.4
/// to 0.6 m leave some 3e4 N/m at the tip, in series with the 1e5 N/m of a simulated surface.
inline constexpr double kStiffness = 2e4;

struct Surroundings {
  Vector3 mounting = Vector3::Zero();  ///< of the base in the world: roll, pitch, yaw, rad
  double payload_kg = 0.0;
  Vector3 payload_com = Vector3::Zero();  ///< m, flange frame
  Vector3 tip = Vector3::Zero();          ///< centre of the ball that touches, m, flange frame
  double tip_radius = 0.01;               ///< of the ball, m
  Material material = {kStiffness};       ///< of all boxes
  Scene scene;                            ///< in the base frame of the controller
};

/// Body: the arm with its joint controllers. The targets are interpolated within a cycle; in every
/// inner step computed torque commands the acceleration
///
///   ddq = 2/T (dq_t - dq) + 1/T^2 (q_t - q)
///
/// up to the limits of the drives. A test can push the arm with additional torques. The arm touches
/// its surroundings as a simulated one does; the controllers do not know these forces.
class Body {
 public:
  /// Builds the arm at `q` with its brakes closed. [init]
  Status load(const Joints& q, const Surroundings& around = {});

  /// Runs one cycle of `h_s` from the targets of the last cycle to `q_t`, brakes open. [cyclic]
  void move(const Joints& q_t, double h_s);
  /// Runs one cycle without targets: the drives carry the weight and slow the arm down with the
  /// time constant `slowing_s`. [cyclic]
  void drift(double slowing_s, double h_s);
  /// Runs one cycle with the brakes closed. [cyclic]
  void stand();

  /// Sets the joint torques that push the arm, N m; zero: none. [any]
  void push(const Joints& tau) { push_ = tau; }

  Vector3 base_gravity() const { return arm_.base_gravity(); }  ///< of gravity, m/s^2, base frame
  Joints q() const { return arm_.q(); }                         ///< rad
  Joints dq() const { return arm_.dq(); }                       ///< rad/s
  const Joints& tau() const { return tau_; }  ///< torque of the drives, mean of the cycle, N m
  /// Torque that the targets need if nothing pushes the arm, N m.
  const Joints& model() const { return model_; }
  /// Difference of the two, low-pass filtered, N m; shows a collision.
  const Joints& residual() const { return residual_; }
  bool diverged() const { return arm_.diverged(); }

 private:
  Joints expected(const Joints& ddq);

  Arm arm_;
  Joints target_ = Joints::Zero(), slope_ = Joints::Zero();
  Joints tau_ = Joints::Zero(), model_ = Joints::Zero(), push_ = Joints::Zero();
  Joints residual_ = Joints::Zero();
};

}  // namespace tactus::ur
