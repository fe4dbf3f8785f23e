#include "sim_plant/ur/motion/motion.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kTooFast = 1.05;  // fraction of a joint's speed limit

/// Returns the share of a step in speed, rad/s, that the joints can make in addition to `dq`.
double room(const Joints& dq, const Joints& step, const Joints& limit) {
  double share = 1.0;
  for (int j = 0; j < 6; ++j)
    if (step[j] != 0.0)
      share = std::min(share, (limit[j] - std::copysign(1.0, step[j]) * dq[j]) / std::abs(step[j]));
  return std::max(share, 0.0);
}

}  // namespace

void ServoLaw::step(double set_point, double h_s, double& q, double& dq) const {
  // e'' + 2 d e' + g e = 0 with e = q - c; e(t) = exp(-d t) (e C + (e' + d e) S).
  const double d = 0.5 * gain * lookahead_s, w2 = gain - d * d, e = q - set_point;
  const double w = std::sqrt(std::abs(w2)), x = w * h_s;
  double c = 1.0, s = h_s;  // C and S at h: cos and sin(w h)/w, or the hyperbolic functions
  if (x > 1e-6) {
    c = w2 > 0.0 ? std::cos(x) : std::cosh(x);
    s = (w2 > 0.0 ? std::sin(x) : std::sinh(x)) / w;
  }
  const double decay = std::exp(-d * h_s), v = dq + d * e;
  q = set_point + decay * (e * c + v * s);
  dq = decay * (dq * c - (gain * e + d * dq) * s);
}

// Starts the commands of a script.

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
  return move({Move::Kind::kJ, q, {}, {}, false, a, v, t, r});
}

bool Motion::move_l(const Frame& target, double a, double v, double t, double r) {
  return move({Move::Kind::kL, Joints::Zero(), {}, target, false, a, v, t, r});
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

// Motion in addition to the commands: force mode, and a hand in freedrive.

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
