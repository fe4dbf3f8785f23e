#include "sim_plant/arm/flange_wrench.hpp"

#include <mujoco/mujoco.h>

namespace tactus {

Vector6 flange_wrench(const mjModel* model, mjData* data, const Vector6& contact) {
  const int flange = mj_name2id(model, mjOBJ_BODY, "flange");
  const int payload = mj_name2id(model, mjOBJ_BODY, "payload");  // at c, in the flange's axes
  mj_rnePostConstraint(model, data);
  double acceleration[6];  // angular first, in the axes of the body; the linear one is a_c - g
  mj_objectAcceleration(model, data, mjOBJ_BODY, payload, acceleration, 1);
  const Vector3 load = -model->body_mass[payload] * Eigen::Map<const Vector3>(acceleration + 3);
  const Vector3 c = Eigen::Map<const Vector3>(model->body_pos + 3 * payload);

  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(data->xmat +
                                                                            9 * flange);
  Vector6 result;
  result.head<3>() = axes.transpose() * contact.head<3>() + load;
  result.tail<3>() = axes.transpose() * contact.tail<3>() + c.cross(load);
  return result;
}

}  // namespace tactus
