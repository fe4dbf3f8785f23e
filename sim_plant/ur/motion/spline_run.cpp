#include "sim_plant/ur/motion/spline_run.hpp"

#include <cmath>

#include "hal/ur/protocol.hpp"

namespace tactus::ur {
namespace {

constexpr double kFastest = 6.283185, kDeceleration = 15.0;  // rad/s, rad/s^2
constexpr double kStopping_s = kFastest / kDeceleration;
constexpr double kShortestStep_s = 1e-5;

}  // namespace

void SplineRun::start(const Joints& q, const Joints& q_end, const Joints& dq_end,
                      const Joints& ddq_end, double duration_s, bool quintic, bool last) {
  const double T = duration_s, T2 = T * T, T3 = T2 * T;
  const Joints way = q_end - q;
  c_.fill(Joints::Zero());
  c_[1] = dq_;
  if (quintic) {
    c_[2] = 0.5 * ddq_;
    c_[3] = (20.0 * way - 3.0 * ddq_ * T2 + ddq_end * T2 - 12.0 * dq_ * T - 8.0 * dq_end * T) /
            (2.0 * T3);
    c_[4] =
        (-30.0 * way + 3.0 * ddq_ * T2 - 2.0 * ddq_end * T2 + 16.0 * dq_ * T + 14.0 * dq_end * T) /
        (2.0 * T3 * T);
    c_[5] = (12.0 * way - ddq_ * T2 + ddq_end * T2 - 6.0 * dq_ * T - 6.0 * dq_end * T) /
            (2.0 * T3 * T2);
  } else {
    c_[2] = (3.0 * way - 2.0 * dq_ * T - dq_end * T) / T2;
    c_[3] = (-2.0 * way + dq_ * T + dq_end * T) / T3;
  }
  duration_s_ = T;
  time_s_ = 0.0;
  scale_ = 1.0;
  last_ = last;
  slowing_ = false;
  phase_ = Phase::kSteps;
}

Joints SplineRun::speed(double t) const {
  Joints sum = Joints::Zero();
  for (int k = 5; k >= 1; --k) sum = sum * t + k * c_[static_cast<std::size_t>(k)];
  return sum;
}

Joints SplineRun::acceleration(double t) const {
  Joints sum = Joints::Zero();
  for (int k = 5; k >= 2; --k) sum = sum * t + k * (k - 1) * c_[static_cast<std::size_t>(k)];
  return sum;
}

bool SplineRun::too_fast_to_stop(double left_s, double cycle_s) const {
  const double allowed = kFastest - (kStopping_s - (left_s - cycle_s)) * kDeceleration;
  return speed(time_s_ + cycle_s).cwiseAbs().maxCoeff() > allowed;
}

void SplineRun::step(double to_s, double step_s, Motion& motion) {
  time_s_ = to_s;
  const Joints before = dq_;
  dq_ = scale_ * speed(to_s);
  ddq_ = acceleration(to_s);
  if (step_s < kShortestStep_s) return;
  motion.speed_j(dq_, (dq_ - before).cwiseAbs().maxCoeff() / step_s, step_s);
}

bool SplineRun::command(Motion& motion, double cycle_s) {
  const double left_s = duration_s_ - time_s_;
  if (phase_ == Phase::kSteps) {
    if (left_s > cycle_s + 1e-9) {
      if (last_ && !slowing_ && left_s <= kStopping_s && too_fast_to_stop(left_s, cycle_s)) {
        slowing_ = true;
        slowing_s_ = left_s + cycle_s;
      }
      if (slowing_) scale_ = left_s / slowing_s_;
      step(time_s_ + cycle_s * scale_, cycle_s, motion);
      return true;
    }
    phase_ = slowing_ ? Phase::kSlowing : Phase::kLast;
  }
  if (phase_ == Phase::kSlowing) {
    if (left_s >= kShortestStep_s) {
      scale_ = left_s / slowing_s_;
      step(time_s_ + cycle_s * scale_, cycle_s, motion);
      return true;
    }
    scale_ = 0.0;
    phase_ = Phase::kLast;
  }
  if (phase_ == Phase::kLast) {
    phase_ = Phase::kDone;
    step(duration_s_, left_s, motion);
    return motion.busy();
  }
  return false;
}

}  // namespace tactus::ur
