// Body: the arm under its joint controllers. The targets of a cycle are interpolated; in every
// inner step computed torque asks for the acceleration
//
//   ddq = 2/T (dq_t - dq) + 1/T^2 (q_t - q)
//
// which the drives exert as far as they can. What pushes the arm besides comes from whoever tests.
#pragma once

#include "sim_plant/arm.hpp"
#include "sim_plant/ur/kinematics.hpp"

namespace tactus::ur {

class Body {
 public:
  /// The arm at `q` with its brakes closed. [init]
  Status load(const Joints& q, double payload_kg, const Vector3& payload_com);

  /// One cycle of `h_s` from the targets of the last cycle to `q_t`, brakes open. [cyclic]
  void move(const Joints& q_t, double h_s);
  /// One cycle without targets: the drives bear the weight, and slow the arm down with the time
  /// constant `slowing_s`. [cyclic]
  void drift(double slowing_s, double h_s);
  /// One cycle with the brakes closed. [cyclic]
  void stand();

  /// Joint torques that push the arm, N m; zero: nothing does. [any]
  void push(const Joints& tau) { push_ = tau; }

  Joints q() const { return arm_.q(); }       ///< rad
  Joints dq() const { return arm_.dq(); }     ///< rad/s
  const Joints& tau() const { return tau_; }  ///< what the drives exerted, mean of the cycle, N m
  /// What the targets would take of an arm that nothing pushes, N m.
  const Joints& model() const { return model_; }
  /// The difference of the two, low-pass filtered: what a collision is known by, N m.
  const Joints& residual() const { return residual_; }
  bool diverged() const { return arm_.diverged(); }

 private:
  Arm arm_;
  Joints target_ = Joints::Zero(), slope_ = Joints::Zero();
  Joints tau_ = Joints::Zero(), model_ = Joints::Zero(), push_ = Joints::Zero();
  Joints residual_ = Joints::Zero();
};

}  // namespace tactus::ur
