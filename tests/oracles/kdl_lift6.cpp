// Lift6 for KDL, written by scripts/robot-import from lift6.urdf: position, and roll, pitch and yaw
// of each joint frame in the one before at q = 0, as they follow from the URDF.
#include "tests/oracles/kdl_arm.hpp"

namespace tactus {
namespace {

constexpr int kJoints = 6;

struct Place {
  double p[3], rpy[3];          // m, rad
  KDL::Joint::JointType joint;  // about or along z of this frame
};

struct Link {
  double mass, c[3], tensor[6];  // kg; m; kg m^2: xx yy zz xy xz yz
};

// clang-format off
constexpr Place kPlaces[kJoints + 1] = {
      {{0.0, 0.0, 0.4}, {0.0, 0.0, 0.0}, KDL::Joint::TransZ},
      {{0.02, 0.0, 0.12}, {0.0, 0.0, 0.0}, KDL::Joint::RotZ},
      {{0.36, 0.0, 0.1}, {0.0, 0.0, 0.0}, KDL::Joint::RotZ},
      {{0.3, 0.0, -0.06}, {0.0, 0.0, 0.0}, KDL::Joint::RotZ},
      {{0.0, 0.0, -0.12}, {-1.5707963267948966, 1.5707963267948966, 0.0}, KDL::Joint::RotZ},
      {{0.0, -0.11, 0.0}, {1.5707963267948966, 0.0, 0.0}, KDL::Joint::RotZ},
      {{0.0, 0.0, 0.03}, {0.0, 0.0, 0.0}, KDL::Joint::Fixed},
};

constexpr Link kLinks[kJoints] = {
      {6.0, {0.01, 0.0, 0.02}, {0.0362, 0.04, 0.0362, 0.0, 0.0, 0.0}},
      {5.0, {0.17, 0.0, 0.02}, {0.01017, 0.07767, 0.0795, 0.0, 0.0, 0.0}},
      {3.2, {0.13, 0.0, 0.03}, {0.00483, 0.03299, 0.03349, 0.0, 0.0, 0.0}},
      {1.4, {0.0, 0.0, -0.03}, {0.00323, 0.00323, 0.00189, 0.0, 0.0, 0.0}},
      {0.9, {0.0, -0.03, 0.0}, {0.00156, 0.00096, 0.00156, 0.0, 0.0, 0.0}},
      {0.35, {0.0, 0.0, 0.01}, {0.00017, 0.00017, 0.00029, 0.0, 0.0, 0.0}},
};
// clang-format on

KDL::Frame place(int i) {
  const Place& at = kPlaces[i];
  return {KDL::Rotation::RPY(at.rpy[0], at.rpy[1], at.rpy[2]),
          KDL::Vector(at.p[0], at.p[1], at.p[2])};
}

}  // namespace

/// A fixed segment first, and each inertia shifted to the far end of its segment.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool) {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), place(0)));
  for (int i = 0; i < kJoints; ++i) {
    const Link& l = kLinks[i];
    const double* t = l.tensor;
    const KDL::RigidBodyInertia link(l.mass, KDL::Vector(l.c[0], l.c[1], l.c[2]),
                                     KDL::RotationalInertia(t[0], t[1], t[2], t[3], t[4], t[5]));
    KDL::RigidBodyInertia at_end = place(i + 1).Inverse() * link;
    if (i == kJoints - 1) at_end = at_end + tool;
    chain.addSegment(KDL::Segment(KDL::Joint(kPlaces[i].joint), place(i + 1), at_end));
  }
  return chain;
}

double kdl_along_axis(int) {
  return 0.0;
}

}  // namespace tactus
