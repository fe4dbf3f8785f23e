// The moves among the points of a trajectory.
#pragma once

#include "sim_plant/ur/machine.hpp"

namespace tactus::ur {

/// How a text reads a point, for releases of the client library differ: where among its integers
/// the speed and the acceleration of a move are, and how many a second and a metre of blend have.
struct PointFormat {
  struct Places {
    std::size_t v = 12, a = 13;
  };
  Places moves, circles;
  double time_scale = kFixedPoint;
};
PointFormat find_point_format(std::string_view text);

/// What a point of a type that is no spline asks for. False: it is of no known type, or a pose has
/// no posture.
bool read_move(const std::array<std::int32_t, kTrajectoryInts>& point, const PointFormat& format,
               const Machine& machine, Move& move);

/// A move that this generation of controllers does not have: texts show a popup in its place.
bool is_optimove(std::int32_t type);

}  // namespace tactus::ur
