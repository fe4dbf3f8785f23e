// The robots as chains of KDL, one per file kdl_<robot>.cpp.
#pragma once

#include <kdl/chain.hpp>

namespace tactus {

/// From the base to the flange of robot R, which carries `tool`, given in the flange frame.
template <class R>
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool);

/// How far along the axis of joint `joint`, counted from 0, the kernel's frame of it stands from
/// where the joint is in the chain, m.
template <class R>
double kdl_along_axis(int joint);

}  // namespace tactus
