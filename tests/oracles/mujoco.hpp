// MuJoCo as an oracle for the robot, loaded with the plant's own MJCF without friction, rotor
// inertia and payload. Plain arrays; base frame, SI units, matrices row by row, gravity 9.81 m/s^2
// along -z.
#pragma once

#include "kernel/robots/robot.hpp"

namespace tactus {

/// Position of the flange and its rotation matrix.
void mujoco_flange(const double q[Robot::kDof], double p[3], double r[3][3]);

/// Geometric Jacobian of the flange: linear part first.
void mujoco_jacobian(const double q[Robot::kDof], double jacobian[6][Robot::kDof]);

/// Joint efforts that hold the arm, N m.
void mujoco_gravity(const double q[Robot::kDof], double g[Robot::kDof]);

/// C dq, N m.
void mujoco_coriolis(const double q[Robot::kDof], const double dq[Robot::kDof],
                     double c[Robot::kDof]);

/// Joint-space inertia, kg m^2.
void mujoco_mass_matrix(const double q[Robot::kDof], double m[Robot::kDof][Robot::kDof]);

}  // namespace tactus
