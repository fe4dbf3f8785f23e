// The Gen3 for KDL, typed from another form of the sources than the kernel's. The kinematics are
// the Craig DH table that follows from the standard one of the user guide EN-UG-014, "7 DoF
// spherical wrist". Each d is the sum of two lengths as in the guide, with the digits of the URDF,
// because the guide rounds to 0.1 mm and omits the 0.35 mm of joint 6. The inertias are in the
// order of the guide's tables, moments before products.
#include "tests/oracles/kdl_arm.hpp"

namespace tactus {
namespace {

constexpr int kJoints = 7;
constexpr double kQuarter = 1.57079632679489661923;  // pi/2

/// Frame i in frame i-1 at theta = 0: a = 0, d = -(near + far). The link's frame in the URDF, in
/// which its inertia is given, has the same axes and is `near` along this distance. Mass, centre of
/// mass and tensor about it.
struct Link {
  double alpha, near, far;  // alpha(i-1), rad; m
  double mass, c[3];
  double xx, yy, zz, xy, xz, yz;
};

// clang-format off
constexpr Link kLinks[kJoints] = {
    {2.0 * kQuarter, 0.15643,    0.12838,    1.3773, {-23e-6, -10.364e-3,  -73.36e-3},
     4.57e-3,   4.831e-3,  1.409e-3,   1e-6,  2e-6,  448e-6},
    {kQuarter,       0.005375,   0.006375,   1.1636, {-44e-6, -99.58e-3,   -13.278e-3},
     11.088e-3, 1.072e-3,  11.255e-3,  5e-6,  0.0,  -691e-6},
    {-kQuarter,      0.21038,    0.21038,    1.1636, {-44e-6, -6.641e-3,   -117.892e-3},
     10.932e-3, 11.127e-3, 1.043e-3,   0.0,  -7e-6,  606e-6},
    {kQuarter,       0.006375,   0.006375,   0.9302, {-18e-6, -75.478e-3,  -15.006e-3},
     8.147e-3,  0.631e-3,  8.316e-3,  -1e-6,  0.0,  -500e-6},
    {-kQuarter,      0.20843,    0.10593,    0.6781, {1e-6,   -9.432e-3,   -63.883e-3},
     1.596e-3,  1.607e-3,  0.399e-3,   0.0,   0.0,   256e-6},
    {kQuarter,       0.00017505, 0.00017505, 0.6781, {1e-6,   -45.483e-3,  -9.65e-3},
     1.641e-3,  0.41e-3,   1.641e-3,   0.0,   0.0,  -278e-6},
    {-kQuarter,      0.10593,    0.061525,   0.364,  {-93e-6,  0.132e-3,   -22.905e-3},
     0.214e-3,  0.223e-3,  0.24e-3,    0.0,   1e-6, -2e-6},
};
// clang-format on

/// Frame i+1 in frame i; after the last joint the flange, rotated by half a turn.
KDL::Frame dh_frame(int i) {
  if (i == kJoints) return KDL::Frame::DH_Craig1989(0.0, 2.0 * kQuarter, 0.0, 0.0);
  return KDL::Frame::DH_Craig1989(0.0, kLinks[i].alpha, -(kLinks[i].near + kLinks[i].far), 0.0);
}

}  // namespace

/// As for the FER: a fixed segment first, and each inertia shifted to the far end of its segment.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool) {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), dh_frame(0)));
  for (int i = 0; i < kJoints; ++i) {
    const Link& l = kLinks[i];
    const KDL::RigidBodyInertia in_link(l.mass, KDL::Vector(l.c[0], l.c[1], l.c[2]),
                                        KDL::RotationalInertia(l.xx, l.yy, l.zz, l.xy, l.xz, l.yz));
    const KDL::Frame link(KDL::Vector(0.0, 0.0, kdl_along_axis(i)));
    KDL::RigidBodyInertia at_end = dh_frame(i + 1).Inverse() * (link * in_link);
    if (i == kJoints - 1) at_end = at_end + tool;
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), dh_frame(i + 1), at_end));
  }
  return chain;
}

double kdl_along_axis(int joint) {
  return kLinks[joint].far;
}

}  // namespace tactus
