#include "tests/oracles/kdl.hpp"

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "tests/oracles/kdl_arm.hpp"

namespace tactus {
namespace {

constexpr unsigned kJoints = Robot::kDof;

KDL::Vector base_gravity(const KdlTool& tool) {
  const double* turn = tool.mounting;
  return KDL::Rotation::RPY(turn[0], turn[1], turn[2]).Inverse() * KDL::Vector(0.0, 0.0, -9.81);
}

KDL::Chain arm(const KdlTool& tool) {
  const KDL::Vector com(tool.com[0], tool.com[1], tool.com[2]);
  return kdl_arm(KDL::RigidBodyInertia(tool.mass_kg, com));
}

KDL::JntArray to_kdl(const double values[Robot::kDof]) {
  KDL::JntArray array(kJoints);
  for (unsigned i = 0; i < kJoints; ++i) array(i) = values[i];
  return array;
}

void from_kdl(const KDL::JntArray& array, double values[kJoints]) {
  for (unsigned i = 0; i < kJoints; ++i) values[i] = array(i);
}

void from_kdl(const KDL::Frame& frame, double p[3], double r[3][3]) {
  for (int i = 0; i < 3; ++i) {
    p[i] = frame.p(i);
    for (int j = 0; j < 3; ++j) r[i][j] = frame.M(i, j);
  }
}

}  // namespace

void kdl_base_gravity(const KdlTool& tool, double gravity[3]) {
  const KDL::Vector g = base_gravity(tool);
  for (int i = 0; i < 3; ++i) gravity[i] = g(i);
}

void kdl_link(const double q[Robot::kDof], int link, double p[3], double r[3][3]) {
  const KDL::Chain chain = arm({});
  KDL::Frame frame;
  for (unsigned s = 0, joint = 0; s < chain.getNrOfSegments() && link > 0; ++s) {
    const KDL::Segment& segment = chain.getSegment(s);
    const bool fixed = segment.getJoint().getType() == KDL::Joint::Fixed;
    if (!fixed && static_cast<int>(joint) == link - 1) {
      frame = frame * segment.getJoint().pose(q[joint]) *
              KDL::Frame(KDL::Vector(0.0, 0.0, kdl_along_axis(link - 1)));
      break;
    }
    frame = frame * segment.pose(fixed ? 0.0 : q[joint]);
    if (!fixed) ++joint;
  }
  from_kdl(frame, p, r);
}

void kdl_flange(const double q[Robot::kDof], double p[3], double r[3][3]) {
  const KDL::Chain chain = arm({});
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::Frame frame;
  solver.JntToCart(to_kdl(q), frame);
  from_kdl(frame, p, r);
}

void kdl_jacobian(const double q[Robot::kDof], double jacobian[6][Robot::kDof]) {
  const KDL::Chain chain = arm({});
  KDL::ChainJntToJacSolver solver(chain);
  KDL::Jacobian result(kJoints);
  solver.JntToJac(to_kdl(q), result);
  for (unsigned i = 0; i < 6; ++i) {
    for (unsigned j = 0; j < kJoints; ++j) jacobian[i][j] = result(i, j);
  }
}

void kdl_gravity(const double q[Robot::kDof], const KdlTool& tool, double g[Robot::kDof]) {
  const KDL::Chain chain = arm(tool);  // the solver keeps a reference
  KDL::ChainDynParam solver(chain, base_gravity(tool));
  KDL::JntArray result(kJoints);
  solver.JntToGravity(to_kdl(q), result);
  from_kdl(result, g);
}

void kdl_inverse_dynamics(const double q[Robot::kDof], const double dq[Robot::kDof],
                          const double ddq[Robot::kDof], const KdlTool& tool,
                          double tau[Robot::kDof]) {
  const KDL::Chain chain = arm(tool);
  KDL::ChainIdSolver_RNE solver(chain, base_gravity(tool));
  const KDL::Wrenches no_wrench(chain.getNrOfSegments(), KDL::Wrench::Zero());
  KDL::JntArray result(kJoints);
  solver.CartToJnt(to_kdl(q), to_kdl(dq), to_kdl(ddq), no_wrench, result);
  from_kdl(result, tau);
}

void kdl_mass_matrix(const double q[Robot::kDof], const KdlTool& tool,
                     double m[Robot::kDof][Robot::kDof]) {
  const KDL::Chain chain = arm(tool);  // the solver keeps a reference
  KDL::ChainDynParam solver(chain, base_gravity(tool));
  KDL::JntSpaceInertiaMatrix result(kJoints);
  solver.JntToMass(to_kdl(q), result);
  for (unsigned i = 0; i < kJoints; ++i) {
    for (unsigned j = 0; j < kJoints; ++j) m[i][j] = result(i, j);
  }
}

void kdl_coriolis(const double q[Robot::kDof], const double dq[Robot::kDof], const KdlTool& tool,
                  double c[Robot::kDof]) {
  const KDL::Chain chain = arm(tool);  // the solver keeps a reference
  KDL::ChainDynParam solver(chain, base_gravity(tool));
  KDL::JntArray result(kJoints);
  solver.JntToCoriolis(to_kdl(q), to_kdl(dq), result);
  from_kdl(result, c);
}

}  // namespace tactus
