// What a force/torque sensor at the flange would show, from the force that a controller states at
// the tip: there it is what the environment exerts, at the tip and in the axes of the base, without
// the weight of the payload. Turned into the axes of the flange, moved to its origin, the weight
// added again:
//
//   f = R^T (f_tcp + m g),  m_0 = R^T m_tcp + p_tip x R^T f_tcp + c x R^T m g
//
// with R from the pose of the tip, whose axes are the flange's, and g = 9.81 m/s^2 downwards.
#pragma once

#include "hal/ur/ur_state.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/model/robot_table.hpp"

namespace tactus::ur {

/// [force; moment] in N, N m; `tool` is the payload that the controller was told. [cyclic]
inline Vector6 flange_wrench(const UrState& state, const Tool& tool) {
  const Eigen::Quaterniond to_flange = exp_so3(state.tcp_pose.tail<3>()).conjugate();
  const Vector3 force = to_flange * Vector3(state.tcp_force.head<3>());
  const Vector3 weight = to_flange * Vector3(0.0, 0.0, -tool.mass_kg * kGravity_m_s2);
  Vector6 wrench;
  wrench.head<3>() = force + weight;
  wrench.tail<3>() = to_flange * Vector3(state.tcp_force.tail<3>()) + tool.tip.p.cross(force) +
                     tool.com.cross(weight);
  return wrench;
}

}  // namespace tactus::ur
