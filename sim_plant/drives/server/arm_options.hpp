// What the command lines of emulated drives share, whatever their bus: the arm, faults, and the
// time that the program runs, as a plain struct.
#pragma once

#include "sim_plant/drives/driven_arm.hpp"

namespace tactus::drives {

struct ArmOptions {
  static constexpr int kJoints = 7, kFaults = 16;

  bool gravity_by_drive = false;
  bool joints_given = false;
  double joints[kJoints] = {};  ///< initial positions, rad
  double mounting[3] = {};      ///< of the base in the world: roll, pitch, yaw, rad
  double friction = 1.0;        ///< multiple of the identified friction
  double rotor_inertia = 0.1;   ///< kg m^2
  double brake_release_ms = 150.0;
  std::uint32_t velocity_unit = kIncrementsPerSecond;  ///< 60A9h
  double torque_share = 1.0;                           ///< of the motors' torque, that 6072h allows
  double duration_s = 0.0;                             ///< 0: without end
  unsigned seed = 1;                                   ///< of faults by probability
  char faults[kFaults][128] = {};
  int fault_count = 0;

  /// Fills in the arm. [init]
  void apply(DrivenArmSettings& settings) const {
    settings.gravity_by_drive = gravity_by_drive;
    settings.brake_release_s = brake_release_ms * 1e-3;
    settings.velocity_unit = velocity_unit;
    settings.torque_share = torque_share;
    settings.plant.mounting = Vector3(mounting);
    settings.plant.friction = friction;
    settings.plant.rotor_inertia.setConstant(rotor_inertia);
    if (joints_given) settings.plant.initial_q = JointVector(joints);
  }
};

}  // namespace tactus::drives
