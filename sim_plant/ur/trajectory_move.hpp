// The moves among the points of a trajectory.
#pragma once

#include "sim_plant/ur/machine.hpp"

namespace tactus::ur {

/// How a text reads a point, for releases of the client library differ: where among its integers
/// the speed and the acceleration of a move are, how many a second and a metre of blend have, and
/// how many the speeds and accelerations of a spline.
struct PointFormat {
  struct Places {
    std::size_t v = 12, a = 13;
  };
  Places moves, circles;
  double time_scale = kFixedPoint, rate_scale = kFixedPoint;
};
PointFormat find_point_format(std::string_view text);

/// A move that this generation of controllers has.
bool is_move(std::int32_t type);

/// What a point that is a move asks for. False: its pose has no posture.
bool read_move(const std::array<std::int32_t, kTrajectoryInts>& point, const PointFormat& format,
               const Machine& machine, Move& move);

/// A move that this generation of controllers does not have: texts show a popup in its place.
bool is_optimove(std::int32_t type);

}  // namespace tactus::ur
