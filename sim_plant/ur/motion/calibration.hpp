// Calibration: the kinematics of one arm, as the manufacturer measures them after assembly.
//
// The sizes are those of two published calibrations (github.com/UniversalRobots/
// Universal_Robots_ROS2_Driver, ur_calibration/doc/algorithm.rst; forum.universal-robots.com/t/
// calibrated-kinamatics-info/18921): from joint to joint an axis is some 0.5 mm and 1 mrad off,
// those of elbow and wrist 1 up to 7 mrad. Axes that are parallel by design then have a common
// normal hundreds of metres away, in any direction: d and theta of joints 2 to 4 are large, and
// opposite.
#pragma once

#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

/// Draws the kinematics of one UR10. The same seed gives the same arm.
DhTable draw_calibration(unsigned seed);

}  // namespace tactus::ur
