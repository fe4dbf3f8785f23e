// The UR10 for KDL, typed from another form of the sources than the kernel's: the kinematics from
// the manufacturer's standard DH table, the inertias in DH axes as
// Universal_Robots_ROS2_Description 2.4.5 gives them before it rotates them.
#include "tests/oracles/kdl_arm.hpp"

#include <iterator>

namespace tactus {
namespace {

constexpr double kQuarter = 1.57079632679489661923;  // pi/2

/// Standard DH frame i in frame i-1 at theta = 0, and the link that ends at it; mass, centre of
/// mass and tensor in the axes of frame i, the tensor about the centre of mass.
struct Link {
  double a, d, alpha;  // m, m, rad
  double mass, c[3];
  double xx, xy, xz, yy, yz, zz;
};

// clang-format off
constexpr Link kLinks[] = {
    { 0.0,    0.1273,    kQuarter,  7.1,   {0.021, 0.0,   0.027},
      0.03408,  0.00002, -0.00425, 0.03529,  0.00008, 0.02156},
    {-0.612,  0.0,       0.0,      12.7,   {0.38,  0.0,   0.158},
      0.02814,  0.00005, -0.01561, 0.77068,  0.00002, 0.76943},
    {-0.5723, 0.0,       0.0,       4.27,  {0.24,  0.0,   0.068},
      0.01014,  0.00008,  0.00916, 0.30928,  0.0,     0.30646},
    { 0.0,    0.163941,  kQuarter,  2.0,   {0.0,   0.007, 0.018},
      0.00296, -0.00001,  0.0,     0.00222, -0.00024, 0.00258},
    { 0.0,    0.1157,   -kQuarter,  2.0,   {0.0,   0.007, 0.018},
      0.00296, -0.00001,  0.0,     0.00222, -0.00024, 0.00258},
    { 0.0,    0.0922,    0.0,       0.365, {0.0,   0.0,  -0.026},
      0.00040,  0.0,      0.0,     0.00041,  0.0,     0.00034},
};
// clang-format on

}  // namespace

/// A KDL segment is a joint and the link up to its far end, where its inertia is given: a DH link.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool) {
  KDL::Chain chain;
  for (const Link& l : kLinks) {
    KDL::RigidBodyInertia inertia(l.mass, KDL::Vector(l.c[0], l.c[1], l.c[2]),
                                  KDL::RotationalInertia(l.xx, l.yy, l.zz, l.xy, l.xz, l.yz));
    if (&l == std::end(kLinks) - 1) inertia = inertia + tool;
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(l.a, l.alpha, l.d, 0), inertia));
  }
  return chain;
}

/// Standard DH translates along the axis after the rotation, the kernel before it.
double kdl_along_axis(int joint) {
  return kLinks[joint].d;
}

}  // namespace tactus
