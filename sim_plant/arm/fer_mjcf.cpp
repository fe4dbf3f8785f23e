// Sources of the numbers.
//
// Kinematics: Franka's Craig (modified) DH table, Franka Control Interface documentation:
//   i        1      2      3      4        5        6      7      flange
//   a(i-1)   0      0      0      0.0825  -0.0825   0      0.088  0        m
//   alpha    0     -90     90     90      -90       90     90     0        deg, alpha(i-1)
//   d(i)     0.333  0      0.316  0        0.384    0      0      0.107    m
// T(i-1,i) = RotX(alpha) TransX(a) RotZ(q_i) TransZ(d). As d is measured along the new z axis, the
// body is at (a, -d sin(alpha), d cos(alpha)) in its parent, turned by alpha about x.
//
// Inertias: Gaz, Cognetti, Oliva, Robuffo Giordano, De Luca, "Dynamic identification of the Franka
// Emika Panda robot with retrieval of feasible parameters using penalty-based optimization", IEEE
// RA-L 2019, supplement, tables VIII and IX; kg, m, kg m^2. A tensor is about the centre of mass,
// in the axes of the link, and is user data of its body in the order xx yy zz xy xz yz. Only zz of
// link 1 has an effect; the height of its centre of mass is arbitrary and set as in franka_ros.
//
// Friction: the same paper, table I, user data of the joint: the sigmoid's a [N m], b [s/rad],
// c [rad/s].
//
// The base does not move and needs no inertia. There are no end stops: the controller must keep the
// joints within their limits, and end stops would hide its failure to do so.
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {
namespace {

constexpr const char* kBodies = R"(
    <body name="link1" pos="0 0 0.333"
          user="0.70337 0.70661 0.009117 -0.000139 0.006772 0.019169">
      <inertial mass="4.970684" pos="0.003875 0.002081 -0.04762" diaginertia="1 1 1"/>
      <joint name="joint1" user="0.54615 5.1181 0.039533"/>
    <body name="link2" euler="-90 0 0"
          user="0.007962 0.02811 0.025995 -0.003925 0.010254 0.000704">
      <inertial mass="0.646926" pos="-0.003141 -0.02872 0.003495" diaginertia="1 1 1"/>
      <joint name="joint2" user="0.87224 9.0657 0.025882"/>
    <body name="link3" pos="0 -0.316 0" euler="90 0 0"
          user="0.037242 0.036155 0.01083 -0.004761 -0.011396 -0.012805">
      <inertial mass="3.228604" pos="0.027518 0.039252 -0.066502" diaginertia="1 1 1"/>
      <joint name="joint3" user="0.64068 10.136 -0.04607"/>
    <body name="link4" pos="0.0825 0 0" euler="90 0 0"
          user="0.025853 0.019552 0.028323 0.007796 -0.001332 0.008641">
      <inertial mass="3.587895" pos="-0.05317 0.104419 0.027454" diaginertia="1 1 1"/>
      <joint name="joint4" user="1.2794 5.5903 0.036194"/>
    <body name="link5" pos="-0.0825 0.384 0" euler="-90 0 0"
          user="0.035549 0.029474 0.008627 -0.002117 -0.004037 0.000229">
      <inertial mass="1.225946" pos="-0.011953 0.041065 -0.038437" diaginertia="1 1 1"/>
      <joint name="joint5" user="0.83904 8.3469 0.026226"/>
    <body name="link6" euler="90 0 0"
          user="0.001964 0.004354 0.005433 0.000109 -0.001158 0.000341">
      <inertial mass="1.666555" pos="0.060149 -0.014117 -0.010517" diaginertia="1 1 1"/>
      <joint name="joint6" user="0.30301 17.133 -0.021047"/>
    <body name="link7" pos="0.088 0 0" euler="90 0 0"
          user="0.012516 0.010027 0.004815 -0.000428 -0.001196 -0.000741">
      <inertial mass="0.735522" pos="0.010517 -0.004252 0.061597" diaginertia="1 1 1"/>
      <joint name="joint7" user="0.56489 10.336 0.0035526"/>
    <body name="flange" pos="0 0 0.107">
)";

constexpr double kPi = 3.14159265358979323846;

constexpr RobotMjcf kFer = {kBodies,
                            // Elbow up, flange pointing down, away from every limit.
                            {0.0, -kPi / 4.0, 0.0, -3.0 * kPi / 4.0, 0.0, kPi / 2.0, kPi / 4.0},
                            0.0,
                            // Franka's data sheet: 150 and 180 degrees per second.
                            {87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0},
                            {2.618, 2.618, 2.618, 2.618, 3.1416, 3.1416, 3.1416}};

}  // namespace

const RobotMjcf& robot_mjcf() {
  return kFer;
}

}  // namespace tactus
