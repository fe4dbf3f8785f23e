// The links of the Universal Robots UR10 (CB3) as capsules.
//
// Approximate: the manufacturer publishes meshes but no capsules. The radii, and how far a housing
// extends along the axis of its joint, are those of mujoco_menagerie,
// universal_robots_ur10e/ur10e.xml, fitted to the meshes of the UR10e, whose joints have the same
// sizes. They are moved to the lengths of the UR10: the shoulder is 54 mm lower, the tube of the
// forearm is at 49 mm (elbow_offset in Universal_Robots_ROS2_Description,
// config/ur10/physical_parameters.yaml, which also gives the radius of the base), and wrist 1
// begins there. The round ends extend up to 26 mm beyond the flange.
#pragma once

#include <array>

#include "kernel/robots/capsule_table.hpp"
#include "kernel/robots/ur10.hpp"

namespace tactus {

template <>
struct Capsules<Ur10> {
  static constexpr std::array<const char*, 7> kLinkNames = {
      "base", "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"};

  // clang-format off
  //   link   a                      b                       radius
  static constexpr std::array<LinkCapsule, 10> kCapsules = {{
      {0, { 0.0,    0.0,    0.0},   { 0.0,    0.0,   0.038}, 0.075},
      {1, { 0.0,    0.0,   -0.076}, { 0.0,    0.0,   0.030}, 0.078},  // housing of the pan joint
      {2, { 0.0,    0.0,    0.046}, { 0.0,    0.0,   0.206}, 0.078},  // of the lift joint
      {2, { 0.0,    0.0,    0.176}, {-0.612,  0.0,   0.176}, 0.060},  // tube
      {3, { 0.0,    0.0,    0.054}, { 0.0,    0.0,   0.184}, 0.058},  // of the elbow
      {3, { 0.0,    0.0,    0.049}, {-0.5723, 0.0,   0.049}, 0.043},  // tube
      {4, { 0.0,    0.0,   -0.125}, { 0.0,    0.0,   0.005}, 0.050},
      {5, { 0.0,    0.0,   -0.131}, { 0.0,    0.0,   0.0},   0.046},
      {5, { 0.0,   -0.015,  0.0},   { 0.0,    0.071, 0.0},   0.046},
      {6, { 0.0,    0.0,   -0.020}, { 0.0,    0.0,  -0.015}, 0.046},
  }};
  // clang-format on

  /// These bodies are not neighbours, but touch in every position: the housing of the lift joint is
  /// above the base, which the tube never meets; the tool begins inside the round end of wrist 2.
  static constexpr std::array<LinkPair, 2> kTouching = {{{0, 2}, {5, 7}}};

  /// The joints between these capsules do not bend so far that they meet.
  static constexpr std::array<CapsulePair, 7> kNever = {
      {{0, 4}, {1, 4}, {4, 7}, {5, 7}, {4, 8}, {4, 9}, {6, 9}}};
};

}  // namespace tactus
