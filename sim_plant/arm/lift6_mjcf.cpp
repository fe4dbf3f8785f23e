// Written by scripts/robot-import from lift6.urdf: every body has the frame of its link in the
// URDF, what is fixed to it merged. A tensor is about the centre of mass, kg m^2, in the order xx
// yy zz xy xz yz. Friction: none. The drives give the torque of the URDF, and turn at 1.2 times its
// velocity, which is chosen.
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {
namespace {

constexpr const char* kBodies = R"(
    <body name="link1" pos="0.0 0.0 0.4" quat="1.0 0.0 0.0 0.0"
          user="0.0362 0.04 0.0362 0.0 0.0 0.0">
      <inertial mass="6.0" pos="0.01 0.0 0.02" diaginertia="1 1 1"/>
      <joint name="joint1" type="slide" axis="0.0 0.0 1.0"/>
    <body name="link2" pos="0.02 0.0 0.12" quat="1.0 0.0 0.0 0.0"
          user="0.01017 0.07767 0.0795 0.0 0.0 0.0">
      <inertial mass="5.0" pos="0.17 0.0 0.02" diaginertia="1 1 1"/>
      <joint name="joint2" axis="0.0 0.0 1.0"/>
    <body name="link3" pos="0.36 0.0 0.1" quat="1.0 0.0 0.0 0.0"
          user="0.00483 0.03299 0.03349 0.0 0.0 0.0">
      <inertial mass="3.2" pos="0.13 0.0 0.03" diaginertia="1 1 1"/>
      <joint name="joint3" axis="0.0 0.0 1.0"/>
    <body name="link4" pos="0.3 0.0 -0.06" quat="1.0 0.0 0.0 0.0"
          user="0.00323 0.00323 0.00189 0.0 0.0 0.0">
      <inertial mass="1.4" pos="0.0 0.0 -0.03" diaginertia="1 1 1"/>
      <joint name="joint4" axis="0.0 0.0 1.0"/>
    <body name="link5" pos="0.0 0.0 -0.12" quat="1.0 0.0 0.0 0.0"
          user="0.00096 0.00156 0.00156 0.0 0.0 0.0">
      <inertial mass="0.9" pos="0.03 0.0 0.0" diaginertia="1 1 1"/>
      <joint name="joint5" axis="0.0 1.0 0.0"/>
    <body name="link6" pos="0.11 0.0 0.0" quat="1.0 0.0 0.0 0.0"
          user="0.00029 0.00017 0.00017 0.0 0.0 0.0">
      <inertial mass="0.35" pos="0.01 0.0 0.0" diaginertia="1 1 1"/>
      <joint name="joint6" axis="1.0 0.0 0.0"/>
    <body name="flange" pos="0.03 0.0 0.0" quat="0.7071067811865475 0.0 0.7071067811865475 0.0">
)";

constexpr RobotMjcf kLift6 = {kBodies,
                              {0.6, -0.62, -1.5, 1.42, 0.27, -0.56},
                              0.0,
                              {1200.0, 180.0, 120.0, 45.0, 40.0, 20.0},
                              {1.2, 2.4, 2.88, 3.5999999999999996, 3.5999999999999996, 4.8}};

}  // namespace

const RobotMjcf& robot_mjcf() {
  return kLift6;
}

}  // namespace tactus
