// The links of the Franka Emika Robot as capsules.
//
// Source: the manufacturer's capsules for self-collision, franka_description,
// robots/common/franka_arm.xacro, given there by centre, axis and length, without the safety
// distance. They enclose the arm but not the cables at its base. The capsules of link 7 are given
// there in a frame turned by pi/4 about z. The second of them is the pin of the flange; its centre,
// 60 mm along the turned x, is written here as components.
#pragma once

#include <array>

#include "kernel/robots/capsule_table.hpp"
#include "kernel/robots/fer.hpp"

namespace tactus {

template <>
struct Capsules<Fer> {
  static constexpr std::array<const char*, 8> kLinkNames = {"link0", "link1", "link2", "link3",
                                                            "link4", "link5", "link6", "link7"};

  // clang-format off
  static constexpr double kOut1 = 0.038890872965260, kOut2 = 0.045961940777126;  // 55, 65 mm / sqrt 2
  //   link   a                      b                     radius
  static constexpr std::array<LinkCapsule, 10> kCapsules = {{
      {0, {-0.090, 0.0,   0.060}, {-0.060, 0.0,   0.060}, 0.060},
      {1, { 0.0,   0.0,  -0.333}, { 0.0,   0.0,  -0.050}, 0.060},
      {2, { 0.0,   0.0,  -0.060}, { 0.0,   0.0,   0.060}, 0.060},
      {3, { 0.0,   0.0,  -0.220}, { 0.0,   0.0,  -0.070}, 0.060},
      {4, { 0.0,   0.0,  -0.060}, { 0.0,   0.0,   0.060}, 0.060},
      {5, { 0.0,   0.0,  -0.310}, { 0.0,   0.0,  -0.210}, 0.060},
      {5, { 0.0,   0.08, -0.200}, { 0.0,   0.08, -0.060}, 0.025},
      {6, { 0.0,   0.0,  -0.070}, { 0.0,   0.0,   0.010}, 0.050},
      {7, { 0.0,   0.0,  -0.060}, { 0.0,   0.0,   0.080}, 0.040},
      {7, {kOut1, kOut1,  0.082}, {kOut2, kOut2,  0.082}, 0.030},
  }};
  // clang-format on

  /// These links are not neighbours, but their capsules touch in a quarter of all positions: both
  /// extend beyond joint 2, which is between them. The links themselves cannot meet within its
  /// limits.
  static constexpr std::array<LinkPair, 1> kTouching = {{{1, 3}}};

  /// The joints between these capsules do not bend so far that they meet.
  // clang-format off
  static constexpr std::array<CapsulePair, 15> kNever = {{
      {0, 2}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {2, 5}, {3, 5}, {3, 7}, {4, 7}, {3, 8}, {4, 8}, {5, 8},
      {6, 8}, {4, 9}, {5, 9},
  }};
  // clang-format on
};

}  // namespace tactus
