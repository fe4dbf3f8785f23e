#include "sim_plant/ur/motion/motion.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kTooFast = 1.05;  // fraction of a joint's speed limit

}  // namespace

double Motion::advance(double h_s) {
  const double taken = moved(std::min(h_s, left_s_));
  left_s_ -= taken;
  if (left_s_ < kNothing_s) busy_ = false;
  if (!in_reach(q_)) fault_ = {Code::kCloseToJointLimit, 0};
  return taken;
}

double Motion::moved(double h_s) {
  switch (kind_) {
    case Kind::kRest:
    case Kind::kCarried: busy_ = false; return 0.0;
    case Kind::kMove: return move_on(h_s);
    case Kind::kServo:
      for (int i = 0; i < 6; ++i) {
        const double before = q_[i];
        law_.step(goal_[i], h_s, q_[i], dq_[i]);
        const double most = limits_.speed[i];
        dq_[i] = std::clamp(dq_[i], -most, most);
        q_[i] = std::clamp(q_[i], before - most * h_s, before + most * h_s);
      }
      return h_s;
    case Kind::kSpeedJ:
      ramp_to(goal_, a_, h_s);
      if (dq_ == goal_ && left_s_ == kForever) busy_ = false;
      return h_s;
    case Kind::kSpeedL:
      ramp_twist(h_s);
      if (twist_ == twist_goal_ && left_s_ == kForever) busy_ = false;
      return h_s;
    case Kind::kBrakeFirst:
      ramp_to(Joints::Zero(), limits_.stop_acceleration, h_s);
      if (dq_.isZero(0.0)) begin_waiting();
      return h_s;
    case Kind::kStop:
      ramp_to(Joints::Zero(), a_, h_s);
      if (dq_.isZero(0.0)) {
        kind_ = Kind::kRest;
        busy_ = false;
      }
      return h_s;
  }
  return h_s;
}

/// Follows the path to its end, or until the script may go on.
double Motion::move_on(double h_s) {
  const double taken_s = path_.advance(h_s);
  const bool there = path_.posture(q_, q_, dq_);
  // The pace is planned from samples, which may miss the highest speed next to a singularity.
  const bool can = there && (dq_.cwiseAbs().array() <= kTooFast * limits_.speed.array()).all();
  if (!can) fault_ = {Code::kSingularity, 0};
  if (path_.asks()) busy_ = false;
  if (path_.done()) {
    kind_ = Kind::kRest;
    busy_ = false;
    if (waits_) begin_waiting();
  }
  return taken_s;
}

/// Changes the speed of the leading axis with the acceleration `a`, the others in proportion.
void Motion::ramp_to(const Joints& dq, double a, double h_s) {
  const Joints change = dq - dq_, before = dq_;
  const double lead = change.cwiseAbs().maxCoeff(), most = a * h_s;
  if (lead <= most * (1.0 + 1e-9)) {
    dq_ = dq;
  } else {
    dq_ += change * (most / lead);
  }
  q_ += 0.5 * (before + dq_) * h_s;
}

void Motion::ramp_twist(double h_s) {
  const Vector6 change = twist_goal_ - twist_;
  const double lead = std::max(change.head<3>().norm(), change.tail<3>().norm());
  if (lead <= a_ * h_s * (1.0 + 1e-9)) {
    twist_ = twist_goal_;
  } else {
    twist_ += change * (a_ * h_s / lead);
  }
  Joints dq;
  if (!joint_speeds(q_, tool_, twist_, dq)) fault_ = {Code::kSingularity, 0};
  const double ratio = (dq.cwiseAbs().array() / limits_.speed.array()).maxCoeff();
  if (ratio > 1.0) dq /= ratio;
  q_ += 0.5 * (dq_ + dq) * h_s;
  dq_ = dq;
}

void Motion::idle(double h_s, bool playing) {
  if (!playing) {
    busy_ = false;
    kind_ = Kind::kStop;
    ramp_to(Joints::Zero(), limits_.stop_acceleration, h_s);
    return;
  }
  if (arriving()) {
    move_on(h_s);
    return;
  }
  if (kind_ == Kind::kCarried) return ramp_to(Joints::Zero(), limits_.stop_acceleration, h_s);
  const bool holds_speed = kind_ == Kind::kSpeedJ || kind_ == Kind::kSpeedL;
  if (holds_speed) {
    q_ += dq_ * h_s;
    return;
  }
  if (dq_.cwiseAbs().maxCoeff() > limits_.sudden_stop)
    fault_ = {Code::kPathSanity, kSuddenStop};
  else
    dq_.setZero();
}

void Motion::brake(double h_s) {
  busy_ = false;
  kind_ = Kind::kStop;
  ramp_to(Joints::Zero(), limits_.protective_acceleration, h_s);
}

Stop Motion::take_fault() {
  const Stop stop = fault_;
  fault_ = {};
  return stop;
}

}  // namespace tactus::ur
