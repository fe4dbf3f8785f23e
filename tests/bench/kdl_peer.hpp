// The benchmarked computations by Orocos KDL. The interface uses plain arrays because kdl_peer.cpp
// is compiled with exceptions. The chain and the solvers are built at the first call and kept.
#pragma once

namespace tactus {

/// Position, rotation matrix (row by row) and Jacobian (linear first) of the flange in the base.
void kdl_peer_forward_kinematics(const double* q, double* p, double* r, double* jacobian);
void kdl_peer_gravity(const double* q, double* g);
void kdl_peer_inverse_dynamics(const double* q, const double* dq, const double* ddq, double* tau);

}  // namespace tactus
