// Lift6: its links as capsules, fitted by scripts/robot-import to the collision shapes of
// lift6.urdf. Each contains its shape and is of nearly the least volume; beside it is how far it
// reaches beyond the convex hull of the shape.
#pragma once

#include <array>

#include "kernel/robots/capsule_table.hpp"
#include "kernel/robots/lift6.hpp"

namespace tactus {

template <>
struct Capsules<Lift6> {
  static constexpr std::array<const char*, 7> kLinkNames = {
      "base", "carriage", "upper_arm", "forearm", "wrist", "hand", "face"};

  // clang-format off
  //   link, a, b, radius
  static constexpr std::array<LinkCapsule, 7> kCapsules = {{
      {0, {-0.24, 0.0, 0.0}, {-0.24, 0.0, 1.7}, 0.10001},  // base, box, at most 97.8 mm beyond
      {1, {-0.0007, -0.0004, -0.0796}, {0.0, 0.0, 0.0685}, 0.08131},  // carriage, cylinder, at most 78.6 mm beyond
      {2, {0.0035, 0.0, 0.03}, {0.34, 0.0, 0.0299}, 0.05541},  // upper_arm, cylinder, at most 54.7 mm beyond
      {3, {0.0034, 0.0, 0.03}, {0.28, 0.0, 0.0299}, 0.05041},  // forearm, cylinder, at most 49.7 mm beyond
      {4, {-0.0002, -0.0001, -0.1099}, {0.0, 0.0, 0.015}, 0.04551},  // wrist, cylinder, at most 44.1 mm beyond
      {5, {0.0002, 0.0097, -0.0004}, {0.0, -0.0441, 0.0}, 0.03671},  // hand, cylinder, at most 34.9 mm beyond
      {6, {0.0, 0.0, 0.015}, {0.0, 0.0, 0.015}, 0.03831},  // face, cylinder, at most 22.8 mm beyond
  }};

  /// Links whose capsules touch in a good share of all positions; there are none.
  static constexpr std::array<LinkPair, 0> kTouching = {};

  /// The joints between these capsules do not bend so far that they meet.
  static constexpr std::array<CapsulePair, 8> kNever = {{{0, 2}, {1, 3}, {1, 4}, {2, 4}, {2, 5}, {3, 5}, {3, 6}, {4, 6}}};
  // clang-format on
};

}  // namespace tactus
