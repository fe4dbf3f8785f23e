// Sources of the numbers.
//
// Kinematics: the manufacturer's standard DH table, "DH parameters for calculations of kinematics
// and dynamics", UR10:
//   i      1       2       3        4         5       6
//   a      0      -0.612  -0.5723   0         0       0       m
//   d      0.1273  0       0        0.163941  0.1157  0.0922  m
//   alpha  90      0       0        90       -90      0       deg
// T(i-1,i) = RotZ(q_i) TransZ(d) TransX(a) RotX(alpha). The frame of a body is DH frame i, at the
// far end of its link: at q = 0 it is at (a, 0, d) in its parent, turned by alpha about x. Its
// joint turns about z of frame i-1: in frame i an axis along (0, sin(alpha), cos(alpha)) through
// -(a, d sin(alpha), d cos(alpha)). The flange is frame 6.
//
// Inertias: Universal_Robots_ROS2_Description 2.4.5, config/ur10/physical_parameters.yaml, in DH
// axes, before the rotations that the package adds; kg, m, kg m^2. A tensor is about the centre of
// mass and is user data of its body in the order xx yy zz xy xz yz.
//
// Friction: none, because no identification on a UR10 (CB3) has been found; the scale a of the
// sigmoid is zero.
//
// The base does not move and needs no inertia. As with the FER, there are no end stops.
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {
namespace {

constexpr const char* kBodies = R"(
    <body name="link1" pos="0 0 0.1273" euler="90 0 0"
          user="0.03408 0.03529 0.02156 0.00002 -0.00425 0.00008">
      <inertial mass="7.1" pos="0.021 0 0.027" diaginertia="1 1 1"/>
      <joint name="joint1" pos="0 -0.1273 0" axis="0 1 0"/>
    <body name="link2" pos="-0.612 0 0"
          user="0.02814 0.77068 0.76943 0.00005 -0.01561 0.00002">
      <inertial mass="12.7" pos="0.38 0 0.158" diaginertia="1 1 1"/>
      <joint name="joint2" pos="0.612 0 0" axis="0 0 1"/>
    <body name="link3" pos="-0.5723 0 0"
          user="0.01014 0.30928 0.30646 0.00008 0.00916 0">
      <inertial mass="4.27" pos="0.24 0 0.068" diaginertia="1 1 1"/>
      <joint name="joint3" pos="0.5723 0 0" axis="0 0 1"/>
    <body name="link4" pos="0 0 0.163941" euler="90 0 0"
          user="0.00296 0.00222 0.00258 -0.00001 0 -0.00024">
      <inertial mass="2.0" pos="0 0.007 0.018" diaginertia="1 1 1"/>
      <joint name="joint4" pos="0 -0.163941 0" axis="0 1 0"/>
    <body name="link5" pos="0 0 0.1157" euler="-90 0 0"
          user="0.00296 0.00222 0.00258 -0.00001 0 -0.00024">
      <inertial mass="2.0" pos="0 0.007 0.018" diaginertia="1 1 1"/>
      <joint name="joint5" pos="0 0.1157 0" axis="0 -1 0"/>
    <body name="link6" pos="0 0 0.0922"
          user="0.0004 0.00041 0.00034 0 0 0">
      <inertial mass="0.365" pos="0 0 -0.026" diaginertia="1 1 1"/>
      <joint name="joint6" pos="0 0 -0.0922" axis="0 0 1"/>
    <body name="flange">
)";

constexpr RobotMjcf kUr10 = {
    kBodies,
    // Where the paper's UR10 pipelines begin: upper arm nearly upright, flange in front.
    {0.0, -1.67, 1.87, 2.94, -1.57, 0.0},
    3.14159265358979323846,
    // The manufacturer's article "Max. joint torques"; the speeds at which the CB3's safety system
    // steps in by default (131.46 and 191.46 degrees per second).
    {330.0, 330.0, 150.0, 56.0, 56.0, 56.0},
    {2.2944, 2.2944, 3.3416, 3.3416, 3.3416, 3.3416}};

}  // namespace

const RobotMjcf& robot_mjcf() {
  return kUr10;
}

}  // namespace tactus
