// Orocos KDL as a second opinion on the FER: kinematics and dynamics by code and tables that are
// not ours. Plain arrays only, because kdl.cpp is compiled with exceptions. Base frame, SI units,
// matrices row by row, gravity 9.81 m/s^2 along -z.
#pragma once

namespace tactus {

/// A point mass in the flange frame.
struct KdlTool {
  double mass_kg = 0.0;
  double com[3] = {0.0, 0.0, 0.0};  ///< m
};

/// Position of the flange and its rotation matrix.
void kdl_flange(const double q[7], double p[3], double r[3][3]);

/// Geometric Jacobian of the flange: linear part first.
void kdl_jacobian(const double q[7], double jacobian[6][7]);

/// Joint efforts that hold the arm, N m.
void kdl_gravity(const double q[7], const KdlTool& tool, double g[7]);

/// M ddq + C dq + g, N m.
void kdl_inverse_dynamics(const double q[7], const double dq[7], const double ddq[7],
                          const KdlTool& tool, double tau[7]);

/// Joint-space inertia, kg m^2.
void kdl_mass_matrix(const double q[7], const KdlTool& tool, double m[7][7]);

/// C dq, N m.
void kdl_coriolis(const double q[7], const double dq[7], const KdlTool& tool, double c[7]);

}  // namespace tactus
