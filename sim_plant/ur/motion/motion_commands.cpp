// Starts the commands of a script.
#include <algorithm>
#include <cmath>

#include "sim_plant/ur/motion/motion.hpp"

namespace tactus::ur {

MotionLimits::MotionLimits() {
  speed << 120.0, 120.0, 180.0, 180.0, 180.0, 180.0;
  speed *= kDegree;
}

void Motion::rest(const Joints& q) {
  q_ = q;
  dq_.setZero();
  twist_.setZero();
  kind_ = Kind::kRest;
  busy_ = waits_ = false;
  offset_.setZero();
  offset_dq_.setZero();
  force_law_.reset();
}

void Motion::begin(Kind kind, double t) {
  waits_ = false;
  if (kind == Kind::kSpeedL && kind_ != Kind::kSpeedL) twist_ = jacobian(q_, tool_) * dq_;
  kind_ = kind;
  left_s_ = t;
  busy_ = true;
}

bool Motion::in_reach(const Joints& q) const {
  return q.allFinite() && q.cwiseAbs().maxCoeff() <= limits_.position;
}

/// Goes on from a blend radius into the next move; otherwise a move begins at rest.
bool Motion::move(const Move& move) {
  if (kind_ == Kind::kMove && path_.asks()) {
    const MovePath::Next next = path_.follow(move, tool_);
    waits_ = next == MovePath::Next::kStops;
    waiting_ = move;
    busy_ = next != MovePath::Next::kUnreachable;
    return busy_;
  }
  if (!dq_.isZero(1e-6)) return wait_with(move);
  if (!path_.begin(move, q_, tool_)) return false;
  begin(Kind::kMove, kForever);
  dq_.setZero();
  if (!path_.done()) return true;
  kind_ = Kind::kRest;
  busy_ = false;
  if (move.kind == Move::Kind::kJ) q_ = move.q;
  return true;
}

/// Lets the move wait until the arm, which is still moving, is at rest.
bool Motion::wait_with(const Move& move) {
  Segment segment;
  if (!segment.start(move, q_, tool_, limits_)) return false;
  waiting_ = move;
  begin(Kind::kBrakeFirst, kForever);
  return true;
}

void Motion::begin_waiting() {
  waits_ = false;
  if (!move(waiting_)) fault_ = {Code::kSingularity, 0};
}

bool Motion::move_j(const Joints& q, double a, double v, double t, double r) {
  Move command;
  command.q = q;
  command.a = a;
  command.v = v;
  command.t = t;
  command.r = r;
  return move(command);
}

bool Motion::move_l(const Frame& target, double a, double v, double t, double r) {
  Move command;
  command.kind = Move::Kind::kL;
  command.target = target;
  command.a = a;
  command.v = v;
  command.t = t;
  command.r = r;
  return move(command);
}

void Motion::servo_j(const Joints& q, double t, const ServoLaw& law) {
  if (!std::isfinite(law.gain) || !std::isfinite(law.lookahead_s)) {
    fault_ = {Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  if (!in_reach(q)) {
    fault_ = q.allFinite() ? Stop{Code::kCloseToJointLimit, 0}
                           : Stop{Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  if (!((q - q_).cwiseAbs().maxCoeff() <= limits_.sudden_change)) {
    fault_ = {Code::kPathSanity, kSuddenChange};
    return;
  }
  goal_ = q;
  law_ = {std::clamp(law.gain, 100.0, 2000.0), std::clamp(law.lookahead_s, 0.03, 0.2)};
  begin(Kind::kServo, given_or(t, 0.008));
}

void Motion::speed_j(const Joints& dq, double a, double t) {
  if (!dq.allFinite()) {
    fault_ = {Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  goal_ = dq.cwiseMax(-limits_.speed).cwiseMin(limits_.speed);
  a_ = given_or(a, 1.4);
  begin(Kind::kSpeedJ, given_or(t, kForever));
}

void Motion::speed_l(const Vector6& twist, double a, double t) {
  if (!twist.allFinite()) {
    fault_ = {Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  begin(Kind::kSpeedL, given_or(t, kForever));
  twist_goal_ = twist;
  a_ = given_or(a, 1.2);
}

void Motion::stop_j(double a) {
  a_ = given_or(a, limits_.stop_acceleration);
  begin(Kind::kStop, kForever);
}

}  // namespace tactus::ur
