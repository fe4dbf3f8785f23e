// Converts the force that a controller reports to the reading of a force/torque sensor at the
// flange. The controller reports the force of the environment in the axes of the base, without the
// weight of the payload; its moment is about the tip on a CB3, about the origin of the flange on an
// e-Series, where the sensor is (Universal_Robots_ROS2_Driver, transformForceTorque). The sensor's
// reading is about the origin of the flange, in its axes, with the weight:
//
//   f = R^T (f_tcp + m g),  m_0 = R^T m_tcp + p x R^T f_tcp + c x R^T m g
//
// with p that of the tip, or zero, R from the pose of the tip, whose axes are the flange's, and the
// gravity g of the tool, in the base.
#pragma once

#include "hal/ur/ur_state.hpp"
#include "kernel/math/so3.hpp"

namespace tactus::ur {

/// Returns [force; moment] in N, N m; `tool` is the payload set in the controller, whose software
/// is `version`. [cyclic]
inline Vector6 flange_wrench(const UrState& state, const Tool& tool, const Version& version) {
  const Eigen::Quaterniond to_flange = exp_so3(state.tcp_pose.tail<3>()).conjugate();
  const Vector3 force = to_flange * Vector3(state.tcp_force.head<3>());
  const Vector3 weight = to_flange * Vector3(tool.mass_kg * tool.gravity);
  const Vector3 lever = version.major < 5 ? tool.tip.p : Vector3(Vector3::Zero());
  Vector6 wrench;
  wrench.head<3>() = force + weight;
  wrench.tail<3>() =
      to_flange * Vector3(state.tcp_force.tail<3>()) + lever.cross(force) + tool.com.cross(weight);
  return wrench;
}

}  // namespace tactus::ur
