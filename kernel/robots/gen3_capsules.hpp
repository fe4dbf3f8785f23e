// Kinova Gen3: its links as capsules.
//
// Approximate: the manufacturer publishes meshes and no capsules. Measured on those of half_arm_1
// and spherical_wrist_1 in ros2_kortex, kortex_description, arms/gen3/7dof/meshes: housings of 46
// mm radius at the large joints and of 35 mm at the wrist, two of which meet 19 and 14 mm beside
// the frame of their joint. Each capsule goes from one housing of its link to the next, with a
// radius that takes in the rims of both; the other links are taken to be built alike. Round ends
// reach up to 14 mm beyond the flange.
#pragma once

#include <array>

#include "kernel/robots/capsule_table.hpp"
#include "kernel/robots/gen3.hpp"

namespace tactus {

template <>
struct Capsules<Gen3> {
  static constexpr std::array<const char*, 8> kLinkNames = {
      "base",    "shoulder",          "half_arm_1",        "half_arm_2",
      "forearm", "spherical_wrist_1", "spherical_wrist_2", "bracelet"};

  // clang-format off
  //   link   a                     b                       radius
  static constexpr std::array<LinkCapsule, 8> kCapsules = {{
      {0, {0.0,  0.0,    0.050}, {0.0,  0.0,    0.100},  0.056},
      {1, {0.0, -0.005, -0.030}, {0.0, -0.005, -0.128},  0.056},
      {2, {0.0,  0.0,   -0.031}, {0.0, -0.194, -0.0064}, 0.052},
      {3, {0.0, -0.004, -0.030}, {0.0, -0.004, -0.210},  0.055},
      {4, {0.0,  0.0,   -0.031}, {0.0, -0.190, -0.0064}, 0.052},
      {5, {0.0,  0.0,   -0.020}, {0.0, -0.033, -0.106},  0.040},
      {6, {0.0,  0.0,   -0.005}, {0.0, -0.084, -0.005},  0.040},
      {7, {0.0,  0.0,   -0.020}, {0.0,  0.0,   -0.035},  0.040},
  }};
  // clang-format on

  /// Links that are no neighbours touch in few positions.
  static constexpr std::array<LinkPair, 0> kTouching = {};

  /// The joints between these capsules do not bend so far that they meet.
  static constexpr std::array<CapsulePair, 9> kNever = {
      {{0, 2}, {0, 3}, {1, 3}, {1, 4}, {3, 5}, {3, 6}, {4, 6}, {4, 7}, {5, 7}}};
};

}  // namespace tactus
