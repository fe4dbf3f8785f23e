#include "kernel/reference/blocks/task_reference_generator.hpp"

namespace tactus {

Status TaskReferenceGenerator::start() {
  auto settings = params.generator.params<TaskSpace>();
  settings.start_tolerance = params.start_tolerance;
  settings.tolerances.path = params.path_tolerance;
  settings.tolerances.goal = params.goal_tolerance;
  settings.measured =
      static_cast<Fields>((v.wired() ? kVelocityField : 0) | (h.wired() ? kEffortField : 0));
  TRY(generator_.start(*channel, settings, measured()));
  write(x->r);
  return Status::kOk;
}

Status TaskReferenceGenerator::step(double dt_s) {
  if (speed_scaling.wired()) generator_.scale_speed(*speed_scaling);
  TRY(generator_.step(dt_s, measured()));
  write(x_d.value.r);
  return Status::kOk;
}

TaskSpace::Point TaskReferenceGenerator::measured() const {
  return {*x, *v, Vector6::Zero(), *h};
}

void TaskReferenceGenerator::write(const Eigen::Quaterniond& last) {
  const TaskSpace::Point& reference = generator_.reference();
  x_d.value = {reference.x.p, unit_beside(reference.x.r, last)};
  v_d.value = reference.v;
  a_d.value = reference.a;
  h_d.value = reference.h;
  dh_d.value = reference.dh;
  write_outputs(generator_.outputs());
}

}  // namespace tactus
