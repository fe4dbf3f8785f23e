// Arm: the rigid-body plant alone. Torque in, motion out; MuJoCo integrates the robot of
// robot_mjcf.hpp
//
//   (M(q) + diag(rotor_inertia)) ddq + C(q, dq) dq + g(q) + friction(dq) = tau + J^T f_e
//
// by the classical Runge-Kutta method of fourth order. The friction is that of Gaz et al., RA-L
// 2019, a sigmoid without a dead zone, evaluated in every stage:
//
//   friction_i(dq) = a_i / (1 + exp(-b_i (dq + c_i))) - a_i / (1 + exp(-b_i c_i))
//
// f_e is what the scene exerts on the tip, evaluated in every stage as well (tip_contact.hpp).
#pragma once

#include "kernel/status.hpp"
#include "kernel/types.hpp"
#include "sim_plant/plant_params.hpp"
#include "sim_plant/tip_contact.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

class Arm {
 public:
  Arm() = default;
  Arm(const Arm&) = delete;
  Arm& operator=(const Arm&) = delete;
  ~Arm();

  /// Builds the arm and stands it at `initial_q`; an arm loaded before is dropped. kBadValue when
  /// a setting is outside its range. All memory is taken here. [init]
  Status load(const PlantParams& params);

  /// Closes the brakes: dq = 0. Returns the torque that takes over from them without a motion, g(q)
  /// of arm and payload, N m, less what the scene takes. The arm is loaded. [any]
  JointVector stand();

  /// Holds the joint torque `tau` (N m) for `dt_s` > 0, in equal inner steps of at most 1 ms, with
  /// a scene 0.25 ms. The arm is loaded. [cyclic]
  void step(const JointVector& tau, double dt_s);

  /// The torque that would give `ddq` (rad/s^2) now, N m: what the equation above says, payload and
  /// scene included. The arm is loaded. [cyclic]
  JointVector inverse_dynamics(const JointVector& ddq);

  bool loaded() const { return data_ != nullptr; }  ///< [any]

  /// True once a torque or the motion was beyond what can be simulated; q and dq then mean nothing
  /// until the next load. [any]
  bool diverged() const;

  JointVector q() const;   ///< true joint positions, rad [any]
  JointVector dq() const;  ///< true joint velocities, rad/s [any]

  /// What environment and payload exert on a sensor at the flange, at its origin and in its axes,
  /// force first, N and N m: at the end of the last step, or since the brakes closed. [any]
  const Vector6& ft() const { return ft_; }
  /// What the scene exerts on the tip, in the base frame, N, at that instant. [any]
  Vector3 contact_force() const { return contact_wrench_.head<3>(); }

  /// Kinetic energy, rotors included, potential energy of arm and payload, and what the contact
  /// stores, J. [any]
  double energy() const;

 private:
  void sense();

  mjModel_* model_ = nullptr;  // owned
  mjData_* data_ = nullptr;    // owned
  TipContact contact_;
  bool carries_ = false;                      // a payload
  Vector6 contact_wrench_ = Vector6::Zero();  // at the flange's origin, base frame
  Vector6 ft_ = Vector6::Zero();
};

}  // namespace tactus
