#include "sim_plant/ur/motion.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kNothing_s = 1e-9;  // less time than this is none
constexpr double kSettle_s = 0.064;  // a move returns when the arm stands too

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
      busy_ = false;
      return 0.0;
    case Kind::kMoveJ:
      time_s_ += h_s;
      q_ = from_ + way_ * time_law_.position(time_s_);
      dq_ = way_ * time_law_.speed(time_s_);
      break;
    case Kind::kMoveL:
      follow_line(h_s);
      break;
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
  // Moves: at the end exactly at rest, and then until the arm stands as well.
  if (time_s_ >= time_law_.duration_s()) dq_.setZero();
  if (time_s_ >= time_law_.duration_s() + kSettle_s) {
    kind_ = Kind::kRest;
    busy_ = false;
  }
  return h_s;
}

/// Where a joint would be too fast, the time on the law is stretched.
void Motion::follow_line(double h_s) {
  double step_s = h_s;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const double s = time_law_.position(time_s_ + step_s);
    const Frame at{line_from_.p + s * (line_to_.p - line_from_.p),
                   line_from_.r * rotation_matrix(s * turn_)};
    Joints q = q_;
    if (!inverse(at, tool_, q_, q)) break;
    const double ratio = ((q - q_).cwiseAbs().array() / (h_s * limits_.speed.array())).maxCoeff();
    if (ratio <= 1.0) {
      time_s_ += step_s;
      dq_ = (q - q_) / h_s;
      q_ = q;
      return;
    }
    step_s *= std::max(0.1, 0.95 / ratio);
  }
  fault_ = {Code::kSingularity, 0};
}

/// The leading axis changes its speed by `a`, the others in proportion.
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
  busy_ = false;
  if (!playing) {
    kind_ = Kind::kStop;
    ramp_to(Joints::Zero(), limits_.stop_acceleration, h_s);
    return;
  }
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
