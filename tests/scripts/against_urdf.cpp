// A program: against_urdf FILE compares the kernel's model of the robot it is compiled for with
// what MuJoCo reads from the URDF itself: pose and Jacobian of the tip, gravity, mass matrix,
// Coriolis, at 1000 random states. It prints the largest difference of each, and how far a
// collision shape of the URDF is outside the capsules.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernel/model/link_frames.hpp"
#include "tests/support/model_cases.hpp"

namespace tactus {
namespace {

/// The largest difference that was seen; NaN stays.
struct Worst {
  const char* what;
  double value = 0.0;
  template <class A, class B>
  void see(const A& ours, const B& theirs) {
    const double difference = (ours - theirs).cwiseAbs().maxCoeff();
    if (!(difference <= value)) value = difference;
  }
};

template <int rows, int columns>
using Rows = Eigen::Map<
    const Eigen::Matrix<double, rows, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;

struct Comparison {
  mjModel* model;
  mjData* data = mj_makeData(model);
  int tip = model->nbody - 1;
  Worst pose{"pose"}, jacobian{"jacobian"}, gravity{"gravity"}, mass{"mass"}, coriolis{"coriolis"};
  double outside = 0.0;  ///< the farthest point of a shape outside all capsules, m

  void at(const JointVector& q, const JointVector& dq) {
    std::copy_n(q.data(), kDof, data->qpos);
    mj_fwdPosition(model, data);
    const Pose x = tip_pose(q, {});
    pose.see(x.p, Rows<3, 1>(data->xpos + 3 * tip));
    pose.see(x.r.toRotationMatrix(), Rows<3, 3>(data->xmat + 9 * tip));
    double J[6 * kDof], M[kDof * kDof], tau[kDof];
    mj_jacBody(model, data, J, J + 3 * kDof, tip);
    jacobian.see(tip_jacobian(q, {}), Rows<6, kDof>(J));
    mj_fullM(model, M, data->qM);
    mass.see(mass_matrix(q, {}), Rows<kDof, kDof>(M));
    rne(JointVector::Zero(), tau);
    gravity.see(gravity_at(q, {}), Rows<kDof, 1>(tau));
    rne(dq, tau);
    coriolis.see(rnea(q, dq, JointVector::Zero(), {}), Rows<kDof, 1>(tau));
    for (int geom = 0; geom < model->ngeom; ++geom) see_shape(geom, q);
  }

  void see_shape(int geom, const JointVector& q) {
    const mjtNum* size = model->geom_size + 3 * geom;
    const auto see = [&](double x, double y, double z, double radius = 0.0) {
      const Vector3 at = Rows<3, 1>(data->geom_xpos + 3 * geom) +
                         Rows<3, 3>(data->geom_xmat + 9 * geom) * Vector3(x, y, z);
      outside = std::max(outside, beyond_capsules(at, q) + radius);
    };
    if (model->geom_type[geom] == mjGEOM_SPHERE) return see(0.0, 0.0, 0.0, size[0]);
    if (model->geom_type[geom] == mjGEOM_MESH) {
      const int mesh = model->geom_dataid[geom], first = model->mesh_vertadr[mesh];
      for (int k = first; k < first + model->mesh_vertnum[mesh]; ++k) {
        const float* vertex = model->mesh_vert + 3 * k;
        see(vertex[0], vertex[1], vertex[2]);
      }
      return;
    }
    const bool box = model->geom_type[geom] == mjGEOM_BOX;
    for (int k = 0; k < 16; ++k) {
      const double c = std::cos(k * M_PI / 8.0), s = std::sin(k * M_PI / 8.0);
      const double x = box ? std::copysign(size[0], c) : size[0] * c;
      const double y = box ? std::copysign(size[1], s) : size[0] * s;
      const double z = box ? size[2] : size[1];
      see(x, y, z);
      see(x, y, -z);
    }
  }

  /// Returns the distance from a point to the nearest capsule of the table; negative inside.
  static double beyond_capsules(const Vector3& at, const JointVector& q) {
    const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
    double least = 1e9;
    for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
      const LinkFrame& frame = frames[static_cast<std::size_t>(capsule.link)];
      const Vector3 a = frame.at(Vector3(capsule.a)), way = frame.at(Vector3(capsule.b)) - a;
      const double length = std::max(way.squaredNorm(), 1e-12);
      const double share = std::clamp(way.dot(at - a) / length, 0.0, 1.0);
      least = std::min(least, (at - a - share * way).norm() - capsule.radius);
    }
    return least;
  }

  void rne(const JointVector& dq, double* tau) {
    std::copy_n(dq.data(), kDof, data->qvel);
    mj_comVel(model, data);
    mj_rne(model, data, 0, tau);
  }
};

int compare(const char* urdf) {
  char error[256] = "";
  mjModel* model = mj_loadXML(urdf, nullptr, error, sizeof error);
  if (model == nullptr || model->nq != kDof) {
    std::fprintf(stderr, "%s: %s\n", urdf, error);
    return 2;
  }
  model->opt.gravity[2] = -kGravity_m_s2;
  Comparison comparison{model};
  RandomStates states;
  for (int k = 0; k < 1000; ++k) {
    states.next();
    comparison.at(states.q, states.dq);
  }
  bool agree = true;
  for (const Worst& worst : {comparison.pose, comparison.jacobian, comparison.gravity,
                             comparison.mass, comparison.coriolis}) {
    std::printf("%s %.2g\n", worst.what, worst.value);
    agree = agree && worst.value < 1e-9;
  }
  std::printf("outside %.2g\n", comparison.outside);
  return agree && comparison.outside <= 0.0 ? 0 : 1;
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  return tactus::compare(argv[1]);
}
