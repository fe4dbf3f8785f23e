// Table of constants of the Universal Robots UR10 (CB3).
//
// Kinematics: the manufacturer's DH table in its URDF form, as in Universal_Robots_ROS2_Description
// 2.4.5, config/ur10/default_kinematics.yaml, without its rounding errors of 1e-9. The base is the
// frame `base` of the controller; ROS's base_link is that frame turned by pi about z. The flange is
// frame 6 of the DH table, which ROS calls tool0. A real arm has a calibration of its own
// (scripts/robot-calibrate).
//
// Inertias: the same package, config/ur10/physical_parameters.yaml, given there in DH axes and
// turned here into the axes of the joint frames.
//
// Position, velocity, torque: the same package, config/ur10/joint_limits.yaml, which cites the CB3
// user manual 3.13 and the manufacturer's article on joint torques. The elbow can turn by 2 pi like
// the other joints; the limit of +-pi, as given there, excludes the second half of its range. The
// manufacturer states neither acceleration nor jerk. Acceleration: 5 rad/s^2, as in
// Universal_Robots_ROS2_Driver, ur_moveit_config; with 330 N m against 120 N m of gravity the
// outstretched arm could reach 17 rad/s^2. Jerk: chosen so that full acceleration takes 10 ms,
// little more than a cycle of the controller. Torque rate: chosen so that full torque takes 0.1 s;
// the CB3 takes no torques and states no rate.
//
// Tip: speed and force are the defaults of the CB3's safety settings, 1.5 m/s and 150 N.
// Acceleration and jerk follow from those of a joint at 1.3 m, the reach; the angular limits and
// the moment are those of one wrist joint.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/robots/robot_table.hpp"

namespace tactus {

struct Ur10 {
  static constexpr int kDof = 6;
  static constexpr const char* kName = "ur10";
  /// The controller's checksums of its joints' kinematics; none: the nominal arm.
  static constexpr std::array<std::uint32_t, kDof> kCalibration = {};

  static constexpr std::array<const char*, kDof> kJointNames = {
      "shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
      "wrist_1_joint",      "wrist_2_joint",       "wrist_3_joint"};

  // clang-format off
  //   x        y       z        roll
  static constexpr std::array<JointFrame, kDof> kJoints = {{
      { 0.0,     0.0,    0.1273,    0},
      { 0.0,     0.0,    0.0,       1},
      {-0.612,   0.0,    0.0,       0},
      {-0.5723,  0.0,    0.163941,  0},
      { 0.0,    -0.1157, 0.0,       1},
      { 0.0,     0.0922, 0.0,      -1},
  }};
  static constexpr JointFrame kFlange = {0.0, 0.0, 0.0, 0};

  //   mass   cx       cy      cz      Ixx      Ixy      Ixz       Iyy      Iyz       Izz
  static constexpr std::array<LinkInertia, kDof> kLinks = {{
      { 7.1,   0.021,  -0.027,  0.0,    0.03408, 0.00425,  0.00002, 0.02156, -0.00008, 0.03529},
      {12.7,  -0.232,   0.0,    0.158,  0.02814, 0.00005, -0.01561, 0.77068,  0.00002, 0.76943},
      { 4.27, -0.3323,  0.0,    0.068,  0.01014, 0.00008,  0.00916, 0.30928,  0.0,     0.30646},
      { 2.0,   0.0,    -0.018,  0.007,  0.00296, 0.0,     -0.00001, 0.00258,  0.00024, 0.00222},
      { 2.0,   0.0,     0.018, -0.007,  0.00296, 0.0,      0.00001, 0.00258,  0.00024, 0.00222},
      { 0.365, 0.0,     0.0,   -0.026,  0.00040, 0.0,      0.0,     0.00041,  0.0,     0.00034},
  }};

  static constexpr double kPi = 3.14159265358979323846;

  static constexpr unsigned kContinuousJoints = 0;  // bit i: joint i has no stops

  //    q_min       q_max      dq             ddq  dddq   tau    dtau
  static constexpr std::array<JointLimit, kDof> kLimits = {{
      {-2.0 * kPi, 2.0 * kPi, 2.0 * kPi / 3.0, 5.0, 500.0, 330.0, 3300.0},
      {-2.0 * kPi, 2.0 * kPi, 2.0 * kPi / 3.0, 5.0, 500.0, 330.0, 3300.0},
      {-kPi,       kPi,       kPi,             5.0, 500.0, 150.0, 1500.0},
      {-2.0 * kPi, 2.0 * kPi, kPi,             5.0, 500.0,  56.0,  560.0},
      {-2.0 * kPi, 2.0 * kPi, kPi,             5.0, 500.0,  56.0,  560.0},
      {-2.0 * kPi, 2.0 * kPi, kPi,             5.0, 500.0,  56.0,  560.0},
  }};

  //                                         v    a    j      w    alpha dalpha force  moment
  static constexpr TaskLimit kTaskLimit = {1.5, 6.5, 650.0, kPi, 5.0, 500.0, 150.0, 56.0};
  // clang-format on
};

}  // namespace tactus
