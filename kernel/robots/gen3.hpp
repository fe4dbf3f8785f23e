// Kinova Gen3 of seven joints with a spherical wrist, without the vision module: the constant
// table.
//
// Kinematics, inertias: the manufacturer's URDF, ros2_kortex, kortex_description,
// arms/gen3/7dof/urdf/gen3_macro.xacro (vision off), whose roundings of pi/2 and pi are quarter
// turns here. The base is base_link, the flange end_effector_link.
//
// Position, velocity, torque: the same URDF and GEN3-7DOF-NOVISION_FOR_URDF_ARM_V12.urdf of
// ros_kortex. The user guide EN-UG-014 has, as others quote it, 128.9, 147.8 and 120.3
// degrees, 1.39 and 1.22 rad/s, and 39 and 9 N m. Acceleration: 297.94 and 572.95 degrees/s^2, user
// guide r9.1, as quoted by roahmlab/RAPTOR, Examples/Kinova/KinovaConstants.h. The manufacturer
// states neither jerk nor torque rate. Jerk: chosen, so that full acceleration takes 10 ms. Torque
// rate: chosen, full torque in 0.1 s.
//
// Joints 1, 3, 5 and 7 have no stops: the URDF calls them continuous. Their range is chosen as two
// turns to either side: the limits of a joint are finite here, and no task that begins at home
// winds further. The robot reports its angles within one turn, so a board for a real one has to
// count the turns.
//
// Tip: speed chosen; acceleration and jerk follow from those of a large joint at 0.9 m, the reach;
// turning is that of one wrist joint; the force is the weight of the 4 kg that the user guide
// allows in the middle of the range.
#pragma once

#include <array>

#include "kernel/robots/robot_table.hpp"

namespace tactus {

struct Gen3 {
  static constexpr int kDof = 7;
  static constexpr const char* kName = "gen3";

  static constexpr std::array<const char*, kDof> kJointNames = {
      "joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6", "joint_7"};

  // clang-format off
  //   x     y           z           roll
  static constexpr std::array<JointFrame, kDof> kJoints = {{
      {0.0,  0.0,        0.15643,     2},
      {0.0,  0.005375,  -0.12838,     1},
      {0.0, -0.21038,   -0.006375,   -1},
      {0.0,  0.006375,  -0.21038,     1},
      {0.0, -0.20843,   -0.006375,   -1},
      {0.0,  0.00017505, -0.10593,    1},
      {0.0, -0.10593,   -0.00017505, -1},
  }};
  static constexpr JointFrame kFlange = {0.0, 0.0, -0.061525, 2};

  //   mass    cx        cy         cz         Ixx       Ixy        Ixz       Iyy       Iyz        Izz
  static constexpr std::array<LinkInertia, kDof> kLinks = {{
      {1.3773, -0.000023, -0.010364, -0.07336,  0.00457,   0.000001,  0.000002, 0.004831,  0.000448, 0.001409},
      {1.1636, -0.000044, -0.09958,  -0.013278, 0.011088,  0.000005,  0.0,      0.001072, -0.000691, 0.011255},
      {1.1636, -0.000044, -0.006641, -0.117892, 0.010932,  0.0,      -0.000007, 0.011127,  0.000606, 0.001043},
      {0.9302, -0.000018, -0.075478, -0.015006, 0.008147, -0.000001,  0.0,      0.000631, -0.0005,   0.008316},
      {0.6781,  0.000001, -0.009432, -0.063883, 0.001596,  0.0,       0.0,      0.001607,  0.000256, 0.000399},
      {0.6781,  0.000001, -0.045483, -0.00965,  0.001641,  0.0,       0.0,      0.00041,  -0.000278, 0.001641},
      {0.364,  -0.000093,  0.000132, -0.022905, 0.000214,  0.0,       0.000001, 0.000223, -0.000002, 0.00024},
  }};

  static constexpr unsigned kContinuousJoints = 0b1010101;  // bit i: joint i has no stops
  static constexpr double kTwoTurns = 12.5663706143591729539;  // rad

  //    q_min       q_max      dq      ddq   dddq    tau   dtau
  static constexpr std::array<JointLimit, kDof> kLimits = {{
      {-kTwoTurns, kTwoTurns, 1.3963,  5.2,  520.0, 39.0, 390.0},
      {-2.24,      2.24,      1.3963,  5.2,  520.0, 39.0, 390.0},
      {-kTwoTurns, kTwoTurns, 1.3963,  5.2,  520.0, 39.0, 390.0},
      {-2.57,      2.57,      1.3963,  5.2,  520.0, 39.0, 390.0},
      {-kTwoTurns, kTwoTurns, 1.2218, 10.0, 1000.0,  9.0,  90.0},
      {-2.09,      2.09,      1.2218, 10.0, 1000.0,  9.0,  90.0},
      {-kTwoTurns, kTwoTurns, 1.2218, 10.0, 1000.0,  9.0,  90.0},
  }};

  //                                         v    a    j      w       alpha dalpha  force moment
  static constexpr TaskLimit kTaskLimit = {0.5, 4.7, 470.0, 1.2218, 10.0, 1000.0, 39.0, 9.0};
  // clang-format on
};

}  // namespace tactus
