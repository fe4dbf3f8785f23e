// CornerPath: the way through waypoints without times, as straight lines with blended corners,
// twice continuously differentiable by its parameter s, which has unit speed on the lines
// (Euclidean length in the space of the joints, rad).
//
// A blend leaves the line of direction d1 at a distance L before its corner and joins that of d2 at
// L behind it. Over its own parameter u in [0, 1], s = 2 L u, the direction changes by a smooth
// step:
//
//   q'(s) = d1 + (d2 - d1) (3 u^2 - 2 u^3)       q''(s) = (d2 - d1) 3 u (1 - u) / L
//   q(s)  = corner - L d1 + 2 L (d1 u + (d2 - d1) (u^3 - u^4 / 2))
//
// It is farthest from the corner at u = 1/2: by 3/16 L (d2 - d1). At a corner without a blend the
// path stops: it consists of sections, each from rest to rest.
#pragma once

#include <vector>

#include "gateway/ctl/retime/joints.hpp"

namespace tactus::ctl {

/// Position and derivatives by s at one place of a path.
struct PathPlace {
  Joints q, dq, ddq, dddq;
};

struct PathPiece {
  double length = 0.0;
  Joints start, d1, d2;  ///< a line has d1 = d2

  bool straight() const { return (d1 == d2).all(); }
  /// Returns the path at `s` from the beginning of the piece. [any]
  PathPlace at(double s) const;
};

/// From rest to rest.
using PathSection = std::vector<PathPiece>;

/// How corners are rounded; 0: the path stops there.
struct Corners {
  double tolerance_rad = 0.0;  ///< largest distance of a joint from the corner
  double radius_rad = 0.0;     ///< longest L
};

/// Returns the sections of the way through the waypoints; none if all waypoints are the same. A
/// blend takes at most half of the line on either side. The path stops where it turns back by more
/// than 2.7 rad, too: a blend would nearly stand. [any]
std::vector<PathSection> blend(const std::vector<Joints>& waypoints, const Corners& corners);

}  // namespace tactus::ctl
