// The capsules of the robots, typed from their sources once more, in the form these give them:
// centre, axis, radius, length, each in the frame of its link.
//
// FER: franka_description, franka_arm.xacro; those of link 7 stand there in a frame turned by pi/4
// about z. UR10: see kernel/model/ur10_capsules.hpp for what is approximate.
#pragma once

#include <array>

#include "kernel/model/robot.hpp"
#include "tests/oracles/fcl/fcl.hpp"

namespace tactus {

struct Fer;
struct Ur10;

struct PublishedCapsule {
  int link;
  FclCapsule shape;
};

template <class R>
struct PublishedCapsules;

// clang-format off
template <>
struct PublishedCapsules<Fer> {
  static constexpr double kTurned = 0.70710678118654752440;
  static constexpr std::array<PublishedCapsule, 10> kAll = {{
      {0, {{-0.075, 0.0, 0.06},   {1.0, 0.0, 0.0}, 0.06, 0.03}},
      {1, {{0.0, 0.0, -0.1915},   {0.0, 0.0, 1.0}, 0.06, 0.283}},
      {2, {{0.0, 0.0, 0.0},       {0.0, 0.0, 1.0}, 0.06, 0.12}},
      {3, {{0.0, 0.0, -0.145},    {0.0, 0.0, 1.0}, 0.06, 0.15}},
      {4, {{0.0, 0.0, 0.0},       {0.0, 0.0, 1.0}, 0.06, 0.12}},
      {5, {{0.0, 0.0, -0.26},     {0.0, 0.0, 1.0}, 0.06, 0.10}},
      {5, {{0.0, 0.08, -0.13},    {0.0, 0.0, 1.0}, 0.025, 0.14}},
      {6, {{0.0, 0.0, -0.03},     {0.0, 0.0, 1.0}, 0.05, 0.08}},
      {7, {{0.0, 0.0, 0.01},      {0.0, 0.0, 1.0}, 0.04, 0.14}},
      {7, {{0.06 * kTurned, 0.06 * kTurned, 0.082}, {kTurned, kTurned, 0.0}, 0.03, 0.01}},
  }};
};

template <>
struct PublishedCapsules<Ur10> {
  static constexpr std::array<PublishedCapsule, 10> kAll = {{
      {0, {{0.0, 0.0, 0.019},        {0.0, 0.0, 1.0}, 0.075, 0.038}},
      {1, {{0.0, 0.0, -0.023},       {0.0, 0.0, 1.0}, 0.078, 0.106}},
      {2, {{0.0, 0.0, 0.176 - 0.05}, {0.0, 0.0, 1.0}, 0.078, 0.16}},
      {2, {{-0.306, 0.0, 0.176},     {1.0, 0.0, 0.0}, 0.06, 0.612}},
      {3, {{0.0, 0.0, 0.039 + 0.08}, {0.0, 0.0, 1.0}, 0.058, 0.13}},
      {3, {{-0.28615, 0.0, 0.049},   {1.0, 0.0, 0.0}, 0.043, 0.5723}},
      {4, {{0.0, 0.0, -0.06},        {0.0, 0.0, 1.0}, 0.05, 0.13}},
      {5, {{0.0, 0.0, -0.0655},      {0.0, 0.0, 1.0}, 0.046, 0.131}},
      {5, {{0.0, 0.028, 0.0},        {0.0, 1.0, 0.0}, 0.046, 0.086}},
      {6, {{0.0, 0.0, -0.0175},      {0.0, 0.0, 1.0}, 0.046, 0.005}},
  }};
};
// clang-format on

}  // namespace tactus
