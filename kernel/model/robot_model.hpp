// Block: the state of the arm that the other blocks use, at the tool tip and in the base frame.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"

namespace tactus {

/// Kinematics, Jacobian and gravity of the measured joints, computed once per cycle.
struct RobotModel {
  static constexpr const char* kType = "robot_model";

  In<Quantity::kJointPosition> q;   ///< measured
  In<Quantity::kJointVelocity> dq;  ///< measured
  In<Quantity::kTool> tool;         ///< optional; default: the tip is the flange, no mass
  Out<Quantity::kPose> x;           ///< sign of the quaternion continuous; at start() w >= 0
  Out<Quantity::kTwist> v;          ///< J dq
  Out<Quantity::kJacobian> J;
  Out<Quantity::kJointEffort> g;  ///< holds arm and tool against gravity

  template <class V>
  void describe(V& visit) {
    visit.in("q", q);
    visit.in("dq", dq);
    visit.optional("tool", tool);
    visit.out("x", x);
    visit.out("v", v);
    visit.out("J", J);
    visit.out("g", g);
  }

  /// Computes the outputs from the present inputs; returns the same as step(). [init]
  Status start();

  /// Returns kStateNotFinite if an output is not finite, for example because an input is not finite
  /// or an angle is beyond kSinCosMax_rad; the outputs must then not be used. [cyclic]
  Status step(double dt_s);
  /// Has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

}  // namespace tactus
