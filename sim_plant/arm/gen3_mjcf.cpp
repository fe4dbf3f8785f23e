// Sources of the numbers.
//
// Kinematics and inertias: the manufacturer's URDF, ros2_kortex, kortex_description,
// arms/gen3/7dof/urdf/gen3_macro.xacro, without the vision module. There the frames of the links
// are rolled; here every body has the axes of the base while the arm points straight up, at q = 0.
// Then the joints turn about -z and y of the base in turn, and a vector (x, y, z) of an odd link is
// (x, -y, -z), that of an even link (x, z, -y). Lengths in m, masses in kg. A tensor is about the
// centre of mass, kg m^2, and is user data of its body in the order xx yy zz xy xz yz.
//
// Friction: none, because none is published by the manufacturer; the scale a of the sigmoid is
// zero.
//
// The base does not move and needs no inertia. There are no end stops, as with the FER.
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {
namespace {

constexpr const char* kBodies = R"(
    <body name="link1" pos="0 0 0.15643"
          user="0.00457 0.004831 0.001409 -1e-6 -2e-6 0.000448">
      <inertial mass="1.3773" pos="-2.3e-5 0.010364 0.07336" diaginertia="1 1 1"/>
      <joint name="joint1" axis="0 0 -1"/>
    <body name="link2" pos="0 -0.005375 0.12838"
          user="0.011088 0.011255 0.001072 0 -5e-6 0.000691">
      <inertial mass="1.1636" pos="-4.4e-5 -0.013278 0.09958" diaginertia="1 1 1"/>
      <joint name="joint2" axis="0 1 0"/>
    <body name="link3" pos="0 -0.006375 0.21038"
          user="0.010932 0.011127 0.001043 0 7e-6 0.000606">
      <inertial mass="1.1636" pos="-4.4e-5 0.006641 0.117892" diaginertia="1 1 1"/>
      <joint name="joint3" axis="0 0 -1"/>
    <body name="link4" pos="0 -0.006375 0.21038"
          user="0.008147 0.008316 0.000631 0 1e-6 0.0005">
      <inertial mass="0.9302" pos="-1.8e-5 -0.015006 0.075478" diaginertia="1 1 1"/>
      <joint name="joint4" axis="0 1 0"/>
    <body name="link5" pos="0 -0.006375 0.20843"
          user="0.001596 0.001607 0.000399 0 0 0.000256">
      <inertial mass="0.6781" pos="1e-6 0.009432 0.063883" diaginertia="1 1 1"/>
      <joint name="joint5" axis="0 0 -1"/>
    <body name="link6" pos="0 -0.00017505 0.10593"
          user="0.001641 0.001641 0.00041 0 0 0.000278">
      <inertial mass="0.6781" pos="1e-6 -0.00965 0.045483" diaginertia="1 1 1"/>
      <joint name="joint6" axis="0 1 0"/>
    <body name="link7" pos="0 -0.00017505 0.10593"
          user="0.000214 0.000223 0.00024 0 -1e-6 -2e-6">
      <inertial mass="0.364" pos="-9.3e-5 -0.000132 0.022905" diaginertia="1 1 1"/>
      <joint name="joint7" axis="0 0 -1"/>
    <body name="flange" pos="0 0 0.061525">
)";

constexpr double kPi = 3.14159265358979323846;

constexpr RobotMjcf kGen3 = {
    kBodies,
    // The manufacturer's home position: 0 15 180 -130 0 55 90 degrees.
    {0.0, kPi / 12.0, kPi, -13.0 * kPi / 18.0, 0.0, 11.0 * kPi / 36.0, kPi / 2.0},
    0.0,
    // Torque as in the URDF; 100 and 180 degrees per second, user guide r9.1, as quoted by
    // roahmlab/RAPTOR, Examples/Kinova/KinovaConstants.h.
    {39.0, 39.0, 39.0, 39.0, 9.0, 9.0, 9.0},
    {1.7453, 1.7453, 1.7453, 1.7453, 3.1416, 3.1416, 3.1416}};

}  // namespace

const RobotMjcf& robot_mjcf() {
  return kGen3;
}

}  // namespace tactus
