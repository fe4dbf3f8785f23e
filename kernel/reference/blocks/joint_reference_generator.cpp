#include "kernel/reference/blocks/joint_reference_generator.hpp"

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

Status JointReferenceGenerator::start() {
  x_d.value = {};
  return start_from(measured());
}

Status JointReferenceGenerator::resume() {
  return start_from(generator_.reference());
}

Status JointReferenceGenerator::start_from(const JointSpace::Point& point) {
  auto settings = params.generator.params<JointSpace>();
  settings.start_tolerance.q = params.start_tolerance;
  settings.tolerances.path.q = params.path_tolerance;
  settings.tolerances.goal.q = params.goal_tolerance;
  settings.measured =
      static_cast<Fields>((dq.wired() ? kVelocityField : 0) | (tau.wired() ? kEffortField : 0));
  TRY(generator_.start(*channel, settings, point));
  write();
  return Status::kOk;
}

Status JointReferenceGenerator::step(double dt_s) {
  if (speed_scaling.wired()) generator_.scale_speed(*speed_scaling);
  TRY(generator_.step(dt_s, measured()));
  write();
  return Status::kOk;
}

JointSpace::Point JointReferenceGenerator::measured() const {
  JointSpace::Point point;
  point.q = *q;
  point.dq = *dq;
  point.tau = *tau;
  return point;
}

void JointReferenceGenerator::write() {
  const JointSpace::Point& reference = generator_.reference();
  q_d.value = reference.q;
  dq_d.value = reference.dq;
  ddq_d.value = reference.ddq;
  tau_d.value = reference.tau;
  Jacobian J;
  const Pose x = forward_kinematics<Robot>(joint_trig<Robot>(reference.q), tool->tip, J);
  x_d.value = {x.p, unit_beside(x.r, x_d.value.r)};
  v_d.value = J * reference.dq;
  write_outputs(generator_.outputs());
}

}  // namespace tactus
