#include "kernel/model/robot_model.hpp"

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/model/gravity.hpp"

namespace tactus {

Status RobotModel::start() {
  x.value = {};
  return step(0.0);
}

Status RobotModel::step(double /*dt_s*/) {
  const JointTrig<Robot> trig = joint_trig<Robot>(*q);
  const Eigen::Quaterniond before = x.value.r;
  x.value = forward_kinematics<Robot>(trig, tool->tip, J.value);
  // r and -r are the same orientation: the output is the one closer to that of the last cycle.
  if (x.value.r.dot(before) < 0.0) x.value.r.coeffs() = -x.value.r.coeffs();
  v.value = J.value * *dq;
  g.value = gravity<Robot>(trig, *tool);

  const bool finite = x.value.p.allFinite() && x.value.r.coeffs().allFinite() &&
                      v.value.allFinite() && J.value.allFinite() && g.value.allFinite();
  return finite ? Status::kOk : Status::kStateNotFinite;
}

}  // namespace tactus
