// The plant's model of the robot this program is built for. A new robot is one text beside
// fer_mjcf.cpp and two lines here.
#pragma once

#if defined(TACTUS_ROBOT_FER)
#include "sim_plant/fer_mjcf.hpp"
namespace tactus {
using RobotMjcf = FerMjcf;
}
#elif defined(TACTUS_ROBOT_UR10)
#include "sim_plant/ur10_mjcf.hpp"
namespace tactus {
using RobotMjcf = Ur10Mjcf;
}
#endif
