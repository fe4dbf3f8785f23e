// The time-optimal speed along a path within bounds of velocity and acceleration, by the method of
// TOPP-RA: H. Pham, Q.-C. Pham, "A New Approach to Time-Optimal Path Parameterization Based on
// Reachability Analysis", IEEE Transactions on Robotics 34(3), 2018.
//
// On a grid of path parameters s_i, with x = (ds/dt)^2 and u = d^2s/dt^2 constant between two of
// them, x_{i+1} = x_i + 2 (s_{i+1} - s_i) u_i, and the velocity and the acceleration of every
// channel are bounded by
//
//   |q'|^2 x <= v^2          |q' u + q'' x| <= a      at s_i, and at s_{i+1} with x_{i+1}
//
// where || is the length of a vector, of a joint the magnitude. Where the path bends, the jerk at
// constant speed bounds x too: |q'''| x^(3/2) <= j.
//
// All (u, x) within the bounds are a convex set, and those of one x an interval, in closed form: it
// is what a line has in common with balls. Backward, from rest at the end, the largest x_i from
// which x_{i+1} can be controllable is found by bisection, where the interval becomes empty;
// forward, from rest, the largest u_i is taken. Rest is always controllable, so that each set of
// controllable x is an interval from 0.
#pragma once

#include <vector>

#include "gateway/ctl/retime/corner_path.hpp"

namespace tactus::ctl {

/// A node of the grid; u holds up to the next node.
struct PathNode {
  const PathPiece* piece = nullptr;
  double offset = 0.0;  ///< in the piece
  double s = 0.0, x = 0.0, u = 0.0, time_s = 0.0;
};

/// Returns the nodes of the time-optimal motion along a section, from rest to rest. The section
/// must outlive them. `steps`: least number of intervals. Empty: the path stops somewhere. [any]
std::vector<PathNode> time_optimal(const PathSection& section, const MotionBounds& bounds,
                                   int steps);

}  // namespace tactus::ctl
