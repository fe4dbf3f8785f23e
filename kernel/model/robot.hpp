// The robot this program is built for. A new robot is one table beside fer.hpp and two lines here.
#pragma once

#if defined(TACTUS_ROBOT_FER)
#include "kernel/model/fer.hpp"
namespace tactus {
using Robot = Fer;
}
#elif defined(TACTUS_ROBOT_UR10)
#include "kernel/model/ur10.hpp"
namespace tactus {
using Robot = Ur10;
}
#else
#error "the board names its robot: ROBOT := FER in board.mk"
#endif
