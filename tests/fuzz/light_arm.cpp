// Replaces sim_plant/arm/arm.cpp by joints of unit inertia without gravity. The parsers see no
// difference, and a cycle takes a hundredth of the time. There is one arm.
#include "sim_plant/arm/arm.hpp"

namespace tactus {
namespace {

JointVector g_q, g_dq;

}  // namespace

Arm::~Arm() = default;
Status Arm::load(const PlantParams& params) {
  return load(params, Scene());
}
Status Arm::load(const PlantParams& params, const Scene&) {
  g_q = params.initial_q;
  g_dq.setZero();
  return Status::kOk;
}
JointVector Arm::stand() {
  g_dq.setZero();
  return JointVector::Zero();
}
void Arm::step(const JointVector& tau, double dt_s) {
  g_dq += tau * dt_s;
  g_q += g_dq * dt_s;
}
JointVector Arm::inverse_dynamics(const JointVector& ddq) {
  return ddq;
}
Vector3 Arm::base_gravity() const {
  return Vector3::Zero();
}
JointVector Arm::gravity() {
  return JointVector::Zero();
}
JointVector Arm::torque_holding(const std::array<bool, kDof>& held, const JointVector& ddq,
                                const JointVector& tau) {
  JointVector torque = tau;
  for (int i = 0; i < kDof; ++i)
    if (held[static_cast<std::size_t>(i)]) torque[i] = ddq[i];
  return torque;
}
JointVector Arm::contact_torque() const {
  return JointVector::Zero();
}
bool Arm::diverged() const {
  return !g_q.allFinite();
}
JointVector Arm::q() const {
  return g_q;
}
JointVector Arm::dq() const {
  return g_dq;
}

}  // namespace tactus
