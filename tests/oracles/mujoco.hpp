// MuJoCo as an opinion on the FER, from the plant's own MJCF: without friction, rotor inertia and
// payload. Plain arrays; base frame, SI units, matrices row by row, gravity 9.81 m/s^2 along -z.
#pragma once

namespace tactus {

/// Position of the flange and its rotation matrix.
void mujoco_flange(const double q[7], double p[3], double r[3][3]);

/// Geometric Jacobian of the flange: linear part first.
void mujoco_jacobian(const double q[7], double jacobian[6][7]);

/// Joint efforts that hold the arm, N m.
void mujoco_gravity(const double q[7], double g[7]);

/// C dq, N m.
void mujoco_coriolis(const double q[7], const double dq[7], double c[7]);

/// Joint-space inertia, kg m^2.
void mujoco_mass_matrix(const double q[7], double m[7][7]);

}  // namespace tactus
