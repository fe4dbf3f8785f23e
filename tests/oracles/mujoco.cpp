#include "tests/oracles/mujoco.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "sim_plant/arm/compile_arm.hpp"

namespace tactus {
namespace {

constexpr int kJoints = Robot::kDof;

struct ArmModel {
  mjModel* model = compile_arm();
  mjData* data = mj_makeData(model);
  int flange = mj_name2id(model, mjOBJ_BODY, "flange");
};

/// The arm at joint positions q; it lives as long as the program.
const ArmModel& arm_at(const double* q) {
  static const ArmModel arm;
  std::copy_n(q, kJoints, arm.data->qpos);
  mj_fwdPosition(arm.model, arm.data);
  return arm;
}

/// C dq + g under a gravity of the strength given, m/s^2 along z.
void bias(const ArmModel& arm, const double* dq, double gravity_z, double* tau) {
  arm.model->opt.gravity[2] = gravity_z;
  std::copy_n(dq, kJoints, arm.data->qvel);
  mj_comVel(arm.model, arm.data);
  mj_rne(arm.model, arm.data, 0, tau);
}

}  // namespace

void mujoco_flange(const double q[Robot::kDof], double p[3], double r[3][3]) {
  const ArmModel& arm = arm_at(q);
  std::copy_n(arm.data->xpos + 3 * arm.flange, 3, p);
  std::copy_n(arm.data->xmat + 9 * arm.flange, 9, &r[0][0]);
}

void mujoco_jacobian(const double q[Robot::kDof], double jacobian[6][Robot::kDof]) {
  const ArmModel& arm = arm_at(q);
  mj_jacBody(arm.model, arm.data, jacobian[0], jacobian[3], arm.flange);
}

void mujoco_gravity(const double q[Robot::kDof], double g[Robot::kDof]) {
  constexpr double kAtRest[kJoints] = {};
  bias(arm_at(q), kAtRest, -9.81, g);
}

void mujoco_coriolis(const double q[Robot::kDof], const double dq[Robot::kDof],
                     double c[Robot::kDof]) {
  bias(arm_at(q), dq, 0.0, c);
}

void mujoco_mass_matrix(const double q[Robot::kDof], double m[Robot::kDof][Robot::kDof]) {
  const ArmModel& arm = arm_at(q);
  mj_fullM(arm.model, m[0], arm.data->qM);
}

}  // namespace tactus
