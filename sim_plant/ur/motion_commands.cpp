// The commands of a script: what they set going.
#include <algorithm>
#include <cmath>

#include "sim_plant/ur/motion.hpp"

namespace tactus::ur {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Of a positive value as much as arithmetic can take; what is not positive, or no number, is the
/// default.
double or_default(double value, double otherwise) {
  return value > 0.0 ? std::clamp(value, 1e-9, 1e9) : otherwise;
}

}  // namespace

MotionLimits::MotionLimits() {
  speed << 120.0, 120.0, 180.0, 180.0, 180.0, 180.0;
  speed *= kDegree;
}

void Motion::rest(const Joints& q) {
  q_ = q;
  dq_.setZero();
  twist_.setZero();
  kind_ = Kind::kRest;
  busy_ = false;
}

void Motion::begin(Kind kind, double t) {
  if (kind == Kind::kSpeedL && kind_ != Kind::kSpeedL) twist_ = jacobian(q_, tool_) * dq_;
  kind_ = kind;
  left_s_ = t;
  busy_ = true;
}

bool Motion::in_reach(const Joints& q) const {
  return q.allFinite() && q.cwiseAbs().maxCoeff() <= limits_.position;
}

/// A move begins at rest. True: the arm moves, and the move waits until it does not.
bool Motion::brake_first(const Move& move) {
  if (dq_.isZero(1e-6)) return false;
  waiting_ = move;
  begin(Kind::kBrakeFirst, kForever);
  return true;
}

void Motion::begin_waiting() {
  const Move& move = waiting_;
  if (move.line ? !move_l(move.target, move.a, move.v, move.t)
                : !move_j(move.q, move.a, move.v, move.t))
    fault_ = {Code::kSingularity, 0};
}

bool Motion::move_j(const Joints& q, double a, double v, double t) {
  if (!in_reach(q)) return false;
  if (brake_first({false, q, {}, a, v, t})) return true;
  way_ = q - q_;
  from_ = q_;
  const double way = way_.cwiseAbs().maxCoeff();
  time_s_ = 0.0;
  begin(Kind::kMoveJ, kForever);
  dq_.setZero();
  if (way < 1e-9) {
    kind_ = Kind::kRest;
    busy_ = false;
    q_ = q;
    return true;
  }
  const double fastest = 1.0 / (way_.cwiseAbs().array() / limits_.speed.array()).maxCoeff();
  if (t > 0.0) {
    // A trapezoid of four quarters is fastest by 4/3 of its mean.
    time_law_ = Trapezoid::by_duration(std::max(or_default(t, 0.0), 4.0 / 3.0 / fastest));
  } else {
    time_law_ =
        Trapezoid::by_speed(std::min(or_default(v, 1.05) / way, fastest), or_default(a, 1.4) / way);
  }
  return true;
}

bool Motion::move_l(const Frame& target, double a, double v, double t) {
  Joints end;
  if (!target.p.allFinite() || !target.r.allFinite() || !inverse(target, tool_, q_, end) ||
      !in_reach(end))
    return false;
  if (brake_first({true, end, target, a, v, t})) return true;
  line_from_ = forward(q_) * tool_;
  line_to_ = target;
  turn_ = rotation_vector(line_from_.r.transpose() * line_to_.r);
  time_s_ = 0.0;
  begin(Kind::kMoveL, kForever);
  dq_.setZero();
  // Where the tool turns more than it goes, the angle in rad leads as the way in m would.
  const double way = std::max((line_to_.p - line_from_.p).norm(), turn_.norm());
  if (way < 1e-9) {
    kind_ = Kind::kRest;
    busy_ = false;
  } else if (t > 0.0) {
    time_law_ = Trapezoid::by_duration(or_default(t, 0.0));
  } else {
    time_law_ = Trapezoid::by_speed(or_default(v, 0.25) / way, or_default(a, 1.2) / way);
  }
  return true;
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
  begin(Kind::kServo, or_default(t, 0.008));
}

void Motion::speed_j(const Joints& dq, double a, double t) {
  if (!dq.allFinite()) {
    fault_ = {Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  goal_ = dq.cwiseMax(-limits_.speed).cwiseMin(limits_.speed);
  a_ = or_default(a, 1.4);
  begin(Kind::kSpeedJ, or_default(t, kForever));
}

void Motion::speed_l(const Vector6& twist, double a, double t) {
  if (!twist.allFinite()) {
    fault_ = {Code::kPathSanity, kInvalidSetPoint};
    return;
  }
  begin(Kind::kSpeedL, or_default(t, kForever));
  twist_goal_ = twist;
  a_ = or_default(a, 1.2);
}

void Motion::stop_j(double a) {
  a_ = or_default(a, limits_.stop_acceleration);
  begin(Kind::kStop, kForever);
}

}  // namespace tactus::ur
