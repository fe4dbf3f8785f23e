#include "tests/bench/kdl_peer.hpp"

#include <algorithm>
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "kernel/robots/fer.hpp"

namespace tactus {
namespace {

constexpr unsigned kJoints = Fer::kDof;

KDL::Frame frame_of(const JointFrame& frame) {
  return KDL::Frame(KDL::Rotation::RotX(frame.roll()), KDL::Vector(frame.x, frame.y, frame.z));
}

/// The shortest chain KDL can build from the table: one segment per joint, from it to the next.
KDL::Chain arm() {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), frame_of(Fer::kJoints[0])));
  for (unsigned i = 0; i < kJoints; ++i) {
    const LinkInertia& l = Fer::kLinks[i];
    const KDL::Frame end = frame_of(i + 1 < kJoints ? Fer::kJoints[i + 1] : Fer::kFlange);
    const KDL::RigidBodyInertia in_link(l.mass, KDL::Vector(l.cx, l.cy, l.cz),
                                        KDL::RotationalInertia(l.xx, l.yy, l.zz, l.xy, l.xz, l.yz));
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), end, end.Inverse() * in_link));
  }
  return chain;
}

struct Solvers {
  const KDL::Chain chain = arm();
  const KDL::Vector gravity{0.0, 0.0, -kGravity_m_s2};
  const KDL::Wrenches no_wrench{chain.getNrOfSegments(), KDL::Wrench::Zero()};
  KDL::ChainFkSolverPos_recursive position{chain};
  KDL::ChainJntToJacSolver jacobian{chain};
  KDL::ChainDynParam dynamics{chain, gravity};
  KDL::ChainIdSolver_RNE inverse_dynamics{chain, gravity};
  KDL::JntArray q{kJoints}, dq{kJoints}, ddq{kJoints}, tau{kJoints};
  KDL::Jacobian J{kJoints};
  KDL::Frame flange;
};

Solvers& solvers() {
  static Solvers instance;
  return instance;
}

void load(const double* values, KDL::JntArray& array) {
  std::copy_n(values, kJoints, array.data.data());
}

}  // namespace

void kdl_peer_forward_kinematics(const double* q, double* p, double* r, double* jacobian) {
  Solvers& kdl = solvers();
  load(q, kdl.q);
  kdl.position.JntToCart(kdl.q, kdl.flange);
  kdl.jacobian.JntToJac(kdl.q, kdl.J);
  std::copy_n(kdl.flange.p.data, 3, p);
  std::copy_n(kdl.flange.M.data, 9, r);
  std::copy_n(kdl.J.data.data(), 6 * kJoints, jacobian);
}

void kdl_peer_gravity(const double* q, double* g) {
  Solvers& kdl = solvers();
  load(q, kdl.q);
  kdl.dynamics.JntToGravity(kdl.q, kdl.tau);
  std::copy_n(kdl.tau.data.data(), kJoints, g);
}

void kdl_peer_inverse_dynamics(const double* q, const double* dq, const double* ddq, double* tau) {
  Solvers& kdl = solvers();
  load(q, kdl.q);
  load(dq, kdl.dq);
  load(ddq, kdl.ddq);
  kdl.inverse_dynamics.CartToJnt(kdl.q, kdl.dq, kdl.ddq, kdl.no_wrench, kdl.tau);
  std::copy_n(kdl.tau.data.data(), kJoints, tau);
}

}  // namespace tactus
