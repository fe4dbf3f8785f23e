#include "kernel/control/wrench_front_end.hpp"

#include <algorithm>

#include "kernel/math/exponential.hpp"

namespace tactus {
namespace {

/// Returns v shortened by `band`; zero if v is not longer.
Vector3 shortened(const Vector3& v, double band) {
  const double length = v.norm();
  return length > band ? Vector3((1.0 - band / length) * v) : Vector3(Vector3::Zero());
}

}  // namespace

Status WrenchFrontEnd::start() {
  h.value = bias.value = filtered_ = Vector6::Zero();
  taring.value = params.tare_s > 0.0;
  period_s_ = 0.0;
  last_ = *ft;
  unchanged_ = samples_ = cycles_ = 0;
  transfer_.clear();
  request_.end({Status::kNotStarted});
  return check();
}

Status WrenchFrontEnd::step(double dt_s) {
  TRY(check());
  if (stuck(dt_s)) return Status::kSensorStuck;
  const Matrix3 R = (x->r * tool->tip.r.conjugate()).toRotationMatrix();
  const Vector6 load = *ft - weight(R);
  if (!load.allFinite()) return Status::kSensorNotFinite;
  const bool rested = (taring.value || request_.runs()) && sample(load, dt_s);
  if (taring.value) return tare(rested, dt_s);
  filter(at_tip(load - bias.value, R), dt_s);
  transfer_.step(dt_s);
  h.value = contact();
  if (transfer_.runs()) h.value += transfer_.value();
  if (request_.runs()) tare_again(rested, R, dt_s);
  return h.value.allFinite() ? Status::kOk : Status::kSensorNotFinite;
}

Vector6 WrenchFrontEnd::contact() const {
  return stacked(shortened(filtered_.head<3>(), params.dead_force),
                 shortened(filtered_.tail<3>(), params.dead_moment));
}

void WrenchFrontEnd::retune(const Params& next, const JointLimits& /*limits*/) {
  params = next;
  transfer_.start(h.value - contact(), kTransfer_s);
}

Status WrenchFrontEnd::check() const {
  if (!ft->allFinite()) return Status::kSensorNotFinite;
  const bool within =
      ft->head<3>().norm() < params.max_force && ft->tail<3>().norm() < params.max_moment;
  return within ? Status::kOk : Status::kSensorRange;
}

bool WrenchFrontEnd::stuck(double dt_s) {
  if (params.stuck_s == 0.0) return false;
  unchanged_ = *ft == last_ ? unchanged_ + 1 : 0;
  last_ = *ft;
  return unchanged_ * dt_s >= params.stuck_s;
}

bool WrenchFrontEnd::sample(const Vector6& load, double dt_s) {
  const bool first = samples_ == 0;
  low_ = first ? load : Vector6(low_.cwiseMin(load));
  high_ = first ? load : Vector6(high_.cwiseMax(load));
  const Vector6 spread = high_ - low_;
  const bool steady = spread.head<3>().maxCoeff() <= params.tare_force_tolerance &&
                      spread.tail<3>().maxCoeff() <= params.tare_moment_tolerance;
  if (first || !steady) {
    sum_ = low_ = high_ = load;
    samples_ = 1;
  } else {
    sum_ += load;
    ++samples_;
  }
  ++cycles_;
  return samples_ * dt_s >= params.tare_s;
}

Status WrenchFrontEnd::tare(bool rested, double dt_s) {
  if (rested) {
    bias.value = sum_ / samples_;
    request_.start(bias.value);
    taring.value = false;
    return Status::kOk;
  }
  return cycles_ * dt_s < params.tare_timeout_s ? Status::kOk : Status::kSensorNotSteady;
}

Status WrenchFrontEnd::begin_tare() {
  if (!kTuning || params.tare_s == 0.0) return Status::kNotOffered;
  if (taring.value || request_.runs()) return Status::kMailboxFull;
  samples_ = cycles_ = 0;
  request_.begin();
  return Status::kOk;
}

/// The filter's state goes over to the new bias at once; what h would step by is left to the fade.
void WrenchFrontEnd::tare_again(bool rested, const Matrix3& R, double dt_s) {
  if (!rested) {
    if (cycles_ * dt_s >= params.tare_timeout_s) request_.end({Status::kSensorNotSteady});
    return;
  }
  const Vector6 zero = sum_ / samples_, change = zero - bias.value;
  const Verdict verdict = params.judge(change, zero - request_.zero());
  if (verdict.ok()) {
    bias.value += change;
    filtered_ -= at_tip(change, R);
    transfer_.start(h.value - contact(), kTransfer_s);
  }
  request_.end(verdict);
}

Vector6 WrenchFrontEnd::weight(const Matrix3& R) const {
  const Vector3 force = R.transpose() * Vector3(tool->mass_kg * tool->gravity);
  return stacked(force, tool->com.cross(force));
}

Vector6 WrenchFrontEnd::at_tip(const Vector6& flange, const Matrix3& R) const {
  const Vector3 force = flange.head<3>();
  const Vector3 moment = flange.tail<3>() - tool->tip.p.cross(force);
  return stacked(R * force, R * moment);
}

void WrenchFrontEnd::filter(const Vector6& contact, double dt_s) {
  if (dt_s != period_s_) {
    const double periods = dt_s / params.time_constant_s;
    gain_ = params.time_constant_s > 0.0 ? periods * mean_decay(periods) : 1.0;  // 1 - e^-periods
    period_s_ = dt_s;
  }
  filtered_ += gain_ * (contact - filtered_);
}

}  // namespace tactus
