// Motion in addition to the commands: force mode, and a hand in freedrive.
#include <algorithm>
#include <cmath>

#include "sim_plant/ur/motion/motion.hpp"

namespace tactus::ur {
namespace {

/// Returns the share of a step in speed, rad/s, that the joints can make in addition to `dq`.
double room(const Joints& dq, const Joints& step, const Joints& limit) {
  double share = 1.0;
  for (int j = 0; j < 6; ++j)
    if (step[j] != 0.0)
      share = std::min(share, (limit[j] - std::copysign(1.0, step[j]) * dq[j]) / std::abs(step[j]));
  return std::max(share, 0.0);
}

}  // namespace

/// Sets the targets to the posture, nearest to the last one, with the displaced tip of the
/// commands.
void Motion::yield(const ForceMode& mode, double damping, const Vector6& force, double h_s) {
  if (h_s <= 0.0 || (!mode.active && force_law_.still() && offset_.isZero(0.0))) return;
  Frame tip = forward(q()) * tool_;
  const Vector3 speed = (jacobian(q(), tool_) * dq()).head<3>();
  force_law_.step(mode, damping, tip, speed, force, h_s);
  if (!mode.active && force_law_.still() && kind_ != Kind::kMove) return settle_offset();
  tip = forward(q_) * tool_;
  tip.p += force_law_.displacement().p;
  tip.r = force_law_.displacement().r * tip.r;
  Joints found;
  const bool there = inverse(tip, tool_, q(), found);
  const Joints step = (found - q_ - offset_) / h_s;
  if (!there || !(step.cwiseAbs().array() <= 1.05 * limits_.speed.array()).all()) {
    fault_ = {Code::kSingularity, 0};
    offset_dq_.setZero();  // the displacement stays unchanged
    return;
  }
  offset_dq_ = room(dq_, step, limits_.speed) * step;
  offset_ += offset_dq_ * h_s;
  if (!in_reach(q())) fault_ = {Code::kCloseToJointLimit, 0};
}

/// Makes the displacement part of the targets, so that the next command starts there.
void Motion::settle_offset() {
  q_ += offset_;
  offset_.setZero();
  offset_dq_.setZero();
  force_law_.reset();
}

void Motion::carry(const Joints& q, const Joints& dq) {
  rest(q);
  dq_ = dq;
  kind_ = Kind::kCarried;
}

}  // namespace tactus::ur
