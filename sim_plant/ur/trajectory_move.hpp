// The moves among the points of a trajectory.
#pragma once

#include "sim_plant/ur/machine.hpp"

namespace tactus::ur {

/// What a point of a type that is no spline asks for. False: it is of no known type, or a pose has
/// no posture.
bool read_move(const std::array<std::int32_t, kTrajectoryInts>& point, const Machine& machine,
               Move& move);

}  // namespace tactus::ur
