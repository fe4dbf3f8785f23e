// Orocos KDL as the oracle for kinematics and dynamics, with its own code and tables. The interface
// uses plain arrays because kdl.cpp is compiled with exceptions. Base frame, SI units, matrices row
// by row, gravity 9.81 m/s^2 along -z of the world.
#pragma once

#include "kernel/robots/robot.hpp"

namespace tactus {

/// A point mass in the flange frame, and how the base is mounted.
struct KdlTool {
  double mass_kg = 0.0;
  double com[3] = {0.0, 0.0, 0.0};       ///< m
  double mounting[3] = {0.0, 0.0, 0.0};  ///< roll, pitch, yaw, rad
};

/// Gravity in the axes of the base, m/s^2.
void kdl_base_gravity(const KdlTool& tool, double gravity[3]);

/// Position of the flange and its rotation matrix.
void kdl_flange(const double q[Robot::kDof], double p[3], double r[3][3]);

/// Origin and rotation matrix of the frame of link `link`; 0 is the base.
void kdl_link(const double q[Robot::kDof], int link, double p[3], double r[3][3]);

/// Geometric Jacobian of the flange: linear part first.
void kdl_jacobian(const double q[Robot::kDof], double jacobian[6][Robot::kDof]);

/// Joint efforts that hold the arm, N m.
void kdl_gravity(const double q[Robot::kDof], const KdlTool& tool, double g[Robot::kDof]);

/// M ddq + C dq + g, N m.
void kdl_inverse_dynamics(const double q[Robot::kDof], const double dq[Robot::kDof],
                          const double ddq[Robot::kDof], const KdlTool& tool,
                          double tau[Robot::kDof]);

/// Joint-space inertia, kg m^2.
void kdl_mass_matrix(const double q[Robot::kDof], const KdlTool& tool,
                     double m[Robot::kDof][Robot::kDof]);

/// C dq, N m.
void kdl_coriolis(const double q[Robot::kDof], const double dq[Robot::kDof], const KdlTool& tool,
                  double c[Robot::kDof]);

}  // namespace tactus
