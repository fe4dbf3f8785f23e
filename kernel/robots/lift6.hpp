// Lift6: the table of constants, written by scripts/robot-import from lift6.urdf.
//
// Base base, flange flange. Kinematics, inertias, position, velocity and torque are those of the
// URDF; acceleration, jerk, torque rate and the limits of the tip are options of the import. A
// joint without stops has a range of two turns to either side, which is chosen.
#pragma once

#include <array>

#include "kernel/robots/robot_table.hpp"

namespace tactus {

struct Lift6 {
  static constexpr int kDof = 6;
  static constexpr const char* kName = "lift6";

  static constexpr std::array<const char*, kDof> kJointNames = {
      "lift", "shoulder", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll"};

  // clang-format off
  //   x, y, z, roll, turn
  static constexpr std::array<JointFrame, kDof> kJoints = {{
      {0.0, 0.0, 0.4, 0, 0.0, JointType::kPrismatic},
      {0.02, 0.0, 0.12, 0},
      {0.36, 0.0, 0.1, 0},
      {0.3, 0.0, -0.06, 0},
      {0.0, 0.0, -0.12, -1, 1.5707963267948966},
      {0.0, -0.11, 0.0, 1},
  }};
  static constexpr JointFrame kFlange = {0.0, 0.0, 0.03, 0};

  //   mass, cx, cy, cz, Ixx, Ixy, Ixz, Iyy, Iyz, Izz
  static constexpr std::array<LinkInertia, kDof> kLinks = {{
      {6.0, 0.01, 0.0, 0.02, 0.0362, 0.0, 0.0, 0.04, 0.0, 0.0362},
      {5.0, 0.17, 0.0, 0.02, 0.01017, 0.0, 0.0, 0.07767, 0.0, 0.0795},
      {3.2, 0.13, 0.0, 0.03, 0.00483, 0.0, 0.0, 0.03299, 0.0, 0.03349},
      {1.4, 0.0, 0.0, -0.03, 0.00323, 0.0, 0.0, 0.00323, 0.0, 0.00189},
      {0.9, 0.0, -0.03, 0.0, 0.00156, 0.0, 0.0, 0.00096, 0.0, 0.00156},
      {0.35, 0.0, 0.0, 0.01, 0.00017, 0.0, 0.0, 0.00017, 0.0, 0.00029},
  }};

  static constexpr unsigned kContinuousJoints = 0b100000;  // bit i: joint i has no stops

  //   q_min, q_max, dq, ddq, dddq, tau, dtau
  static constexpr std::array<JointLimit, kDof> kLimits = {{
      {0.0, 1.0, 1.0, 5.0, 500.0, 1200.0, 16000.0},
      {-2.4, 2.4, 2.0, 8.0, 800.0, 180.0, 3000.0},
      {-2.5, 2.5, 2.4, 8.0, 800.0, 120.0, 2000.0},
      {-2.6, 2.6, 3.0, 12.0, 1200.0, 45.0, 800.0},
      {-0.5, 2.0, 3.0, 12.0, 1200.0, 40.0, 800.0},
      {-12.566370614359172, 12.566370614359172, 4.0, 16.0, 1600.0, 20.0, 400.0},
  }};

  //                                         v, a, j, w, alpha, dalpha, force, moment
  static constexpr TaskLimit kTaskLimit = {0.8, 4.0, 400.0, 2.0, 8.0, 800.0, 100.0, 20.0};
  // clang-format on
};

}  // namespace tactus
