// CornerPath: the way through waypoints without times, as straight lines with blended corners,
// twice continuously differentiable by its parameter s, which has unit speed on the lines
// (Euclidean length of all numbers of a direction: rad of the joints; of the tip, a metre counts as
// a radian).
//
// A blend leaves the line of direction d1 at a distance L before its corner and joins that of d2 at
// L behind it. Over its own parameter u in [0, 1], s = 2 L u, the direction changes by a smooth
// step, in the coordinates x of the chart of the corner (chart.hpp):
//
//   x'(s) = d1 + (d2 - d1) (3 u^2 - 2 u^3)       x''(s) = (d2 - d1) 3 u (1 - u) / L
//   x(s)  = -L d1 + 2 L (d1 u + (d2 - d1) (u^3 - u^4 / 2))
//
// It is farthest from the corner at u = 1/2: by 3/16 L (d2 - d1). At a corner without a blend the
// path stops: it consists of sections, each from rest to rest.
#pragma once

#include <vector>

#include "gateway/ctl/retime/chart.hpp"

namespace tactus::ctl {

struct PathPiece {
  double length = 0.0;
  Chart chart;
  Numbers start, d1, d2;   ///< in the chart; a line has d1 = d2
  std::size_t corner = 0;  ///< waypoint that a blend rounds; 0: a line

  bool straight() const { return (d1 == d2).all(); }
  /// Returns the path at `s` from the beginning of the piece. [any]
  PathPlace at(double s) const;
};

/// A section of the path that begins and ends at rest.
struct PathSection {
  std::size_t first = 0, last = 0;  ///< waypoints at its ends
  std::vector<PathPiece> pieces;
};

/// How corners are rounded; without tolerance and radius the path stops there.
struct Corners {
  Numbers tolerance;    ///< largest distance of a channel from the corner, rad or m; empty: any
  double radius = 0.0;  ///< longest L; 0: any
};

/// Returns the sections of the way through the waypoints, of the tip or of joints; none if all
/// waypoints are the same. A blend takes at most half of the line on either side. The path stops
/// where it turns back by more than 2.7 rad, too: a blend would nearly stop. [any]
std::vector<PathSection> blend(const std::vector<Numbers>& waypoints, bool tip,
                               const Corners& corners);

}  // namespace tactus::ctl
