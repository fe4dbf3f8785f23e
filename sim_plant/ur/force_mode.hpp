// What a program asked of force mode. The arm of the emulator stays stiff: it is remembered, and
// nothing comes of it.
#pragma once

#include "sim_plant/ur/kinematics.hpp"

namespace tactus::ur {

struct ForceMode {
  bool active = false;
  Vector6 task_frame = Vector6::Zero();  ///< pose in the base: m, rotation vector in rad
  Vector6 selection = Vector6::Zero();   ///< 1: compliant
  Vector6 wrench = Vector6::Zero();      ///< N, N m
  int type = 2;                          ///< 1: y to the tip, 2: fixed, 3: x along the motion
  Vector6 limits = Vector6::Zero();      ///< compliant: m/s, rad/s; others: m, rad
};

}  // namespace tactus::ur
