// Block: what the other blocks know of the arm, at the tool tip and in the base frame.
#pragma once

#include "kernel/brake.hpp"
#include "kernel/port.hpp"
#include "kernel/status.hpp"

namespace tactus {

/// Kinematics, Jacobian and gravity of the measured joints, computed once per cycle.
struct RobotModel {
  static constexpr const char* kType = "robot_model";

  In<Quantity::kJointPosition> q;   ///< measured
  In<Quantity::kJointVelocity> dq;  ///< measured
  In<Quantity::kTool> tool;         ///< optional; without it the tip is the flange, without mass
  Out<Quantity::kPose> x;           ///< the quaternion's sign never jumps; at start() w >= 0
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

  /// Leaves the outputs valid for the present inputs; result as of step(). [init]
  Status start();

  /// kStateNotFinite when any output is not finite, as for an input that is not finite or an angle
  /// beyond kSinCosMax_rad; the outputs then must not be used. [cyclic]
  Status step(double dt_s);
  /// Has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

}  // namespace tactus
