#include "tests/oracles/mujoco.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "sim_plant/fer_mjcf.hpp"

namespace tactus {
namespace {

constexpr int kJoints = 7;

struct FerModel {
  mjModel* model = compile_fer();
  mjData* data = mj_makeData(model);
  int flange = mj_name2id(model, mjOBJ_BODY, "flange");
};

/// The arm at joint positions q; it lives as long as the program.
const FerModel& fer_at(const double* q) {
  static const FerModel fer;
  std::copy_n(q, kJoints, fer.data->qpos);
  mj_fwdPosition(fer.model, fer.data);
  return fer;
}

/// C dq + g under a gravity of the strength given, m/s^2 along z.
void bias(const FerModel& fer, const double* dq, double gravity_z, double* tau) {
  fer.model->opt.gravity[2] = gravity_z;
  std::copy_n(dq, kJoints, fer.data->qvel);
  mj_comVel(fer.model, fer.data);
  mj_rne(fer.model, fer.data, 0, tau);
}

}  // namespace

void mujoco_flange(const double q[7], double p[3], double r[3][3]) {
  const FerModel& fer = fer_at(q);
  std::copy_n(fer.data->xpos + 3 * fer.flange, 3, p);
  std::copy_n(fer.data->xmat + 9 * fer.flange, 9, &r[0][0]);
}

void mujoco_jacobian(const double q[7], double jacobian[6][7]) {
  const FerModel& fer = fer_at(q);
  mj_jacBody(fer.model, fer.data, jacobian[0], jacobian[3], fer.flange);
}

void mujoco_gravity(const double q[7], double g[7]) {
  constexpr double kAtRest[kJoints] = {};
  bias(fer_at(q), kAtRest, -9.81, g);
}

void mujoco_coriolis(const double q[7], const double dq[7], double c[7]) {
  bias(fer_at(q), dq, 0.0, c);
}

void mujoco_mass_matrix(const double q[7], double m[7][7]) {
  const FerModel& fer = fer_at(q);
  mj_fullM(fer.model, m[0], fer.data->qM);
}

}  // namespace tactus
