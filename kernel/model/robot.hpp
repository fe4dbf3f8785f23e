// The robot this program is built for. A new robot is two tables, beside fer.hpp and
// fer_capsules.hpp, and four lines here.
#pragma once

#if defined(TACTUS_ROBOT_FER)
#include "kernel/model/fer.hpp"
#include "kernel/model/fer_capsules.hpp"
namespace tactus {
using Robot = Fer;
using RobotCapsules = FerCapsules;
}  // namespace tactus
#elif defined(TACTUS_ROBOT_UR10)
#include "kernel/model/ur10.hpp"
#include "kernel/model/ur10_capsules.hpp"
namespace tactus {
using Robot = Ur10;
using RobotCapsules = Ur10Capsules;
}  // namespace tactus
#else
#error "the board names its robot: ROBOT := FER in board.mk"
#endif
