#include "kernel/reference/joint_space.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

// Peaks of the quintic that takes a unit of position, velocity or acceleration to zero in one
// second, by the extrema of its Hermite basis: h_p = 1 - 10 t^3 + 15 t^4 - 6 t^5, h_v = t - 6 t^3 +
// 8 t^4 - 3 t^5, h_a = (t^2 - 3 t^3 + 3 t^4 - t^5) / 2.
constexpr double kPeakVelocityOfPosition = 1.875;       // |h_p'| at t = 1/2
constexpr double kPeakAccelerationOfPosition = 5.7736;  // |h_p''| = 10 / sqrt(3)
constexpr double kPeakAccelerationOfVelocity = 3.9412;  // |h_v''| at t = 0.2427
// The swing to the other side, beyond which a velocity or acceleration is no larger than at t = 0.
constexpr double kSwingOfVelocity = 0.512;      // |h_v'| at t = 3/5
constexpr double kSwingOfAcceleration = 0.374;  // |h_a''| at t = 0.3551
// Jerk: with accelerations as bounded here, |60 dp / T^3| + |36 dv / T^2| + |9 da / T| <= 28
// ddq_max / T, which is to be half of the limit.
constexpr double kJerkTime = 56.0;

/// What a bound leaves to the peaks if the motion begins with `start` and swings to the other side.
/// Wherever it does not swing, the start leaves at least as much, because its share falls from one
/// faster than the peaks rise.
double left(double bound, double start, double swing) {
  return bound - swing * std::min(start, bound);
}

double jerk_time_s(const JointLimits& limits, int joint) {
  return kJerkTime * limits.ddq_max[joint] / limits.dddq_max[joint];
}

}  // namespace

JointSpace::Band JointSpace::Band::merged(const Band& goal, const Band& defaults) {
  Band band;
  for (int j = 0; j < kDof; ++j) band.q[j] = merge_tolerance(goal.q[j], defaults.q[j]);
  return band;
}

bool JointSpace::Point::finite() const {
  return q.allFinite() && dq.allFinite() && ddq.allFinite() && tau.allFinite();
}

JointSpace::Point JointSpace::Point::at_rest() const {
  Point rest;
  rest.q = q;
  return rest;
}

bool JointSpace::Point::standing() const {
  return dq == JointVector::Zero() && ddq == JointVector::Zero();
}

bool JointSpace::Point::idle() const {
  return standing() && tau == JointVector::Zero();
}

JointSpace::Point JointSpace::Point::stopped() const {
  Point still = at_rest();
  still.tau = tau;
  return still;
}

JointSpace::Point JointSpace::Point::at_rate(double rate, double slope) const {
  return {q, rate * dq, (rate * rate) * ddq + slope * dq, tau};
}

JointSpace::Segment::Segment(const Point& from, const Point& to, double T, Interpolation how,
                             Fields fields)
    : duration_(T), order_(order_of(how, fields)) {
  const auto join = order_ == Interpolation::kLinear  ? tactus::linear
                    : order_ == Interpolation::kCubic ? tactus::cubic
                                                      : tactus::quintic;
  for (int i = 0; i < kDof; ++i) {
    q_[static_cast<std::size_t>(i)] =
        join({from.q[i], from.dq[i], from.ddq[i]}, {to.q[i], to.dq[i], to.ddq[i]}, T);
  }
  tau_from_ = from.tau;
  tau_to_ = to.tau;
}

JointSpace::Point JointSpace::Segment::corner() const {
  Point begin = at(0.0);
  if (order_ == Interpolation::kLinear) begin.dq.setZero();
  if (order_ != Interpolation::kQuintic) begin.ddq.setZero();
  return begin;
}

JointSpace::Point JointSpace::Segment::at(double t) const {
  Point point;
  for (int i = 0; i < kDof; ++i) {
    const Polynomial& q = position(i);
    const Polynomial dq = q.derivative();
    point.q[i] = q.at(t);
    point.dq[i] = dq.at(t);
    point.ddq[i] = dq.derivative().at(t);
  }
  point.tau = tau_from_ + (t / duration_) * (tau_to_ - tau_from_);
  return point;
}

JointSpace::Difference JointSpace::difference(const Point& a, const Point& b) {
  return {a.q - b.q, a.dq - b.dq, a.ddq - b.ddq, a.tau - b.tau};
}

JointSpace::Point JointSpace::sum(const Point& b, const Difference& d) {
  return {b.q + d.q, b.dq + d.dq, b.ddq + d.ddq, b.tau + d.tau};
}

double JointSpace::bridge_time_s(const Difference& difference, const Limits& limits) {
  double time = 0.0;
  for (int j = 0; j < kDof; ++j) {
    const double dp = std::abs(difference.q[j]), dv = std::abs(difference.dq[j]);
    const double da = std::abs(difference.ddq[j]);
    const double v = left(0.5 * limits.dq_max[j], dv, kSwingOfVelocity);
    const double a = left(0.5 * limits.ddq_max[j], da, kSwingOfAcceleration);
    // a T^2 = kPeakAccelerationOfVelocity dv T + kPeakAccelerationOfPosition dp
    const double half = 0.5 * kPeakAccelerationOfVelocity * dv;
    const double for_acceleration =
        (half + std::sqrt(half * half + a * kPeakAccelerationOfPosition * dp)) / a;
    const double for_velocity = kPeakVelocityOfPosition * dp / v;
    time = std::max({time, for_acceleration, for_velocity, jerk_time_s(limits, j)});
  }
  return time;
}

}  // namespace tactus
