// Arm: the rigid-body plant alone, torque in, motion out. MuJoCo integrates the robot of
// robot_mjcf.hpp
//
//   (M(q) + diag(rotor_inertia)) ddq + C(q, dq) dq + g(q) + friction(dq) = tau + J^T f_e
//
// by the classical Runge-Kutta method of fourth order. The friction is that of Gaz et al., RA-L
// 2019, a sigmoid without a dead zone, evaluated in every stage:
//
//   friction_i(dq) = a_i / (1 + exp(-b_i (dq + c_i))) - a_i / (1 + exp(-b_i c_i))
//
// f_e is the force of the scene on the tip, also evaluated in every stage (tip_contact.hpp).
#pragma once

#include <array>

#include "kernel/core/status.hpp"
#include "kernel/core/types.hpp"
#include "sim_plant/arm/plant_params.hpp"
#include "sim_plant/arm/tip_contact.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

class Arm {
 public:
  Arm() = default;
  Arm(const Arm&) = delete;
  Arm& operator=(const Arm&) = delete;
  ~Arm();

  /// Builds the arm at `initial_q` and drops an arm loaded before. kBadValue if a setting is
  /// outside its range. Allocates all memory. [init]
  Status load(const PlantParams& params);
  /// As load(params), in `scene`, given in the base frame, instead of that of the settings. [init]
  Status load(const PlantParams& params, const Scene& scene);

  /// Closes the brakes: dq = 0. Returns the torque that takes over from them without motion, N m:
  /// g(q) of arm and payload, less the torque of the scene. The arm must be loaded. [any]
  JointVector stand();

  /// Applies the joint torque `tau` (N m) for `dt_s` > 0, in equal inner steps of at most 1 ms,
  /// with a scene 0.25 ms. The arm must be loaded. [cyclic]
  void step(const JointVector& tau, double dt_s);

  /// Returns the torque that would cause `ddq` (rad/s^2) now, N m, by the equation above, payload
  /// and scene included. The arm must be loaded. [cyclic]
  JointVector inverse_dynamics(const JointVector& ddq);

  /// Returns the torque that holds the arm at its present position without motion, N m: g(q) of arm
  /// and payload. The arm must be loaded. [cyclic]
  JointVector gravity();

  /// Returns the torque that lets the joints marked in `held` accelerate by `ddq` (rad/s^2), while
  /// the others get `tau` and follow freely, N m. The arm must be loaded. [cyclic]
  JointVector torque_holding(const std::array<bool, kDof>& held, const JointVector& ddq,
                             const JointVector& tau);

  /// Returns the torque of the scene on the joints, N m, at the state of the last call of step() or
  /// inverse_dynamics(); a controller without a force sensor does not know it. [cyclic]
  JointVector contact_torque() const;

  bool loaded() const { return data_ != nullptr; }  ///< [any]

  /// True after a torque or motion that cannot be simulated; q and dq are then invalid until the
  /// next load. [any]
  bool diverged() const;

  Vector3 base_gravity() const;  ///< of gravity, m/s^2, base frame; the arm must be loaded [any]
  JointVector q() const;         ///< true joint positions, rad [any]
  JointVector dq() const;        ///< true joint velocities, rad/s [any]

  /// The wrench of environment and payload on a sensor at the flange, about its origin and in its
  /// axes, force first, N and N m: at the end of the last step, or since the brakes closed. [any]
  const Vector6& ft() const { return ft_; }
  /// The force of the scene on the tip at the same instant, in the base frame, N. [any]
  Vector3 contact_force() const { return contact_wrench_.head<3>(); }

  /// Kinetic energy, rotors included, plus potential energy of arm and payload, plus energy stored
  /// in contacts, J. [any]
  double energy() const;

 private:
  void sense();

  mjModel_* model_ = nullptr;  // owned
  mjData_* data_ = nullptr;    // owned
  TipContact contact_;
  bool carries_ = false;                      // carries a payload
  Vector6 contact_wrench_ = Vector6::Zero();  // at the flange's origin, base frame
  Vector6 ft_ = Vector6::Zero();
};

}  // namespace tactus
