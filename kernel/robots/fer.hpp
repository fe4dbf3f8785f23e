// Table of constants of the Franka Emika Robot (FER, "Panda").
//
// Kinematics: Franka's Craig DH table in its URDF form, as in franka_description 0.4.0,
// robots/fer/kinematics.yaml. Limits: franka_description fer/joint_limits.yaml; acceleration, jerk,
// torque rate and the Cartesian limits from libfranka 0.9.2 rate_limiting.h (the FER generation of
// that file). Inertias: Gaz, Cognetti, Oliva, Robuffo Giordano, De Luca, RA-L 2019, identified on a
// real arm; numbers as in franka_ros 0.10.2 common/inertial.yaml.
//
// The limits of force and moment at the tip follow from the joint torques: 87 N m of the shoulder
// at the longest reach of 0.855 m (data sheet) is 102 N, and a wrist joint gives 12 N m about its
// own axis.
#pragma once

#include <array>

#include "kernel/robots/robot_table.hpp"

namespace tactus {

struct Fer {
  static constexpr int kDof = 7;
  static constexpr const char* kName = "fer";

  static constexpr std::array<const char*, kDof> kJointNames = {
      "fer_joint1", "fer_joint2", "fer_joint3", "fer_joint4",
      "fer_joint5", "fer_joint6", "fer_joint7"};

  // clang-format off
  //   x        y       z     roll
  static constexpr std::array<JointFrame, kDof> kJoints = {{
      { 0.0,     0.0,   0.333,  0},
      { 0.0,     0.0,   0.0,   -1},
      { 0.0,    -0.316, 0.0,    1},
      { 0.0825,  0.0,   0.0,    1},
      {-0.0825,  0.384, 0.0,   -1},
      { 0.0,     0.0,   0.0,    1},
      { 0.088,   0.0,   0.0,    1},
  }};
  static constexpr JointFrame kFlange = {0.0, 0.0, 0.107, 0};

  // Ixx and Iyy of link 1 cannot be identified on a fixed base and have no effect.
  //   mass      cx         cy         cz         Ixx       Ixy        Ixz        Iyy       Iyz        Izz
  static constexpr std::array<LinkInertia, kDof> kLinks = {{
      {4.970684,  0.003875,  0.002081, -0.04762,  0.70337,  -0.000139,  0.006772, 0.70661,   0.019169, 0.009117},
      {0.646926, -0.003141, -0.02872,   0.003495, 0.007962, -0.003925,  0.010254, 0.02811,   0.000704, 0.025995},
      {3.228604,  0.027518,  0.039252, -0.066502, 0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083},
      {3.587895, -0.05317,   0.104419,  0.027454, 0.025853,  0.007796, -0.001332, 0.019552,  0.008641, 0.028323},
      {1.225946, -0.011953,  0.041065, -0.038437, 0.035549, -0.002117, -0.004037, 0.029474,  0.000229, 0.008627},
      {1.666555,  0.060149, -0.014117, -0.010517, 0.001964,  0.000109, -0.001158, 0.004354,  0.000341, 0.005433},
      {0.735522,  0.010517, -0.004252,  0.061597, 0.012516, -0.000428, -0.001196, 0.010027, -0.000741, 0.004815},
  }};

  static constexpr unsigned kContinuousJoints = 0;  // bit i: joint i has no stops

  //    q_min    q_max    dq     ddq   dddq     tau   dtau
  static constexpr std::array<JointLimit, kDof> kLimits = {{
      {-2.8973,  2.8973, 2.175, 15.0,  7500.0, 87.0, 1000.0},
      {-1.7628,  1.7628, 2.175,  7.5,  3750.0, 87.0, 1000.0},
      {-2.8973,  2.8973, 2.175, 10.0,  5000.0, 87.0, 1000.0},
      {-3.0718, -0.0698, 2.175, 12.5,  6250.0, 87.0, 1000.0},
      {-2.8973,  2.8973, 2.61,  15.0,  7500.0, 12.0, 1000.0},
      {-0.0175,  3.7525, 2.61,  20.0, 10000.0, 12.0, 1000.0},
      {-2.8973,  2.8973, 2.61,  20.0, 10000.0, 12.0, 1000.0},
  }};

  //                                         v    a     j       w    alpha dalpha   force  moment
  static constexpr TaskLimit kTaskLimit = {2.0, 13.0, 6500.0, 2.5, 25.0, 12500.0, 100.0, 12.0};
  // clang-format on
};

}  // namespace tactus
