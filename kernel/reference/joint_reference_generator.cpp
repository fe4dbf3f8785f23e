#include "kernel/reference/joint_reference_generator.hpp"

namespace tactus {

Status JointReferenceGenerator::start() {
  JointSpace::Point measured;
  measured.q = *q;
  TRY(generator_.start(
      *channel, {{params.start_tolerance}, params.online, params.timeout_ms * 1e-3}, measured));
  write();
  return Status::kOk;
}

Status JointReferenceGenerator::step(double dt_s) {
  TRY(generator_.step(dt_s));
  write();
  return Status::kOk;
}

void JointReferenceGenerator::write() {
  const JointSpace::Point& reference = generator_.reference();
  q_d.value = reference.q;
  dq_d.value = reference.dq;
  ddq_d.value = reference.ddq;
  tau_d.value = reference.tau;
}

}  // namespace tactus
