// The robot as a KDL chain; kdl_<robot>.cpp implements it.
#pragma once

#include <kdl/chain.hpp>

namespace tactus {

/// From the base to the flange of the robot, which carries `tool`, given in the flange frame.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool);

/// The distance, m, along the axis of joint `joint` (counted from 0) from the joint's frame in the
/// chain to the kernel's.
double kdl_along_axis(int joint);

}  // namespace tactus
