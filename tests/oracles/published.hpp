// Published numbers of the robot this program is built for; published_<robot>.cpp defines them.
#pragma once

#include <vector>

#include "kernel/robots/robot.hpp"
#include "tests/oracles/fcl/fcl.hpp"

namespace tactus {

struct PublishedState {
  double q[Robot::kDof], flange[3], g[Robot::kDof];  ///< rad; m; N m
};

struct PublishedInertia {
  double q[Robot::kDof], diagonal[Robot::kDof];  ///< rad; of M(q), kg m^2
};

struct PublishedOrientation {
  double q[Robot::kDof], r[3][3];  ///< rad; the flange's axes are the columns
};

struct PublishedCapsule {
  int link;
  FclCapsule shape;  ///< in the frame of its link
};

struct PublishedArm {
  /// Results of other codes, printed to nine decimals: the first at q = 0, the fourth where gravity
  /// loads every joint it can.
  std::vector<PublishedState> states;
  PublishedInertia inertia;
  PublishedOrientation orientation;
  double reach;                   ///< from the shoulder, m
  double stretched[Robot::kDof];  ///< joints where the arm is stretched out level, rad
  /// The capsules of the robot, typed again from their source: centre, axis, radius, length.
  std::vector<PublishedCapsule> capsules;
};

const PublishedArm& published();

}  // namespace tactus
