// The FER for KDL, typed from another form of the sources than the kernel's: the kinematics from
// Franka's Craig DH table, the inertias in the column order of Gaz et al.
#include "tests/oracles/kdl_arm.hpp"

namespace tactus {
namespace {

constexpr int kJoints = 7;
constexpr double kQuarter = 1.57079632679489661923;  // pi/2
/// Craig (modified) DH: frame i in frame i-1 at theta = 0. Row 7 is the flange.
struct CraigDh {
  double a, d, alpha;  // a(i-1) in m, d(i) in m, alpha(i-1) in rad
};

// Franka control interface documentation, "Denavit-Hartenberg parameters" of the Panda.
// clang-format off
constexpr CraigDh kDh[kJoints + 1] = {
    { 0.0,    0.333,  0.0},
    { 0.0,    0.0,   -kQuarter},
    { 0.0,    0.316,  kQuarter},
    { 0.0825, 0.0,    kQuarter},
    {-0.0825, 0.384, -kQuarter},
    { 0.0,    0.0,    kQuarter},
    { 0.088,  0.0,    kQuarter},
    { 0.0,    0.107,  0.0},
};
// clang-format on

/// About the centre of mass, axes of the link's DH frame.
struct Inertia {
  double mass, c[3];
  double xx, yy, zz, xy, xz, yz;
};

// Gaz, Cognetti, Oliva, Robuffo Giordano, De Luca, RA-L 2019, tables VIII and IX of the supplement.
// Of link 1 only mass moments about its axis act; its z coordinate is that of franka_ros.
// clang-format off
constexpr Inertia kLinks[kJoints] = {
    {4.970684, {0.003875, 0.002081, -0.04762},
     0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169},
    {0.646926, {-0.003141, -0.02872, 0.003495},
     0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704},
    {3.228604, {0.027518, 0.039252, -0.066502},
     0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805},
    {3.587895, {-0.05317, 0.104419, 0.027454},
     0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641},
    {1.225946, {-0.011953, 0.041065, -0.038437},
     0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229},
    {1.666555, {0.060149, -0.014117, -0.010517},
     0.001964, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341},
    {0.735522, {0.010517, -0.004252, 0.061597},
     0.012516, 0.010027, 0.004815, -0.000428, -0.001196, -0.000741},
};
// clang-format on

KDL::Frame dh_frame(int i) {
  return KDL::Frame::DH_Craig1989(kDh[i].a, kDh[i].alpha, kDh[i].d, 0);
}

}  // namespace

/// A KDL segment is a joint followed by the transform to the next joint, with the inertia given at
/// that far end. Hence the fixed first segment and the shifted inertia.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool) {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), dh_frame(0)));
  for (int i = 0; i < kJoints; ++i) {
    const Inertia& l = kLinks[i];
    const KDL::RigidBodyInertia in_link(l.mass, KDL::Vector(l.c[0], l.c[1], l.c[2]),
                                        KDL::RotationalInertia(l.xx, l.yy, l.zz, l.xy, l.xz, l.yz));
    KDL::RigidBodyInertia at_end = dh_frame(i + 1).Inverse() * in_link;
    if (i == kJoints - 1) at_end = at_end + tool;
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), dh_frame(i + 1), at_end));
  }
  return chain;
}

double kdl_along_axis(int /*joint*/) {
  return 0.0;
}

}  // namespace tactus
