// Universal Robots UR10 (CB3): its links as capsules.
//
// Approximate: the manufacturer publishes meshes and no capsules. Radii, and how far a housing
// reaches along its joint's axis, are those that mujoco_menagerie,
// universal_robots_ur10e/ur10e.xml, fitted to the meshes of the UR10e, which has joints of the same
// sizes. They are moved to the lengths of the UR10: the shoulder is 54 mm lower, the forearm's tube
// lies at 49 mm (elbow_offset in Universal_Robots_ROS2_Description,
// config/ur10/physical_parameters.yaml, as is the radius of the base), wrist 1 begins there. Round
// ends reach up to 26 mm beyond the flange.
#pragma once

#include <array>

#include "kernel/model/capsule_table.hpp"

namespace tactus {

struct Ur10Capsules {
  static constexpr std::array<const char*, 7> kLinkNames = {
      "base", "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"};

  // clang-format off
  //   link   a                      b                       radius
  static constexpr std::array<LinkCapsule, 10> kCapsules = {{
      {0, { 0.0,    0.0,    0.0},   { 0.0,    0.0,   0.038}, 0.075},
      {1, { 0.0,    0.0,   -0.076}, { 0.0,    0.0,   0.030}, 0.078},  // housing of the pan
      {2, { 0.0,    0.0,    0.046}, { 0.0,    0.0,   0.206}, 0.078},  // of the lift
      {2, { 0.0,    0.0,    0.176}, {-0.612,  0.0,   0.176}, 0.060},  // tube
      {3, { 0.0,    0.0,    0.054}, { 0.0,    0.0,   0.184}, 0.058},  // of the elbow
      {3, { 0.0,    0.0,    0.049}, {-0.5723, 0.0,   0.049}, 0.043},  // tube
      {4, { 0.0,    0.0,   -0.125}, { 0.0,    0.0,   0.005}, 0.050},
      {5, { 0.0,    0.0,   -0.131}, { 0.0,    0.0,   0.0},   0.046},
      {5, { 0.0,   -0.015,  0.0},   { 0.0,    0.071, 0.0},   0.046},
      {6, { 0.0,    0.0,   -0.020}, { 0.0,    0.0,  -0.015}, 0.046},
  }};
  // clang-format on

  /// No neighbours, and yet they touch wherever the joints are: the housing of the lift is over the
  /// base, from which the tube keeps away; the tool begins within the round end of wrist 2.
  static constexpr std::array<LinkPair, 2> kTouching = {{{0, 2}, {5, 7}}};
};

}  // namespace tactus
