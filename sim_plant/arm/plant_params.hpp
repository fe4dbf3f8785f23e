// PlantParams: the [plant] section of a pipeline file, which describes a simulated robot. Boards
// with a real robot do not have this section.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"
#include "sim_plant/arm/robot_mjcf.hpp"
#include "sim_plant/arm/scene.hpp"

namespace tactus {

inline constexpr int kMaxDelayCycles = 16;

/// Default initial position of the robot, rad.
inline JointVector ready_pose() {
  return JointVector(robot_mjcf().ready_pose.data());
}

struct PlantParams {
  /// Position of the arm before the first cycle.
  JointVector initial_q = ready_pose();  ///< rad

  /// Scales the friction that was identified on the robot (see <robot>_mjcf.cpp; some robots have
  /// none); 0 switches it off.
  double friction = 1.0;

  /// Rotor inertia seen at the joint, kg m^2; adds to the diagonal of the mass matrix. The
  /// identified link inertias contain none of it, because the FER measures torque behind the gear.
  /// Figures for the FER are not published; those of the FR3 are 0.2 to 0.6 kg m^2 (given by the
  /// manufacturer through Drake). The drives' inner torque loop compensates most of it; the rest is
  /// assumed to be 0.1 kg m^2 on every joint, the figure that mujoco_menagerie also uses, for the
  /// UR10e too. 0 makes the drives ideal.
  JointVector rotor_inertia = JointVector::Constant(0.1);

  /// Standard deviations of the white noise on the measured state.
  double position_noise_rad = 0.0;
  double velocity_noise_rad_s = 0.0;

  /// Time constant of the robot's own servo, which takes positions or velocities: see servo.hpp.
  /// 0: ideal, the arm reaches its target at the end of the period.
  double servo_time_constant_s = 0.0;

  /// As [robot] mounting; NaN: that of [robot], or upright.
  Vector3 mounting = Vector3::Constant(kRequired);

  int delay_cycles = 0;  ///< delay of the measured state, whole cycles

  /// Cycles that the drives take to become enabled, and to become disabled. 0: those of one write.
  int arming_cycles = 0;

  /// The load of the flange, which the controller need not know: a point mass, and a ball that can
  /// touch the scene.
  double payload_kg = 0.0;
  Vector3 payload_com = Vector3::Zero();  ///< m, flange frame
  Vector3 payload_tip = Vector3::Zero();  ///< centre of the ball, m, flange frame
  double tip_radius = 0.01;               ///< of the ball, m

  /// The surroundings of the robot (scene.hpp), moved by an offset.
  SceneKind scene = SceneKind::kNone;
  Vector3 scene_offset = Vector3::Zero();  ///< m, in base_link: see scene.hpp
  Material material;                       ///< of the whole scene

  /// The force/torque sensor at the flange: standard deviation of its white noise, reading without
  /// load, and sample rate; 0: one sample per cycle.
  double ft_noise_force_N = 0.0;
  double ft_noise_moment_Nm = 0.0;
  Vector3 ft_bias_force_N = Vector3::Zero();
  Vector3 ft_bias_moment_Nm = Vector3::Zero();
  double ft_rate_hz = 0.0;

  /// Returns the same arm, mounted as its controller takes it to be unless it is said otherwise.
  PlantParams mounted_as(const Vector3& believed) const {
    PlantParams mounted = *this;
    if (mounting.hasNaN()) mounted.mounting = believed;
    return mounted;
  }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("initial_q", initial_q, Range{-6.3, 6.3}, "rad");  // refuses degrees
    visit.param("friction", friction, Range{0.0, 10.0}, "1");
    visit.param("rotor_inertia", rotor_inertia, Range{0.0, 10.0}, "kg m^2");
    visit.param("position_noise_rad", position_noise_rad, Range{0.0, 0.1}, "rad");
    visit.param("velocity_noise_rad_s", velocity_noise_rad_s, Range{0.0, 1.0}, "rad/s");
    visit.param("servo_time_constant_s", servo_time_constant_s, Range{0.0, 1.0}, "s");
    visit.optional("mounting", mounting, Range{-3.15, 3.15}, "rad");
    visit.param("delay_cycles", delay_cycles, Range{0.0, kMaxDelayCycles}, "cycles");
    visit.param("arming_cycles", arming_cycles, Range{0.0, 100000.0}, "cycles");
    visit.param("payload_kg", payload_kg, Range{0.0, 20.0}, "kg");
    visit.param("payload_com", payload_com, Range{-1.0, 1.0}, "m");
    visit.param("payload_tip", payload_tip, Range{-2.0, 2.0}, "m");
    visit.param("tip_radius", tip_radius, Range{0.0, 0.1}, "m");
    visit.choice("scene", scene);
    visit.param("scene_offset", scene_offset, Range{-2.0, 2.0}, "m");
    visit.param("contact_stiffness", material.stiffness, Range{1e3, 1e6}, "N/m");
    visit.param("contact_dissipation", material.dissipation, Range{0.0, 100.0}, "s/m");
    visit.param("contact_friction", material.friction, Range{0.0, 2.0}, "1");
    visit.param("ft_noise_force_N", ft_noise_force_N, Range{0.0, 100.0}, "N");
    visit.param("ft_noise_moment_Nm", ft_noise_moment_Nm, Range{0.0, 10.0}, "N m");
    visit.param("ft_bias_force_N", ft_bias_force_N, Range{-1000.0, 1000.0}, "N");
    visit.param("ft_bias_moment_Nm", ft_bias_moment_Nm, Range{-100.0, 100.0}, "N m");
    visit.param("ft_rate_hz", ft_rate_hz, Range{0.0, 10000.0}, "Hz");
  }
};

}  // namespace tactus
