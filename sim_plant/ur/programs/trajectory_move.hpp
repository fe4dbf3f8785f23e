// The points of a trajectory that are moves.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"

namespace tactus::ur {

/// A point as it comes over the wire.
using TrajectoryPoint = std::array<std::int32_t, kTrajectoryInts>;
/// Returns six numbers from `first` on, which are integers of 1 / `scale`.
Vector6 six_numbers(const TrajectoryPoint& point, std::size_t first, double scale = kFixedPoint);

/// How a text reads a point, which differs between releases of the client library: the places of a
/// move's speed and acceleration among its integers, and the units of time, blend radius, and
/// speeds and accelerations of a spline.
struct PointFormat {
  struct Places {
    std::size_t v = 12, a = 13;
  };
  Places moves, circles;
  double time_scale = kFixedPoint, rate_scale = kFixedPoint;
};
PointFormat find_point_format(std::string_view text);

/// True for a move that this generation of controllers has.
bool is_move(std::int32_t type);

/// Reads the move of a point. False: no posture reaches its pose.
bool read_move(const TrajectoryPoint& point, const PointFormat& format, const Machine& machine,
               Move& move);

/// True for a move that this generation of controllers does not have; texts show a popup instead.
bool is_optimove(std::int32_t type);

}  // namespace tactus::ur
